//! What filtered textures promise: the same picture in the mean over a pixel, with less noise from the first pass on.
use glam::{Affine2, Vec2, Vec3};
use sunfleck::{
    bsdf::{DielectricMaterial, DiffuseMaterial, MirrorMaterial},
    camera::{Perspective, View},
    film::{FilmSpec, Filter, PassImage},
    integrator::{Params, Pass, find},
    light::DirectionalLight,
    scene::{Scene, SceneBuilder},
    shape::{Parallelogram, Shape},
    spectrum::{Rgb, Wavelengths},
    texture::{
        Checkerboard, Footprint, ImageTexture, Lookup, Mapped, Mix, Product, Texture, TextureId, UvMap, UvSet, Wrap,
    },
};

const WRAPS: [Wrap; 3] = [Wrap::Repeat, Wrap::Clamp, Wrap::Mirror];

fn noise(w: usize, h: usize, wrap: Wrap) -> ImageTexture {
    let pixels = (0..w * h).map(|i| Rgb::new((i * 7 % 11) as f32, (i % w) as f32, (i * i % 5) as f32));
    ImageTexture::new(w, h, pixels.collect(), wrap).unwrap()
}

fn square(side: f32) -> Footprint {
    Footprint { sides: [side * Vec2::X, side * Vec2::Y] }
}

#[test]
fn a_footprint_as_large_as_a_picture_sees_its_mean_whatever_its_size() {
    for (w, h) in [(5, 4), (7, 3), (64, 64), (33, 1), (1, 6), (100, 31)] {
        let t = noise(w, h, Wrap::Repeat);
        let mean = t.mean();
        for at in [Vec2::ZERO, Vec2::new(0.3, 0.8), Vec2::new(-7.2, 3.1)] {
            let size = Vec2::new(w as f32, h as f32) / (2 * w.max(h)) as f32;
            let seen = t.filtered(at, &Footprint { sides: [Vec2::X / size, Vec2::Y / size] });
            assert!((seen - mean).abs().max_element() < 2e-3 * mean.max_element(), "{w} x {h}: {seen} for {mean}");
        }
        // At every level in between, the mean over the square is kept.
        for side in [0.1, 0.25, 0.5] {
            let n = 240;
            let point = |i: usize| Vec2::new((i % n) as f32 + 0.5, (i / n) as f32 + 0.5) / n as f32;
            let sum: Vec3 = (0..n * n).map(|i| t.filtered(point(i), &square(side))).sum();
            let over = sum / (n * n) as f32;
            assert!(
                (over - mean).abs().max_element() < 5e-3 * mean.max_element(),
                "{w} x {h}, {side}: {over} for {mean}"
            );
        }
    }
}

#[test]
fn a_footprint_of_less_than_a_pixel_sees_what_a_point_does() {
    for wrap in WRAPS {
        let t = noise(8, 4, wrap);
        for i in 0..100 {
            let at = Vec2::new(i as f32 * 0.037 - 1.0, i as f32 * 0.053 - 2.0);
            assert_eq!(t.filtered(at, &Footprint { sides: [Vec2::X / 8.0, Vec2::Y / 4.0] }), t.eval(at));
        }
    }
}

#[test]
fn smaller_versions_go_on_beyond_their_edges_as_the_picture_does() {
    // The left half is black, the right half white.
    let pixels: Vec<Rgb> = (0..64 * 64).map(|i| Rgb::splat(if i % 64 < 32 { 0.0 } else { 1.0 })).collect();
    let picture = |wrap| ImageTexture::new(64, 64, pixels.clone(), wrap).unwrap();
    for (wrap, right, left, beyond) in
        [(Wrap::Repeat, 0.5, 0.5, 0.0), (Wrap::Clamp, 1.0, 0.0, 1.0), (Wrap::Mirror, 1.0, 0.0, 1.0)]
    {
        let seen = |u: f32| picture(wrap).filtered(Vec2::new(u, 0.5), &square(8.0 / 64.0)).x;
        for (u, want) in [(1.0, right), (0.0, left), (1.25, beyond), (0.5, 0.5)] {
            assert!((seen(u) - want).abs() < 1e-3, "{wrap:?} at {u}: {} for {want}", seen(u));
        }
    }
}

