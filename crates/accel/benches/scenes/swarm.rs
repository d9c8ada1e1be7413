//! S3, "swarm": small noisy spheres in a Cornell box, all of them placed copies of one, which drift while the shutter is open.

use crate::scenes::{Mesh, Rng, noisy_sphere};
use accel::{Bvh, Geometry, Hit, Instance, Objects, Quality};
use glam::{Affine3A, Mat3A, Vec3, Vec3A};

/// The room stands still; a copy is placed by a map and drifts by a vector.
pub(crate) struct Swarm {
    meshes: [Mesh; 2],
    copies: Vec<(Affine3A, Vec3)>,
}

impl Swarm {
    pub(crate) fn new(copies: usize) -> Self {
        let mut rng = Rng::new(7);
        let mut place = |_| {
            let turned = Mat3A::from_rotation_y(rng.uniform() * std::f32::consts::TAU);
            let map =
                Affine3A { matrix3: turned * (0.02 + 0.06 * rng.uniform()), translation: (rng.cube() * 0.9).into() };
            (map, rng.cube() * 0.1)
        };
        let copies = (0..copies).map(&mut place).collect();
        let mut room = Mesh::default();
        room.add_room();
        Self { meshes: [room, noisy_sphere(4)], copies }
    }

    /// The hierarchies of room and sphere.
    pub(crate) fn objects(&self) -> Objects {
        let geometry =
            self.meshes.each_ref().map(|m| Geometry::Triangles { positions: &m.positions, indices: &m.indices });
        Objects::build(&[&geometry[..1], &geometry[1..]], Quality::Default)
    }

    /// Everything at `time`, from 0 to 1.
    pub(crate) fn at(&self, objects: &Objects, time: f32) -> Bvh {
        let room = Instance { object: 0, world_from_object: Affine3A::IDENTITY };
        let copies = self.copies.iter().map(|&(map, drift)| Instance {
            object: 1,
            world_from_object: Affine3A { translation: map.translation + Vec3A::from(drift * time), ..map },
        });
        objects.place(&[], &std::iter::once(room).chain(copies).collect::<Vec<_>>(), Quality::Default)
    }

    /// The normal at a hit, of either side.
    pub(crate) fn normal(&self, hit: &Hit) -> Vec3 {
        match hit.instance {
            0 => self.meshes[0].normal(hit),
            // The maps only turn and scale alike along all axes.
            copy => (self.copies[copy as usize - 1].0.matrix3 * self.meshes[1].normal(hit)).normalize(),
        }
    }
}
