//! What `--compat` changes about defaults and meanings. What it changes about reading a scene is the readers' business.
use crate::args::Compat;

/// Defaults and meanings that depend on `--compat`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Habits {
    /// Passes when neither passes nor a time are said.
    pub(crate) passes: u64,
    /// What `--depth` means unsaid; `None` leaves it to the algorithm.
    depth: Option<u32>,
    /// Of a depth of N, this many are not scatterings: NRenderer counts surfaces met, of which the last only emits.
    not_scattering: u32,
}

const OURS: Habits = Habits { passes: 64, depth: None, not_scattering: 0 };

const NRENDERER: Habits = Habits { passes: 16, depth: Some(4), not_scattering: 1 };

impl Habits {
    /// Those of the program, or our own.
    pub(crate) fn of(compat: Option<Compat>) -> Self {
        match compat {
            None => OURS,
            Some(Compat::Nrenderer) => NRENDERER,
        }
    }
    /// Scatterings at most for what `--depth` says; `None` leaves it to the algorithm.
    pub(crate) fn scatterings(&self, depth: Option<u32>) -> Result<Option<u32>, String> {
        let Some(depth) = depth.or(self.depth) else { return Ok(None) };
        depth.checked_sub(self.not_scattering).map(Some).ok_or_else(|| {
            format!(
                "with --compat nrenderer, --depth counts the surfaces a path meets: {} or more",
                self.not_scattering
            )
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_depth_of_nrenderer_scatters_once_less_than_it_meets_surfaces() {
        let theirs = Habits::of(Some(Compat::Nrenderer));
        assert_eq!(theirs.scatterings(None), Ok(Some(3)));
        assert_eq!(theirs.scatterings(Some(1)), Ok(Some(0)));
        assert!(theirs.scatterings(Some(0)).is_err());
        assert_eq!((OURS.scatterings(None), OURS.scatterings(Some(0))), (Ok(None), Ok(Some(0))));
    }
}