#[test]
fn long_footprints_blur_along_their_length_alone() {
    // Stripes along v: a footprint along them sees one, a footprint across them all.
    let pixels: Vec<Rgb> = (0..64 * 64).map(|i| Rgb::splat(if i % 64 / 8 % 2 == 0 { 0.0 } else { 1.0 })).collect();
    let t = ImageTexture::new(64, 64, pixels, Wrap::Repeat).unwrap();
    let thin = 1.0 / 64.0;
    let at = Vec2::new(12.0 / 64.0, 0.4);
    let along = t.filtered(at, &Footprint { sides: [thin * Vec2::X, 0.25 * Vec2::Y] }).x;
    let across = t.filtered(at, &Footprint { sides: [thin * Vec2::Y, 0.25 * Vec2::X] }).x;
    assert!((along - 1.0).abs() < 1e-3 && (across - 0.5).abs() < 0.01, "{along} {across}");
}

fn look(textures: &[Texture], uv: Vec2, footprint: Footprint) -> Rgb {
    let at = Lookup { footprint, ..Lookup::new(textures, uv, Vec3::ZERO, Wavelengths::Rgb) };
    let id = TextureId(textures.len() as u32 - 1);
    let rgb = at.rgb(id);
    assert_eq!(rgb, Lookup::new(textures, uv, Vec3::ZERO, Wavelengths::Rgb).rgb(id), "numbers are those of the point");
    at.spectrum(id).to_rgb(Wavelengths::Rgb)
}

#[test]
fn a_checkerboard_is_the_mean_of_what_lies_under_the_footprint() {
    let [black, white] = [Rgb::ZERO, Rgb::ONE].map(|c| Texture::Constant(c.into()));
    let map = UvMap { scale: Vec2::new(4.0, 2.0), offset: Vec2::splat(0.1) };
    let board = Texture::Checkerboard(Checkerboard { of: [TextureId(0), TextureId(1)], map });
    let textures = [black, white, board];
    for (i, side) in (0..60).zip([0.02, 0.1, 0.3, 1.0, 3.7].into_iter().cycle()) {
        let uv = Vec2::new(i as f32 * 0.0371, i as f32 * 0.0533);
        let footprint = Footprint { sides: [side / 4.0 * Vec2::X, side / 2.0 * Vec2::Y] };
        let n = 200;
        let point = |k: usize| Vec2::new((k % n) as f32 + 0.5, (k / n) as f32 + 0.5) / n as f32 - 0.5;
        let sum: f32 = (0..n * n)
            .map(|k| look(&textures, uv + point(k) * Vec2::new(side / 4.0, side / 2.0), Footprint::POINT).x)
            .sum();
        let (seen, want) = (look(&textures, uv, footprint).x, sum / (n * n) as f32);
        assert!((seen - want).abs() < 0.02, "{uv}, {side}: {seen} for {want}");
    }
}

#[test]
fn textures_that_vary_together_are_looked_up_at_points() {
    // Between stripes of one pixel values are even over [0, 1]: the mean of a² is 1/3, that of a (1 − a) + a/2 is 5/12.
    let stripes = |a: f32, b: f32| {
        let pixels = (0..256).map(|i| Rgb::splat(if i % 2 == 0 { a } else { b })).collect();
        Texture::Image(ImageTexture::new(16, 16, pixels, Wrap::Repeat).unwrap())
    };
    let product = Texture::Product(Product { of: [TextureId(0), TextureId(0)] });
    let mix = Texture::Mix(Mix { from: TextureId(0), to: TextureId(1), amount: TextureId(0) });
    let even = Texture::Product(Product { of: [TextureId(0), TextureId(2)] });
    let half = Texture::Constant(Rgb::splat(0.5).into());
    let mapped =
        Texture::Mapped(Mapped { of: TextureId(0), map: Affine2::from_scale(Vec2::splat(3.0)), set: UvSet::First });
    let (n, wide) = (160, square(0.5));
    for (kind, last, want) in
        [("product", product, 1.0 / 3.0), ("mix", mix, 5.0 / 12.0), ("even", even, 0.25), ("mapped", mapped, 0.5)]
    {
        let textures = [stripes(0.0, 1.0), stripes(0.5, 0.5), half.clone(), last];
        let mean = (0..n).map(|i| look(&textures, Vec2::new(i as f32 / n as f32, 0.3), wide).x).sum::<f32>() / n as f32;
        assert!((mean - want).abs() < 0.01, "{kind}: {mean} for {want}");
    }
}

