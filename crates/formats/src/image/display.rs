//! From linear light to the numbers of a screen, and back.

/// How linear values become 8-bit ones.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Tone {
    /// The sRGB curve (IEC 61966-2-1).
    #[default]
    Srgb,
    /// The square root, as NRenderer shows its pictures.
    SquareRoot,
}

impl Tone {
    /// The 8-bit value of a linear one; 0 for NaN and negative values, 255 from 1 on.
    pub fn encode(self, linear: f32) -> u8 {
        // NaN passes through all of this; the conversion makes it 0.
        let x = linear.clamp(0.0, 1.0);
        let shown = match self {
            Self::Srgb => srgb_from_linear(x),
            Self::SquareRoot => x.sqrt(),
        };
        (255.0 * shown + 0.5) as u8
    }
}

/// The sRGB curve from [0, 1] to [0, 1].
pub fn srgb_from_linear(x: f32) -> f32 {
    if x <= 0.003_130_8 { 12.92 * x } else { 1.055 * x.powf(1.0 / 2.4) - 0.055 }
}

/// The inverse of [`srgb_from_linear`].
pub fn linear_from_srgb(x: f32) -> f32 {
    if x <= 0.040_45 { x / 12.92 } else { ((x + 0.055) / 1.055).powf(2.4) }
}
