//! Which samplers are on, and how their densities are compared.
use crate::photon::Keep;

/// The five samplers of light transport. A path is shared among exactly those that are on.
#[expect(clippy::struct_excessive_bools, reason = "a switch for each sampler")]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Techniques {
    /// A camera path that meets a light by itself.
    pub hit: bool,
    /// Next-event estimation: a point of a light, chosen from a camera vertex.
    pub nee: bool,
    /// A light vertex connected to the lens.
    pub light_image: bool,
    /// A camera vertex connected to a light vertex.
    pub connect: bool,
    /// Density estimation from the light vertices around a camera vertex.
    pub merge: Merge,
}

/// Where photons are gathered.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Merge {
    /// Nowhere.
    Off,
    /// At every camera vertex, of every photon.
    All,
    /// At every camera vertex, of photons that were scattered at least once: what comes straight from a light is left to
    /// the other samplers.
    Scattered,
    /// At every camera vertex, of photons that came from a mirror or through glass last, or what is almost that: what other
    /// samplers find badly or not at all.
    Caustic,
    /// At the first camera vertex only, of scattered photons, which then find all that is not direct light.
    First,
    /// At the first camera vertex only, of every photon: no light is connected.
    FirstAll,
}

impl Merge {
    /// Whether photons are gathered at all.
    pub fn is_on(self) -> bool {
        self != Self::Off
    }
    /// Whether photons that come straight from a light are gathered.
    pub fn of_direct(self) -> bool {
        matches!(self, Self::All | Self::FirstAll)
    }
    /// Whether photons that were scattered `scatterings` times, last as [`crate::walk::Arrival::caustic`] says, are gathered.
    #[inline]
    pub(super) fn takes(self, scatterings: u32, caustic: bool) -> bool {
        match self {
            Self::Off => false,
            Self::All | Self::FirstAll => true,
            Self::Scattered | Self::First => scatterings > 0,
            Self::Caustic => caustic,
        }
    }
    /// Which arrivals of light paths are kept: as [`Merge::takes`], and all of them, for connections, if nothing is gathered.
    pub(super) fn keeps(self) -> Keep {
        match self {
            Self::Off | Self::All | Self::FirstAll => Keep::All,
            Self::Scattered | Self::First => Keep::Scattered,
            Self::Caustic => Keep::LastDelta,
        }
    }
    /// Whether camera paths end where they gather first.
    pub fn at_first_only(self) -> bool {
        matches!(self, Self::First | Self::FirstAll)
    }
}

impl Techniques {
    /// Whether `technique` is on.
    pub fn includes(&self, technique: Technique) -> bool {
        match technique {
            Technique::Hit => self.hit,
            Technique::Nee => self.nee,
            Technique::LightImage => self.light_image,
            Technique::Connect => self.connect,
            Technique::Merge => self.merge.is_on(),
        }
    }
    /// Whether light paths leave photons for gathers and nothing else.
    pub fn lights_serve_gathers_alone(&self) -> bool {
        self.merge.is_on() && !self.light_image && !self.connect
    }
    /// Whether light paths are needed.
    pub fn need_light_paths(&self) -> bool {
        self.light_image || self.connect || self.merge.is_on()
    }
}

/// What is compared in a multiple-importance-sampling weight (Veach 1997, section 9.2.2).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Heuristic {
    /// Densities.
    #[default]
    Balance,
    /// Their squares.
    Power,
}

impl Heuristic {
    /// Words for settings, in the order of the variants.
    pub const WORDS: [&str; 2] = ["balance", "power"];
    /// By place in [`Heuristic::WORDS`].
    pub const ALL: [Self; 2] = [Self::Balance, Self::Power];

    /// A ratio of densities, as it is summed up.
    #[inline]
    pub(super) fn of(self, ratio: f32) -> f32 {
        match self {
            Self::Balance => ratio,
            Self::Power => ratio * ratio,
        }
    }
}

/// How the first radii are fitted to the light before the first pass.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Fit {
    /// They are what they are.
    #[default]
    Off,
    /// To how evenly photons lie (see [`crate::photon::uniformity`]).
    Even,
    /// To the error that they leave (see [`crate::photon::bandwidth`]).
    Error,
}

impl Fit {
    /// Words for settings, in the order of the variants.
    pub const WORDS: [&str; 3] = ["off", "even", "error"];
    /// By place in [`Fit::WORDS`].
    pub const ALL: [Self; 3] = [Self::Off, Self::Even, Self::Error];
}

/// A sampler by name.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Technique {
    /// See [`Techniques::hit`].
    Hit,
    /// See [`Techniques::nee`].
    Nee,
    /// See [`Techniques::light_image`].
    LightImage,
    /// See [`Techniques::connect`].
    Connect,
    /// See [`Techniques::merge`].
    Merge,
}

impl Technique {
    /// All, in the order in which they are told.
    pub const ALL: [Self; 5] = [Self::Hit, Self::Nee, Self::LightImage, Self::Connect, Self::Merge];

    /// Word for files and tables.
    pub fn name(self) -> &'static str {
        match self {
            Self::Hit => "hit",
            Self::Nee => "nee",
            Self::LightImage => "light-image",
            Self::Connect => "connect",
            Self::Merge => "merge",
        }
    }
}
