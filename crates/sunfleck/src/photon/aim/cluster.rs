//! Spheres around groups of points, coarse and fine.
use super::Target;
use glam::Vec3;

/// Points that make a group at least.
const LEAST: usize = 8;

/// A group of points, as places in the list.
struct Group {
    members: Vec<usize>,
    mass: f32,
    sphere: Target,
    extent: Vec3,
}

/// Spheres around points.
#[derive(Default)]
pub(super) struct Spheres {
    /// One around all, and others twice, four times, … as large, up to the size of the world: what the points have missed
    /// is mostly near.
    pub(super) wide: Vec<Target>,
    /// Around ever smaller groups.
    pub(super) tight: Vec<Target>,
}

/// Spheres around `points` (with their masses) and around ever smaller groups of them, until there are `leaves` groups that
/// are not divided further, or none that can be. Groups of great mass and extent are divided first. `world` is the radius
/// that none reaches.
pub(super) fn spheres(points: &[(Vec3, f32)], leaves: usize, world: f32) -> Spheres {
    let mut all = Spheres::default();
    let mut open: Vec<Group> = Group::new(points, (0..points.len()).collect()).into_iter().collect();
    if let Some(root) = open.first() {
        let radii = std::iter::successors(Some(root.sphere.radius), |r| Some(2.0 * r)).take_while(|r| *r < world);
        all.wide.extend(radii.map(|radius| Target { radius, ..root.sphere }));
    }
    while open.len() < leaves {
        let weight = |g: &Group| g.mass * g.extent.max_element();
        let Some(largest) = (0..open.len()).max_by(|&a, &b| weight(&open[a]).total_cmp(&weight(&open[b]))) else {
            break;
        };
        let group = open.swap_remove(largest);
        let parts: Vec<Group> = group.halves(points).into_iter().filter_map(|m| Group::new(points, m)).collect();
        all.tight.extend(parts.iter().map(|g| g.sphere));
        open.extend(parts);
    }
    all
}

impl Group {
    fn new(points: &[(Vec3, f32)], members: Vec<usize>) -> Option<Self> {
        if members.len() < LEAST {
            return None;
        }
        let places = || members.iter().map(|&i| points[i].0);
        let (low, high) = places().fold((Vec3::MAX, Vec3::MIN), |(l, h), p| (l.min(p), h.max(p)));
        let centre = 0.5 * (low + high);
        let reach = places().map(|p| p.distance(centre)).fold(0.0, f32::max);
        // The points are a sample: what they are drawn from reaches a little farther.
        let radius = reach * (1.0 + 1.0 / (members.len() as f32).sqrt());
        let mass = members.iter().map(|&i| points[i].1).sum();
        let sphere = Target { centre, radius };
        (radius > 0.0 && radius.is_finite()).then_some(Self { members, mass, sphere, extent: high - low })
    }
    /// Parts the members at the middle of mass along the longest side.
    fn halves(&self, points: &[(Vec3, f32)]) -> [Vec<usize>; 2] {
        let axis = self.extent.max_position();
        let sum: f32 = self.members.iter().map(|&i| points[i].0[axis] * points[i].1).sum();
        let middle = sum / self.mass.max(f32::MIN_POSITIVE);
        let (low, high) = self.members.iter().partition(|&&i| points[i].0[axis] < middle);
        [low, high]
    }
}

impl Spheres {
    /// All, wide ones first.
    pub(super) fn iter(&self) -> impl Iterator<Item = &Target> {
        self.wide.iter().chain(&self.tight)
    }
}
