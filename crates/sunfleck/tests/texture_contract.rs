//! What a texture promises: a smooth picture through its pixels, with the mean of its pixels.
use glam::Vec2;
use sunfleck::{
    sampler::{Domain, Sampler},
    spectrum::{Rgb, Wavelengths},
    texture::{ImageTexture, Texture, Wrap},
};

const W: usize = 5;
const H: usize = 4;

fn image(wrap: Wrap) -> ImageTexture {
    let pixels = (0..W * H).map(|i| Rgb::new((i * 7 % 11) as f32, (i % W) as f32, (i / W) as f32));
    ImageTexture::new(W, H, pixels.collect(), wrap).unwrap()
}

#[test]
fn a_picture_of_another_size_than_its_pixels_is_refused() {
    let pixels = |n| vec![Rgb::ONE; n];
    assert!(ImageTexture::new(2, 3, pixels(6), Wrap::Repeat).is_some());
    for (w, h, n) in [(2, 3, 5), (2, 3, 7), (0, 3, 0), (3, 0, 0), (usize::MAX, 2, 4)] {
        assert!(ImageTexture::new(w, h, pixels(n), Wrap::Repeat).is_none(), "{w} x {h} of {n}");
    }
}

#[test]
fn every_pixel_is_found_at_its_centre_with_the_top_row_at_the_top() {
    for wrap in [Wrap::Repeat, Wrap::Clamp, Wrap::Mirror] {
        let t = image(wrap);
        for (x, y) in (0..W).flat_map(|x| (0..H).map(move |y| (x, y))) {
            let uv = Vec2::new((x as f32 + 0.5) / W as f32, 1.0 - (y as f32 + 0.5) / H as f32);
            assert!((t.eval(uv) - t.pixel(x, y)).abs().max_element() < 1e-5, "({x}, {y})");
        }
    }
}

#[test]
fn between_pixels_it_is_linear_along_each_axis() {
    let t = image(Wrap::Repeat);
    for i in 0..200 {
        let s = &mut Sampler::new(0, Domain::Prepare, 0, i);
        let (x, y) = ((s.next_1d() * 3.99) as usize, (s.next_1d() * 2.99) as usize);
        let f = s.next_2d();
        let uv = Vec2::new((x as f32 + 0.5 + f.x) / W as f32, 1.0 - (y as f32 + 0.5 + f.y) / H as f32);
        let row = |y| t.pixel(x, y) * (1.0 - f.x) + t.pixel(x + 1, y) * f.x;
        let want = row(y) * (1.0 - f.y) + row(y + 1) * f.y;
        assert!((t.eval(uv) - want).abs().max_element() < 1e-4, "{uv}");
    }
}

#[test]
fn the_mean_over_the_square_is_the_mean_of_the_pixels() {
    let t = Texture::Image(image(Wrap::Repeat));
    let n = 1 << 16;
    let rgb = |uv| t.spectrum(uv, Wavelengths::Rgb).to_rgb(Wavelengths::Rgb);
    let sum =
        (0..n).fold(glam::DVec3::ZERO, |sum, i| sum + rgb(Sampler::new(0, Domain::Prepare, 0, i).next_2d()).as_dvec3());
    assert!((sum / n as f64 - t.mean().as_dvec3()).abs().max_element() < 2e-3);
    assert_eq!(Texture::Constant(Rgb::new(0.1, 0.2, 0.3).into()).mean(), Rgb::new(0.1, 0.2, 0.3));
}

#[test]
fn far_and_broken_coordinates_give_a_colour_of_the_picture() {
    for wrap in [Wrap::Repeat, Wrap::Clamp, Wrap::Mirror] {
        let t = image(wrap);
        for x in [-1e30f32, -7.3, 1e9, f32::MAX, f32::INFINITY, f32::NEG_INFINITY, f32::NAN] {
            let c = t.eval(Vec2::new(x, -x));
            assert!(c.is_finite() && c.min_element() >= 0.0 && c.max_element() <= 10.0, "{wrap:?} {x}: {c}");
        }
    }
}
