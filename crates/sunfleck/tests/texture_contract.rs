//! What a texture promises: a smooth picture through its pixels, with the mean of its pixels.
use glam::{Affine2, Affine3A, Vec2, Vec3, Vec4};
use sunfleck::{
    sampler::{Domain, Sampler},
    scene::{SceneBuilder, SceneError},
    spectrum::{Rgb, Wavelengths},
    texture::{
        Channel, Checkerboard, Dots, ImageTexture, Lookup, Mapped, Mix, Noise, NoiseKind, Product, Scalar, Texture,
        TextureId, Threshold, UvMap, UvSet, VertexAttributes, VertexColour, Wrap,
    },
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
    let t = image(Wrap::Repeat);
    let n = 1 << 16;
    let shown = [Texture::Image(t.clone())];
    let rgb = |uv| look(&shown, uv);
    let sum =
        (0..n).fold(glam::DVec3::ZERO, |sum, i| sum + rgb(Sampler::new(0, Domain::Prepare, 0, i).next_2d()).as_dvec3());
    assert!((sum / n as f64 - t.mean().as_dvec3()).abs().max_element() < 2e-3);
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

/// The values of the last of these textures at a place, in RGB.
fn look(textures: &[Texture], uv: Vec2) -> Rgb {
    let at = Lookup::new(textures, uv, Vec3::new(uv.x, uv.y, 0.3), Wavelengths::Rgb);
    at.spectrum(TextureId(textures.len() as u32 - 1)).to_rgb(Wavelengths::Rgb)
}

fn places() -> impl Iterator<Item = Vec2> {
    (0..500).map(|i| {
        let s = &mut Sampler::new(5, Domain::Prepare, 0, i);
        6.0 * s.next_2d() - 3.0
    })
}

#[test]
fn textures_made_of_others_are_what_their_parts_say() {
    let (red, blue) = (Rgb::new(0.8, 0.1, 0.2), Rgb::new(0.1, 0.2, 0.9));
    let parts = || vec![Texture::Constant(red.into()), Texture::Constant(blue.into())];
    let with = |last: Texture| parts().into_iter().chain([last]).collect::<Vec<_>>();
    let both = [TextureId(0), TextureId(1)];
    let map = UvMap { scale: Vec2::new(2.0, 0.5), offset: Vec2::new(0.25, 0.0) };
    let amount = Texture::Constant(Rgb::splat(0.25).into());
    let mix = Mix { from: both[0], to: both[1], amount: TextureId(2) };
    let mixed = [with(amount), vec![Texture::Mix(mix)]].concat();
    let shown = image(Wrap::Repeat);
    let moved = vec![
        Texture::Image(shown.clone()),
        Texture::Mapped(Mapped { of: TextureId(0), map: map.into(), set: UvSet::First }),
    ];
    for uv in places() {
        let is_near = |a: Rgb, b: Rgb| assert!((a - b).abs().max_element() < 1e-5, "{uv}: {a} {b}");
        is_near(look(&with(Texture::Product(Product { of: both })), uv), red * blue);
        is_near(look(&mixed, uv), red.lerp(blue, 0.25));
        let q = uv * map.scale + map.offset;
        let is_even = (q.x.floor() + q.y.floor()) as i32 % 2 == 0;
        let board = look(&with(Texture::Checkerboard(Checkerboard { of: both, map })), uv);
        is_near(board, if is_even { red } else { blue });
        is_near(look(&moved, uv), shown.eval(q));
    }
}

#[test]
fn dots_cover_a_tenth_to_a_third_and_noise_is_smooth_and_bounded() {
    let dots = Dots {
        inside: TextureId(0),
        outside: TextureId(1),
        map: UvMap { scale: Vec2::splat(20.0), ..UvMap::default() },
    };
    let textures = [Texture::Constant(Rgb::ONE.into()), Texture::Constant(Rgb::ZERO.into()), Texture::Dots(dots)];
    let inside = places().filter(|uv| look(&textures, *uv).x > 0.5).count();
    assert!((50..170).contains(&inside), "{inside} of 500");
    let kinds = [
        NoiseKind::Fbm { octaves: 8, roughness: 0.5 },
        NoiseKind::Wrinkled { octaves: 8, roughness: 0.5 },
        NoiseKind::Windy,
        NoiseKind::Marble { octaves: 8, roughness: 0.5, variation: 0.2 },
    ];
    for kind in kinds {
        let noise = Noise { kind, pattern_from_world: Affine3A::IDENTITY };
        let mut values = Vec::new();
        for uv in places() {
            let p = Vec3::new(3.0 * uv.x, 5.0 * uv.y, uv.x - uv.y);
            let (here, beside) = (noise.eval(p), noise.eval(p + 1e-4));
            assert!((here - beside).abs().max_element() < 0.02, "{kind:?}");
            assert!(here.min_element() >= 0.0 && here.max_element() < 2.0, "{kind:?}: {here}");
            values.push(here.x);
        }
        let (low, high) = (values.iter().copied().fold(9.0, f32::min), values.iter().copied().fold(0.0, f32::max));
        assert!(high - low > 0.05, "{kind:?} is flat: {low} to {high}");
    }
}

#[test]
fn a_texture_made_of_a_later_one_is_refused() {
    let mut builder = SceneBuilder::new();
    builder.texture(Texture::Product(Product { of: [TextureId(0), TextureId(1)] }));
    builder.constant(Rgb::ONE);
    assert!(matches!(builder.build(), Err(SceneError::Missing { what: "texture", .. })));
}

#[test]
fn numbers_are_the_scenes_own_and_colours_are_spectra() {
    let picture = image(Wrap::Repeat);
    let textures = [
        Texture::Image(picture.clone()),
        Texture::Channel(Channel { of: TextureId(0), channel: 1 }),
        Texture::Threshold(Threshold { of: TextureId(1), cutoff: 2.0 }),
    ];
    let lambda = Wavelengths::Spectral(Vec4::new(450.0, 500.0, 600.0, 700.0));
    for uv in places() {
        let at = Lookup::new(&textures, uv, Vec3::ZERO, lambda);
        let want = picture.eval(uv);
        assert_eq!(at.rgb(TextureId(0)), want);
        assert_eq!(at.scalar(Scalar::Texture(TextureId(1))), want.y);
        assert_eq!(at.scalar(Scalar::Texture(TextureId(2))), f32::from(want.y >= 2.0));
        assert_eq!(at.scalar(0.25.into()), 0.25);
    }
}

#[test]
fn coordinates_turn_and_come_from_either_set_and_vertices_bring_colours() {
    let picture = image(Wrap::Repeat);
    let turn = Affine2::from_scale_angle_translation(Vec2::new(2.0, 0.5), 0.7, Vec2::new(0.1, -0.3));
    let mapped = |set| Texture::Mapped(Mapped { of: TextureId(0), map: turn, set });
    let textures = [
        Texture::Image(picture.clone()),
        mapped(UvSet::First),
        mapped(UvSet::Second),
        Texture::Vertex(VertexColour::Rgb),
        Texture::Vertex(VertexColour::Alpha),
    ];
    for uv in places() {
        let attributes = VertexAttributes { uv2: 0.5 - uv, colour: Vec4::new(uv.x, 0.2, 0.3, uv.y) };
        let at = Lookup { attributes, ..Lookup::new(&textures, uv, Vec3::ZERO, Wavelengths::Rgb) };
        assert_eq!(at.rgb(TextureId(1)), picture.eval(turn.transform_point2(uv)));
        assert_eq!(at.rgb(TextureId(2)), picture.eval(turn.transform_point2(0.5 - uv)));
        assert_eq!(at.rgb(TextureId(3)), Rgb::new(uv.x, 0.2, 0.3));
        assert_eq!(at.rgb(TextureId(4)), Rgb::splat(uv.y));
    }
}