/// A chequered floor up to the horizon in the light of a sun, seen straight, in a mirror, or through a pane.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Way {
    Straight,
    Mirror,
    Pane,
}

fn floor(way: Way, picture: bool) -> Scene {
    let mut b = SceneBuilder::new();
    let [black, white] = [0.0, 0.8].map(|c| b.constant(Rgb::splat(c)));
    // Squares of side 0.25 on a floor of 80.
    let reflectance = if picture {
        let pixels = (0..64 * 64).map(|i| Rgb::splat(if (i + i / 64) % 2 == 0 { 0.0 } else { 0.8 })).collect();
        let of = b.texture(Texture::Image(ImageTexture::new(64, 64, pixels, Wrap::Repeat).unwrap()));
        b.texture(Texture::Mapped(Mapped { of, map: Affine2::from_scale(Vec2::splat(5.0)), set: UvSet::First }))
    } else {
        let map = UvMap { scale: Vec2::splat(320.0), offset: Vec2::ZERO };
        b.texture(Texture::Checkerboard(Checkerboard { of: [black, white], map }))
    };
    let tiles = b.material(DiffuseMaterial { reflectance });
    let ground = Parallelogram::new(Vec3::new(-40.0, 0.0, 40.0), 80.0 * Vec3::X, -80.0 * Vec3::Z);
    b.add(Shape::Parallelogram(ground), tiles);
    let upright =
        |z: f32| Shape::Parallelogram(Parallelogram::new(Vec3::new(-9.0, -1.0, z), 18.0 * Vec3::X, 9.0 * Vec3::Y));
    let one = b.constant(Rgb::ONE);
    match way {
        Way::Straight => {}
        Way::Mirror => {
            let mirror = b.material(MirrorMaterial { reflect: one });
            b.add(upright(-1.0), mirror);
        }
        Way::Pane => {
            // Its sides look away from each other.
            let pane = b.material(DielectricMaterial { eta: 1.5.into(), reflectance: one, transmittance: one });
            b.add(upright(9.0), pane);
            let back = Parallelogram::new(Vec3::new(9.0, -1.0, 8.9), -18.0 * Vec3::X, 9.0 * Vec3::Y);
            b.add(Shape::Parallelogram(back), pane);
        }
    }
    // The mirror stands before the eye, and shows the floor behind it.
    let (position, look_at) = (Vec3::new(0.0, 1.5, 10.0), Vec3::new(0.0, 0.0, -2.0));
    b.camera(Perspective::new(&View { position, look_at, up: Vec3::Y }, 30.0, 1.0).unwrap());
    b.light(DirectionalLight::new(Vec3::new(0.2, -1.0, 0.1).normalize(), Rgb::splat(2.0)).unwrap());
    b.build().unwrap()
}

const SIZE: u32 = 24;
/// Rows just below the horizon, all of them in the mirror where there is one.
const FAR: std::ops::Range<usize> = 7..12;

fn passes(scene: &Scene, algorithm: &str, filter: &str, count: u64) -> Vec<Vec<f64>> {
    let mut params = Params::default();
    params.set("texture-filter", filter);
    let integrator = find(algorithm).unwrap().build(params).unwrap();
    let spec = FilmSpec { width: SIZE, height: SIZE, filter: Filter::Box };
    let prepared = integrator.prepare(scene, spec, if filter == "on" { 1 } else { 2 });
    let one = |index: u64| {
        let mut image = PassImage::new(spec);
        prepared.render_pass(&Pass::new(if filter == "on" { 5 } else { 6 }, index), &mut image);
        image.pixels().iter().map(|p| f64::from(p[0])).collect()
    };
    (0..count).map(one).collect()
}

/// Mean and variance of the mean.
fn moment(values: impl Iterator<Item = f64> + Clone) -> (f64, f64) {
    let n = values.clone().count() as f64;
    let mean = values.clone().sum::<f64>() / n;
    (mean, values.map(|v| (v - mean) * (v - mean)).sum::<f64>() / (n * (n - 1.0)))
}

