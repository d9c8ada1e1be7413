use super::{FORMATS, ImageFile, linear_from_srgb, read_image_bytes};
use image::{DynamicImage, ImageFormat, Rgb32FImage, RgbImage, RgbaImage};
use proptest::prelude::*;
use std::io::Cursor;

/// Formats that are read only and keep every value, with whether they keep opacity.
const EXACT: [(&str, ImageFormat, bool); 4] = [
    ("a.webp", ImageFormat::WebP, true),
    ("a.tiff", ImageFormat::Tiff, true),
    ("a.tga", ImageFormat::Tga, true),
    ("a.bmp", ImageFormat::Bmp, false),
];

fn encoded(picture: &DynamicImage, format: ImageFormat) -> Vec<u8> {
    let mut bytes = Vec::new();
    picture.write_to(&mut Cursor::new(&mut bytes), format).unwrap();
    bytes
}

/// Four columns, two rows: red grows to the right, green downwards.
fn colours() -> RgbImage {
    RgbImage::from_fn(4, 2, |x, y| image::Rgb([60 * x as u8, 200 * y as u8, 17]))
}

#[test]
fn textures_of_all_formats_have_the_values_that_were_stored() {
    for (name, format, _) in EXACT {
        let file = read_image_bytes(name, &encoded(&colours().into(), format)).unwrap();
        assert_eq!((file.image.width, file.image.height, file.is_encoded), (4, 2, true), "{name}");
        assert!(file.alpha.is_empty(), "{name}");
        for (x, y, pixel) in colours().enumerate_pixels() {
            let linear = pixel.0.map(|v| linear_from_srgb(f32::from(v) / 255.0));
            assert_eq!(file.image.pixel(x, y), linear, "{name} {x} {y}");
        }
        // As data they are what the file holds.
        let data = file.undo_srgb();
        assert!(!data.is_encoded && (data.image.pixel(3, 1)[1] - 200.0 / 255.0).abs() < 1e-6, "{name}");
    }
}

#[test]
fn opacity_is_kept_beside_the_colours_and_does_not_dim_them() {
    let picture = RgbaImage::from_fn(3, 1, |x, _| image::Rgba([255, 255, 255, 100 * x as u8]));
    let png = ("a.png", ImageFormat::Png, true);
    for (name, format, _) in EXACT.into_iter().filter(|e| e.2).chain([png]) {
        let file = read_image_bytes(name, &encoded(&picture.clone().into(), format)).unwrap();
        assert_eq!(file.alpha, [0.0, 100.0 / 255.0, 200.0 / 255.0], "{name}");
        assert_eq!(file.image.data, [[1.0; 3]; 3], "{name}");
    }
}

#[test]
fn tiff_floats_are_linear_and_unbounded() {
    let picture = Rgb32FImage::from_fn(2, 1, |x, _| image::Rgb([7.5 * x as f32, 0.25, 1e-3]));
    let file = read_image_bytes("a.tif", &encoded(&picture.into(), ImageFormat::Tiff)).unwrap();
    assert_eq!(file.image.data, [[0.0, 0.25, 1e-3], [7.5, 0.25, 1e-3]]);
    assert!(!file.is_encoded && file.clone().undo_srgb() == file);
}

#[test]
fn a_format_without_a_signature_goes_by_the_name_of_the_file() {
    let bytes = encoded(&colours().into(), ImageFormat::Tga);
    assert!(read_image_bytes("folder/A.TGA", &bytes).is_ok());
    let error = read_image_bytes("picture", &bytes).unwrap_err().to_string();
    assert!(error.contains("no picture of a known format") && error.contains("KTX2"), "{error}");
}

/// A KTX 2 header of such a size, with one level that unpacks to so much.
fn ktx2(width: u32, height: u32, unpacked: u64) -> Vec<u8> {
    let mut bytes = b"\xABKTX 20\xBB\r\n\x1A\n".to_vec();
    // Format, size of its words, width, height, depth, layers, faces, levels, packing.
    bytes.extend([0, 1, width, height, 0, 0, 1, 1, 2].iter().flat_map(|v: &u32| v.to_le_bytes()));
    bytes.resize(80, 0);
    bytes.extend([104, 8, unpacked].iter().flat_map(|v: &u64| v.to_le_bytes()));
    bytes.extend([0; 8]);
    bytes
}

#[test]
fn forged_sizes_of_packed_textures_are_refused() {
    for bytes in [ktx2(65_536, 65_536, 64), ktx2(0, 4, 64), ktx2(4, 4, 1 << 40), ktx2(16_384, 16_384, 64)] {
        let error = read_image_bytes("a.ktx2", &bytes).unwrap_err().to_string();
        assert!(error.contains("its size is"), "{error}");
    }
    let mut bmp = encoded(&colours().into(), ImageFormat::Bmp);
    bmp[18..26].copy_from_slice(&[0, 0, 1, 0, 0, 0, 1, 0]);
    let mut tga = encoded(&colours().into(), ImageFormat::Tga);
    tga[12..16].copy_from_slice(&[0xFF; 4]);
    assert!(read_image_bytes("a.bmp", &bmp).is_err() && read_image_bytes("a.tga", &tga).is_err());
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]
    #[test]
    fn no_mutation_of_a_texture_makes_a_reader_panic(
        edits in proptest::collection::vec((any::<prop::sample::Index>(), any::<u8>()), 1..8),
        keep in 0.5_f32..1.0,
    ) {
        let plain = EXACT.map(|(name, format, _)| (name, encoded(&colours().into(), format)));
        for (name, mut bytes) in plain.into_iter().chain([("a.ktx2", ktx2(8, 8, 64))]) {
            for (at, value) in &edits {
                let at = at.index(bytes.len());
                bytes[at] = *value;
            }
            let cut = &bytes[..(bytes.len() as f32 * keep) as usize];
            for file in [read_image_bytes(name, &bytes), read_image_bytes(name, cut)].into_iter().flatten() {
                let ImageFile { image, alpha, .. } = file;
                prop_assert_eq!(image.data.len(), image.width as usize * image.height as usize);
                prop_assert!(alpha.is_empty() || alpha.len() == image.data.len());
            }
        }
    }
}

#[test]
fn every_format_is_read_and_has_a_name_of_its_own() {
    let mut extensions: Vec<&str> = FORMATS.iter().flat_map(|f| f.extensions.iter().copied()).collect();
    extensions.sort_unstable();
    let count = extensions.len();
    extensions.dedup();
    assert_eq!(extensions.len(), count);
    assert!(FORMATS.iter().all(|f| f.read.is_some()));
}
