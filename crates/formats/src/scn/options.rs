//! How NRenderer's scenes are understood where its own pictures and good sense differ.

use super::Comma;
use sunfleck::light::Sides;

/// Reading options. The default gives the scene that its author meant.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct ScnOptions {
    /// Do as NRenderer does: numbers behind a comma are 0, area lights shine from both sides, Phong is its formula.
    pub compat: bool,
    /// Which sides of area lights shine; `None` leaves it to `compat`.
    pub area_light_sides: Option<Sides>,
    /// What a comma between numbers means; `None` leaves it to `compat`.
    pub comma: Option<Comma>,
}

impl ScnOptions {
    /// The sides of area lights that shine.
    pub fn sides(&self) -> Sides {
        self.area_light_sides.unwrap_or(if self.compat { Sides::Two } else { Sides::One })
    }

    /// The meaning of a comma.
    pub fn comma(&self) -> Comma {
        self.comma.unwrap_or(if self.compat { Comma::EndsNumbers } else { Comma::Separates })
    }
}
