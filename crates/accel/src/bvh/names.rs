//! Numbers for the triangles of all meshes of a table, half as long as mesh and triangle together.

use super::Geometry;

/// Each mesh starts at a multiple of this many numbers, so that one look into a small table tells a number's mesh.
const PAGE: u32 = 64;

/// A run of numbers that belong to one mesh.
#[derive(Clone, Copy)]
struct Page {
    geometry: u32,
    /// The triangle that has the first number.
    primitive: u32,
}

/// Which triangle has which number.
#[derive(Default)]
pub(super) struct Names {
    pages: Vec<Page>,
}

impl Names {
    /// Numbers for the triangles of some geometries, and the first number of each geometry.
    pub(super) fn new(geometries: &[Geometry]) -> (Self, Vec<u32>) {
        let mut names = Self::default();
        let number = |(geometry, shape): (usize, &Geometry)| {
            let first = names.count();
            let count = if let Geometry::Triangles { indices, .. } = shape { indices.len() as u32 } else { 0 };
            let page = |primitive| Page { geometry: geometry as u32, primitive };
            names.pages.extend((0..count).step_by(PAGE as usize).map(page));
            first
        };
        let firsts = geometries.iter().enumerate().map(number).collect();
        (names, firsts)
    }

    /// How many numbers there are, of which some may belong to no triangle.
    pub(super) fn count(&self) -> u32 {
        assert!(self.pages.len() < (u32::MAX / PAGE) as usize, "too many meshes");
        self.pages.len() as u32 * PAGE
    }

    /// Gives the numbers of another object the next places.
    pub(super) fn append(&mut self, other: Self) {
        self.pages.extend(other.pages);
    }

    /// Geometry and primitive of a triangle.
    #[inline(always)]
    pub(super) fn of(&self, number: u32) -> (u32, u32) {
        let page = self.pages[(number / PAGE) as usize];
        (page.geometry, page.primitive + number % PAGE)
    }

    pub(super) fn memory_bytes(&self) -> usize {
        size_of_val(self.pages.as_slice())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::Vec3;

    #[test]
    fn every_triangle_has_its_own_number_and_is_found_by_it() {
        let positions = [Vec3::X, Vec3::Y, Vec3::Z];
        let meshes = [0, 1, 63, 64, 65, 200].map(|count| vec![[0, 1, 2]; count]);
        let mut geometries: Vec<_> =
            meshes.iter().map(|indices| Geometry::Triangles { positions: &positions, indices }).collect();
        geometries.insert(2, Geometry::Sphere { centre: Vec3::ZERO, radius: 1.0 });
        let (mut names, _) = Names::new(&geometries[4..]);
        let shift = names.count();
        let (more, firsts) = Names::new(&geometries);
        names.append(more);
        for (geometry, shape) in geometries.iter().enumerate() {
            let Geometry::Triangles { indices, .. } = shape else { continue };
            for primitive in 0..indices.len() as u32 {
                assert_eq!(names.of(shift + firsts[geometry] + primitive), (geometry as u32, primitive));
            }
        }
    }
}
