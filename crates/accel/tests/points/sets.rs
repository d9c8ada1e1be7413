//! Point sets that give trouble, and brute-force answers.

use glam::Vec3;

/// Deterministic uniform numbers in [0, 1).
pub(crate) struct Uniform(pub(crate) u64);

impl Uniform {
    pub(crate) fn next(&mut self) -> f32 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        ((z ^ (z >> 31)) >> 40) as f32 / (1 << 24) as f32
    }

    pub(crate) fn vec3(&mut self) -> Vec3 {
        Vec3::new(self.next(), self.next(), self.next())
    }
}

/// A named set with a length that makes sense as a search radius in it.
pub(crate) struct Set {
    pub(crate) name: &'static str,
    pub(crate) points: Vec<Vec3>,
    pub(crate) scale: f32,
}

fn set(name: &'static str, scale: f32, count: usize, mut point: impl FnMut(&mut Uniform, usize) -> Vec3) -> Set {
    let mut u = Uniform(count as u64);
    Set { name, scale, points: (0..count).map(|i| point(&mut u, i)).collect() }
}

/// Sets of up to a few thousand points.
pub(crate) fn all() -> Vec<Set> {
    vec![
        set("none", 1.0, 0, |u, _| u.vec3()),
        set("one", 1.0, 1, |u, _| u.vec3()),
        set("uniform", 0.1, 3000, |u, _| u.vec3() - 0.5),
        set("clustered", 0.01, 3000, |u, i| {
            if i % 3 == 0 { u.vec3() * 10.0 } else { Vec3::splat((i % 5) as f32) + (u.vec3() - 0.5) * 0.02 }
        }),
        set("flat", 0.05, 3000, |u, _| u.vec3() * Vec3::new(1.0, 0.0, 1.0)),
        set("line", 0.01, 2000, |u, _| Vec3::new(0.0, u.next() - 0.5, 2.0)),
        set("identical", 1.0, 2000, |_, _| Vec3::new(0.3, -0.7, 11.0)),
        set("few places", 0.3, 2000, |u, _| (u.vec3() * 4.0).floor() * 0.25),
        set("far away", 0.001, 2000, |u, _| Vec3::new(1e6, -1e6, 1e6) + u.vec3()),
        set("far apart", 0.02, 2000, |u, i| u.vec3() * 10f32.powi(i as i32 % 12 - 4)),
        set("huge", 1e36, 500, |u, _| (u.vec3() - 0.5) * 3e38),
        set("tiny", 1e-24, 500, |u, _| (u.vec3() - 0.5) * 1e-23),
        set("broken", 0.1, 1000, |u, i| match i % 7 {
            0 => Vec3::new(f32::NAN, 0.5, 0.5),
            1 => Vec3::new(0.5, f32::INFINITY, 0.5),
            2 => Vec3::new(0.5, 0.5, f32::NEG_INFINITY),
            _ => u.vec3(),
        }),
        set("all broken", 0.1, 100, |_, _| Vec3::NAN),
    ]
}

impl Set {
    /// Queries among the points, between them, on them and far from all of them.
    pub(crate) fn queries(&self) -> Vec<Vec3> {
        let mut u = Uniform(7);
        let mut queries = vec![Vec3::ZERO, Vec3::splat(3.0 * self.scale), Vec3::splat(-1e9), Vec3::splat(3e38)];
        for p in self.points.iter().step_by(self.points.len() / 25 + 1) {
            queries.extend([*p, *p + (u.vec3() - 0.5) * self.scale]);
        }
        queries
    }

    /// All (squared distance, index) within `r`, nearest first, equal distances by index.
    pub(crate) fn within(&self, p: Vec3, r: f32) -> Vec<(f32, u32)> {
        let finite = self.points.iter().zip(0..).filter(|(q, _)| q.is_finite() && p.is_finite());
        let mut found: Vec<_> = finite.map(|(q, i)| (p.distance_squared(*q), i)).collect();
        found.retain(|(d2, _)| r >= 0.0 && *d2 <= r * r);
        found.sort_by(|a, b| a.partial_cmp(b).expect("no NaN"));
        found
    }
}

/// Runs `work` with so many threads.
pub(crate) fn with_threads<T: Send>(count: usize, work: impl FnOnce() -> T + Send) -> T {
    rayon::ThreadPoolBuilder::new().num_threads(count).build().expect("a thread pool").install(work)
}
