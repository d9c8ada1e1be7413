use super::{FORMATS, ImageFile, RgbImage32, Tone, linear_from_srgb, read_image, read_image_bytes, srgb_from_linear};
use super::{WriteReport, write_image};
use proptest::prelude::*;
use std::path::Path;

fn gradient(width: u32, height: u32) -> RgbImage32 {
    let pixel = |i: u32| [i as f32 * 0.01, 0.5, (width * height - i) as f32 * 3.0];
    RgbImage32 { width, height, data: (0..width * height).map(pixel).collect() }
}

fn written(file: &ImageFile, name: &str, tone: Tone) -> (ImageFile, WriteReport) {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join(name);
    let report = write_image(&path, file, tone).unwrap();
    let entries = std::fs::read_dir(folder.path()).unwrap().count();
    assert_eq!(entries, 1, "a temporary file is left");
    (read_image(&path).unwrap(), report)
}

#[test]
fn float_formats_give_back_the_same_bits() {
    let mut image = gradient(7, 5);
    image.data[3] = [-1.0, f32::INFINITY, 1e-40];
    for name in ["a.exr", "a.pfm"] {
        let (back, report) = written(&image.clone().into(), name, Tone::Srgb);
        assert_eq!(back.image, image, "{name}");
        assert_eq!(report, WriteReport { non_finite_pixels: 1, layers_left_out: false });
    }
}

#[test]
fn hdr_gives_back_values_within_its_steps() {
    let image = gradient(9, 4);
    let (back, _) = written(&image.clone().into(), "a.hdr", Tone::Srgb);
    for (a, b) in image.data.iter().zip(&back.image.data) {
        let largest = a.iter().fold(0.0_f32, |m, x| m.max(*x));
        assert!(a.iter().zip(b).all(|(x, y)| (x - y).abs() <= largest / 128.0), "{a:?} {b:?}");
    }
}

#[test]
fn png_rounds_to_the_nearest_of_256_steps() {
    let image = gradient(8, 8);
    let (back, _) = written(&image.clone().into(), "a.png", Tone::Srgb);
    for (a, b) in image.data.iter().flatten().zip(back.image.data.iter().flatten()) {
        assert!((srgb_from_linear(a.min(1.0)) - srgb_from_linear(*b)).abs() <= 0.5001 / 255.0, "{a} {b}");
    }
}

#[test]
fn screen_values_are_those_of_the_curves() {
    // 0.5 → 1.055·0.5^(1/2.4) − 0.055 = 0.735357 → 187.5; 0.25 → √0.25 = 0.5 → 127.5, rounded up.
    assert_eq!((Tone::Srgb.encode(0.5), Tone::SquareRoot.encode(0.25)), (188, 128));
    for tone in [Tone::Srgb, Tone::SquareRoot] {
        let values = [f32::NAN, f32::NEG_INFINITY, -1.0, 0.0, 1.0, 7.0, f32::INFINITY].map(|x| tone.encode(x));
        assert_eq!(values, [0, 0, 0, 0, 255, 255, 255]);
    }
    assert!((linear_from_srgb(srgb_from_linear(0.3)) - 0.3).abs() < 1e-6);
}

#[test]
fn values_that_are_not_finite_are_counted_and_do_no_harm() {
    let mut image = gradient(4, 4);
    image.data[0] = [f32::NAN; 3];
    image.data[5] = [1.0, f32::INFINITY, 0.0];
    for name in ["a.png", "a.hdr"] {
        let (back, report) = written(&image.clone().into(), name, Tone::Srgb);
        assert_eq!(report.non_finite_pixels, 2);
        assert_eq!(back.image.data[0], [0.0; 3]);
    }
}

