//! An algorithm's picture of a tiny scene as block means with variances.
use sunfleck::{
    film::{FilmSpec, Filter, PassImage},
    integrator::{Entry, Params, Pass},
    scene::Scene,
    spectrum::ColorMode,
};

/// Edge of a picture and of a block in pixels.
const SIZE: u32 = 24;
const BLOCK: usize = 6;
const BLOCKS_A_ROW: usize = SIZE as usize / BLOCK;

/// A mean over passes and the variance of that mean.
#[derive(Clone, Copy, Default)]
pub(crate) struct Moment {
    pub(crate) mean: f64,
    pub(crate) variance: f64,
}

/// Means of blocks (channel by channel) and of whole pictures.
pub(crate) struct Estimate {
    pub(crate) name: &'static str,
    pub(crate) blocks: Vec<Moment>,
    picture: Moment,
}

impl Estimate {
    pub(crate) fn picture(&self) -> Moment {
        self.picture
    }
}

/// Sums of values and squares over passes.
#[derive(Clone, Copy, Default)]
struct Sums(f64, f64);

impl Sums {
    fn add(&mut self, v: f64) {
        self.0 += v;
        self.1 += v * v;
    }
    fn moment(self, n: f64) -> Moment {
        let mean = self.0 / n;
        Moment { mean, variance: ((self.1 / n - mean * mean) / (n - 1.0)).max(0.0) }
    }
}

/// Wavelengths and times are even over so many successive passes; taken one by one, passes would seem as different as their
/// colours or moments.
const EVEN: u64 = 16;

pub(crate) fn estimate(scene: &Scene, entry: &Entry, passes: u64) -> Estimate {
    let name = entry.name;
    let integrator = entry.build(settings(entry)).expect("settings of this file");
    let spec = FilmSpec { width: SIZE, height: SIZE, filter: Filter::Box };
    // A seed of its own for each algorithm: shared noise must not pass for agreement.
    let seed = name.bytes().fold(17, |h: u64, b| h.wrapping_mul(31) + u64::from(b));
    let color = if scene.is_dispersive() { ColorMode::Spectral } else { ColorMode::Rgb };
    // Passes that build on each other say nothing of the error of their mean; several renders do.
    let size = if scene.is_dispersive() || scene.moves() || !entry.mergeable { EVEN } else { 1 };
    let mut prepared = integrator.prepare(scene, spec, seed);
    let mut image = PassImage::new(spec);
    let mut blocks = vec![Sums::default(); BLOCKS_A_ROW * BLOCKS_A_ROW * 3];
    let mut picture = Sums::default();
    let mut group = vec![0.0; blocks.len()];
    for number in 0..passes {
        let render = if entry.mergeable { 0 } else { number / size };
        if render > 0 && number % size == 0 {
            prepared = integrator.prepare(scene, spec, seed + render);
        }
        image.clear();
        let pass = Pass::new(seed + render, number - render * size);
        prepared.render_pass(&pass.colored(color), &mut image);
        group.iter_mut().zip(block_means(&image)).for_each(|(sum, m)| *sum += m / size as f64);
        if (number + 1) % size == 0 {
            blocks.iter_mut().zip(&group).for_each(|(s, m)| s.add(*m));
            picture.add(group.iter().sum::<f64>() / group.len() as f64);
            group.fill(0.0);
        }
    }
    let n = (passes / size) as f64;
    Estimate { name, blocks: blocks.into_iter().map(|s| s.moment(n)).collect(), picture: picture.moment(n) }
}

/// Few pixels need more photons and smaller kernels than a whole picture would.
fn settings(entry: &Entry) -> Params {
    let photons = if entry.name == "bdpt" { "1000" } else { "4000" };
    let mut params = Params::default();
    for (key, value) in [("photons", photons), ("radius", "0.05"), ("final-gather", "1")] {
        if entry.params.iter().any(|p| p.name == key) {
            params.set(key, value);
        }
    }
    params
}

fn block_means(image: &PassImage) -> Vec<f64> {
    let mut sums = vec![0.0; BLOCKS_A_ROW * BLOCKS_A_ROW * 3];
    for (i, p) in image.pixels().iter().enumerate() {
        let (x, y) = (i % SIZE as usize / BLOCK, i / SIZE as usize / BLOCK);
        for c in 0..3 {
            sums[(y * BLOCKS_A_ROW + x) * 3 + c] += f64::from(p[c]);
        }
    }
    sums.iter().map(|s| s / (BLOCK * BLOCK) as f64).collect()
}
