//! The interiors that a walk is in.
use super::InteriorId;

/// What surrounds a piece of a path: empty space, or an interior.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub struct Medium {
    /// One more than the interior's number; 0 is empty space.
    id: u16,
    /// As it counts here.
    priority: u16,
}

impl Medium {
    /// Empty space.
    pub const VACUUM: Self = Self { id: 0, priority: 0 };
    /// The interior; `None` in empty space.
    #[inline]
    pub fn interior(self) -> Option<InteriorId> {
        self.id.checked_sub(1).map(InteriorId)
    }
    /// Whether a path in this medium sees nothing of a surface with the interior `id` behind it, which has the given
    /// priority, and which the path would enter or leave.
    #[inline]
    pub(crate) fn hides(self, id: InteriorId, priority: u16, entering: bool) -> bool {
        let other = self.id != 0 && self.id != id.0 + 1;
        priority > 0 && if entering { other && priority < self.priority } else { other && priority <= self.priority }
    }
}

/// How many interiors a walk can be in at once; one that is entered beyond them is forgotten.
pub const DEPTH: usize = 8;

/// The interiors that a walk is in, in the order in which it entered them.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub struct Inside {
    entered: [Medium; DEPTH],
    len: u8,
}

impl Inside {
    /// In empty space.
    pub const NOTHING: Self = Self { entered: [Medium::VACUUM; DEPTH], len: 0 };

    /// The one that counts: of the highest priority, and of those the one that was entered last.
    #[inline]
    pub fn medium(&self) -> Medium {
        let higher = |best: Medium, &m: &Medium| if m.priority >= best.priority { m } else { best };
        self.entered[..usize::from(self.len)].iter().fold(Medium::VACUUM, higher)
    }
    /// Enters `id`; one without priority (0) takes the place of what counts here. False if there are too many.
    pub(crate) fn enter(&mut self, id: InteriorId, priority: u16) -> bool {
        let priority = if priority > 0 { priority } else { self.medium().priority };
        let Some(free) = self.entered.get_mut(usize::from(self.len)) else { return false };
        *free = Medium { id: id.0 + 1, priority };
        self.len += 1;
        true
    }
    /// Leaves `id`, where it was entered last; nothing happens if it was not.
    pub(crate) fn leave(&mut self, id: InteriorId) {
        let len = usize::from(self.len);
        if let Some(i) = self.entered[..len].iter().rposition(|m| m.id == id.0 + 1) {
            self.entered.copy_within(i + 1..len, i);
            self.len -= 1;
        }
    }
    /// After entering or leaving `id`.
    #[must_use]
    pub(crate) fn past(mut self, id: InteriorId, priority: u16, entering: bool) -> Self {
        if entering {
            self.enter(id, priority);
        } else {
            self.leave(id);
        }
        self
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const GLASS: InteriorId = InteriorId(0);
    const WATER: InteriorId = InteriorId(1);

    fn now(inside: &Inside) -> Option<InteriorId> {
        inside.medium().interior()
    }

    #[test]
    fn the_highest_priority_counts_and_of_equals_the_last() {
        let mut inside = Inside::NOTHING;
        assert_eq!(now(&inside), None);
        for (id, priority, want) in [(WATER, 1, WATER), (GLASS, 2, GLASS), (WATER, 1, GLASS)] {
            assert!(inside.enter(id, priority));
            assert_eq!(now(&inside), Some(want));
        }
        inside.leave(WATER);
        inside.leave(GLASS);
        assert_eq!(now(&inside), Some(WATER));
        inside.leave(GLASS);
        inside.leave(WATER);
        assert_eq!(inside.medium(), Medium::VACUUM);
        // Without priority, the last one counts, in whatever it is.
        for id in [GLASS, WATER, GLASS] {
            inside.enter(id, 0);
            assert_eq!(now(&inside), Some(id));
        }
        let mut inside = Inside::NOTHING;
        inside.enter(GLASS, 7);
        inside.enter(WATER, 0);
        assert_eq!(now(&inside), Some(WATER));
        inside.leave(WATER);
        assert_eq!(now(&inside), Some(GLASS));
    }

    #[test]
    fn a_full_stack_forgets_what_is_entered_next() {
        let mut inside = Inside::NOTHING;
        for i in 0..DEPTH as u16 {
            assert!(inside.enter(InteriorId(i), 0));
        }
        let full = inside;
        assert!(!inside.enter(InteriorId(99), 0));
        inside.leave(InteriorId(99));
        assert_eq!(inside, full);
    }

    /// Along any line, what is hidden is exactly what does not change the medium.
    #[test]
    fn a_surface_is_hidden_where_it_changes_nothing() {
        let priorities = [3, 1, 2, 2];
        // Every order of entering and leaving four interiors, as digits of a number.
        for code in 0..4u32.pow(8) {
            let mut inside = Inside::NOTHING;
            let mut within = [false; 4];
            for step in 0..8 {
                let which = (code >> (2 * step) & 3) as usize;
                let (id, priority) = (InteriorId(which as u16), priorities[which]);
                let before = inside.medium();
                let hidden = before.hides(id, priority, !within[which]);
                inside = inside.past(id, priority, !within[which]);
                within[which] = !within[which];
                assert_eq!(hidden, inside.medium() == before, "{code} {step}");
            }
        }
    }
}