#[test]
fn a_chequered_floor_has_the_same_mean_and_far_less_noise_straight_mirrored_and_through_a_pane() {
    for (way, picture) in [Way::Straight, Way::Mirror, Way::Pane].into_iter().flat_map(|w| [(w, false), (w, true)]) {
        let scene = floor(way, picture);
        let [on, off] = ["on", "off"].map(|filter| passes(&scene, "path", filter, 256));
        // Rows of the picture: far ones have many squares a pixel, near ones several pixels a square.
        for row in 0..SIZE as usize {
            let of = |all: &[Vec<f64>]| -> Vec<f64> {
                let row = |p: &Vec<f64>| p[row * SIZE as usize..(row + 1) * SIZE as usize].iter().sum::<f64>();
                all.iter().map(row).collect()
            };
            let ((a, va), (b, vb)) = (moment(of(&on).into_iter()), moment(of(&off).into_iter()));
            assert!(
                (a - b).abs() <= 4.5 * (va + vb).sqrt() + 0.01 * b.abs() + 1e-6,
                "{way:?} {picture} row {row}: {a} and {b}, variances {va:e} {vb:e}"
            );
        }
        let total =
            |all: &[Vec<f64>]| moment(all.iter().map(|p| p.iter().sum::<f64>()).collect::<Vec<_>>().into_iter());
        let ((a, va), (b, vb)) = (total(&on), total(&off));
        assert!((a - b).abs() <= 4.0 * (va + vb).sqrt() + 1e-3 * b, "{way:?} {picture}: {a} and {b}");
        if way == Way::Pane {
            // What the pane reflects is noise of its own.
            continue;
        }
        // One pass, by pixel: how far from the mean of all without a filter, where there are many squares a pixel.
        let pixels = (SIZE * SIZE) as usize;
        let reference: Vec<f64> = (0..pixels).map(|i| off.iter().map(|p| p[i]).sum::<f64>() / 256.0).collect();
        let far = |i: &usize| FAR.contains(&(i / SIZE as usize));
        let error = |p: &[f64]| (0..pixels).filter(&far).map(|i| (p[i] - reference[i]).powi(2)).sum::<f64>();
        let (with, without) = (error(&on[0]), error(&off[0]));
        // What is interpolated varies less from the beginning.
        let share = if picture { 0.4 } else { 0.1 };
        assert!(with < share * without, "{way:?} {picture}: {with} and {without}");
    }
}

#[test]
fn a_pane_does_not_end_the_cone() {
    // Most paths go through the pane: of a first pass, the middle of what far pixels deviate by tells.
    let scene = floor(Way::Pane, true);
    let [on, off] = ["on", "off"].map(|filter| passes(&scene, "path", filter, 1));
    let spread = |p: &[f64]| {
        let mut sorted = p[FAR.start * SIZE as usize..FAR.end * SIZE as usize].to_vec();
        sorted.sort_by(f64::total_cmp);
        sorted[sorted.len() * 8 / 10] - sorted[sorted.len() * 3 / 10]
    };
    assert!(spread(&on[0]) < 0.3 * spread(&off[0]), "{} {}", spread(&on[0]), spread(&off[0]));
}

#[test]
fn light_that_is_joined_to_the_camera_sees_the_floor_as_the_camera_does() {
    // Half of the board is black, where no light path goes on and no photon would be kept for what is black.
    for picture in [true, false] {
        agree_on(&floor(Way::Straight, picture));
    }
}

fn agree_on(scene: &Scene) {
    let all = ["path", "light", "bdpt", "vcm"].map(|name| passes(scene, name, "on", 200));
    for row in 0..SIZE as usize {
        let [path, light, bdpt, vcm] = all.each_ref().map(|all| {
            let row = |p: &Vec<f64>| p[row * SIZE as usize..(row + 1) * SIZE as usize].iter().sum::<f64>();
            moment(all.iter().map(row).collect::<Vec<_>>().into_iter())
        });
        for (other, v) in [light, bdpt, vcm] {
            assert!(
                (path.0 - other).abs() <= 4.5 * (path.1 + v).sqrt() + 0.01 * path.0 + 1e-6,
                "row {row}: {} and {other}",
                path.0
            );
        }
    }
}