#[test]
fn exr_keeps_layers_and_metadata() {
    let mut file = ImageFile::from(gradient(6, 3));
    file.layers.push(("albedo".to_owned(), RgbImage32::filled(6, 3, [0.1, 0.2, 0.3])));
    file.layers.push(("direct.light".to_owned(), RgbImage32::filled(6, 3, [1.0, 2.0, 3.0])));
    file.metadata.push(("passes".to_owned(), "64".to_owned()));
    file.metadata.push(("scene".to_owned(), "康奈尔.scn, 40°".to_owned()));
    let (back, report) = written(&file, "a.exr", Tone::Srgb);
    assert_eq!(back, file);
    assert!(!report.layers_left_out);
    assert!(written(&file, "a.png", Tone::Srgb).1.layers_left_out);
}

#[test]
fn the_same_picture_and_metadata_give_the_same_exr_byte_for_byte() {
    let mut file = ImageFile::from(gradient(40, 70));
    file.metadata =
        ["version", "seed", "passes", "integrator", "scene"].map(|k| (k.to_owned(), format!("{k} 1"))).to_vec();
    let folder = tempfile::tempdir().unwrap();
    let bytes = |name: &str| {
        let path = folder.path().join(name);
        write_image(&path, &file, Tone::Srgb).unwrap();
        std::fs::read(path).unwrap()
    };
    let first = bytes("first.exr");
    for i in 0..8 {
        assert!(bytes(&format!("{i}.exr")) == first, "attempt {i}");
    }
}

#[test]
fn rows_are_stored_from_the_right_side() {
    let mut image = RgbImage32::filled(2, 2, [0.0; 3]);
    image.data[0] = [1.0; 3];
    for format in FORMATS.iter().filter(|f| f.write.is_some()) {
        let name = format!("a.{}", format.extensions[0]);
        assert_eq!(written(&image.clone().into(), &name, Tone::Srgb).0.image, image, "{name}");
    }
    // The bottom row comes first in a PFM file.
    let bytes = b"Pf\n1 2\n1.0\n\x3F\x80\x00\x00\x00\x00\x00\x00";
    assert_eq!(read_image_bytes("a.pfm", bytes).unwrap().image.data, [[0.0; 3], [1.0; 3]]);
}

#[test]
fn sixteen_bit_png_keeps_its_precision() {
    let pixels = image::ImageBuffer::<image::Luma<u16>, _>::from_raw(1, 2, vec![65_535, 32_768]).unwrap();
    let mut bytes = Vec::new();
    pixels.write_to(&mut std::io::Cursor::new(&mut bytes), image::ImageFormat::Png).unwrap();
    let image = read_image_bytes("a.png", &bytes).unwrap().image;
    assert_eq!(image.data[0], [1.0; 3]);
    assert!((image.data[1][0] - linear_from_srgb(32_768.0 / 65_535.0)).abs() < 1e-6);
}

#[test]
fn failures_say_why_and_leave_nothing_behind() {
    let folder = tempfile::tempdir().unwrap();
    let told = |path: &Path, file: &ImageFile| {
        let text = write_image(path, file, Tone::Srgb).unwrap_err().to_string();
        text.replace(&folder.path().display().to_string(), "FOLDER")
    };
    let file = ImageFile::from(gradient(2, 2));
    insta::assert_snapshot!("no_extension", told(Path::new("picture"), &file));
    insta::assert_snapshot!("unknown_extension", told(Path::new("a.pngg"), &file));
    insta::assert_snapshot!("read_only_format", told(Path::new("a.jpg"), &file));
    insta::assert_snapshot!("empty_picture", told(Path::new("a.png"), &ImageFile::default()));
    let missing = folder.path().join("nowhere").join("a.png");
    insta::assert_snapshot!("missing_folder", told(&missing, &file));
    let taken = folder.path().join("taken.png");
    std::fs::create_dir(&taken).unwrap();
    assert!(told(&taken, &file).contains("cannot write the file"));
    let mut layers = file.clone();
    layers.layers.push((String::new(), gradient(2, 2)));
    let path = folder.path().join("a.exr");
    assert!(told(&path, &layers).contains("cannot name a layer"));
    assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 1);
}

#[test]
fn forged_sizes_are_refused_before_memory_is_reserved() {
    let mut exr = Vec::new();
    exr.extend(FORMATS[0].write.unwrap()(&gradient(2, 2).into(), Tone::Srgb).unwrap());
    let window = exr.windows(10).position(|w| w == b"dataWindow").unwrap() + 10 + 1 + 6 + 4;
    // dataWindow: xMin, yMin, xMax, yMax.
    exr[window + 8..window + 16].copy_from_slice(&[0xFF, 0xFF, 0, 0, 0xFF, 0xFF, 0, 0]);
    let pfm = b"PF\n100000 100000\n-1.0\n0000".to_vec();
    let hdr = b"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 99999 +X 99999\n\0\0\0\0".to_vec();
    let mut png = FORMATS[1].write.unwrap()(&gradient(2, 2).into(), Tone::Srgb).unwrap();
    png[16..24].copy_from_slice(&[0, 1, 0, 0, 0, 1, 0, 0]);
    for bytes in [exr, pfm, hdr, png] {
        assert!(read_image_bytes("forged", &bytes).is_err());
    }
}

#[test]
fn a_plain_exr_is_read_where_its_window_begins_and_as_the_same_picture_with_a_layer() {
    use exr::prelude::{Image, Layer, LayerAttributes, SpecificChannels, Vec2, WritableImage};
    let image = gradient(9, 5);
    for kind in ["float", "half"] {
        let pixel = |at: Vec2<usize>| image.pixel(at.x() as u32, at.y() as u32);
        let attributes = LayerAttributes { layer_position: Vec2(-3, 7), ..LayerAttributes::named("main") };
        let mut bytes = Vec::new();
        let out = std::io::Cursor::new(&mut bytes);
        let (size, encoding) = ((9, 5), exr::prelude::Encoding::FAST_LOSSLESS);
        let written = if kind == "float" {
            let channels = SpecificChannels::rgb(|at: Vec2<usize>| <(f32, f32, f32)>::from(pixel(at)));
            Image::from_layer(Layer::new(size, attributes, encoding, channels)).write().to_buffered(out)
        } else {
            let channels =
                SpecificChannels::rgb(|at: Vec2<usize>| <(_, _, _)>::from(pixel(at).map(exr::prelude::f16::from_f32)));
            Image::from_layer(Layer::new(size, attributes, encoding, channels)).write().to_buffered(out)
        };
        written.unwrap();
        let back = read_image_bytes("a.exr", &bytes).unwrap().image;
        assert_eq!((back.width, back.height), (9, 5));
        for (a, b) in image.data.iter().flatten().zip(back.data.iter().flatten()) {
            assert!((a - b).abs() <= if kind == "float" { 0.0 } else { a.abs() / 2048.0 }, "{kind}: {a} {b}");
        }
    }
    let mut layered = ImageFile::from(image.clone());
    layered.layers.push(("more".to_owned(), image.clone()));
    let bytes = FORMATS[0].write.unwrap()(&layered, Tone::Srgb).unwrap();
    assert_eq!(read_image_bytes("a.exr", &bytes).unwrap().image, image);
}

#[test]
fn a_file_that_is_no_picture_is_told_so() {
    insta::assert_snapshot!("no_picture", read_image_bytes("a.exr", b"Begin Material\n").unwrap_err().to_string());
    insta::assert_snapshot!("cut_pfm", read_image_bytes("a.pfm", b"PF\n2 2\n-1\n0000").unwrap_err().to_string());
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]
    #[test]
    fn no_mutation_of_a_picture_makes_a_reader_panic(
        edits in proptest::collection::vec((any::<prop::sample::Index>(), any::<u8>()), 1..8),
        keep in 0.5_f32..1.0,
    ) {
        for format in FORMATS {
            let (Some(write), Some(read)) = (format.write, format.read) else { continue };
            let mut bytes = write(&gradient(9, 5).into(), Tone::Srgb).unwrap();
            for (at, value) in &edits {
                let at = at.index(bytes.len());
                bytes[at] = *value;
            }
            let _ = read(&bytes);
            let _ = read(&bytes[..(bytes.len() as f32 * keep) as usize]);
        }
    }
}
