//! Each bad input with the text a person gets; the expected texts lie in `snapshots/`.

use super::{Comma, LightKind, PropValue, ScnFile, ShapeKind, parse};
use crate::diagnostic::{Diagnostic, MAX_ERRORS, Sink, SourceFile};
use glam::Vec3;
use proptest::prelude::*;

const GOOD: &str = "\
Begin Material
Material White
Prop diffuseColor RGB 0.7 0.7 0.7
Material Glass 2
Prop ior Float 1.5
End
Begin Model
Model Box
Translation 1 2 3
Scale 2 2 2
Sphere ball Glass
N 0 0 1
P 0 1 0
R 0.5
Plane floor White
N 0 1 0
P -1 0 -1
U 2 0 0
V 0 0 2
Triangle roof White
N 0 0 1
V1 0 0 0
V2 1 0 0
V3 0 1 0
End
Begin Light
Area lamp
IRV 5 6 7
P 0 3 0
U 1 0 0
V 0 0 1
Spot beam
D 0 -1 0
HotSpot 0.1
Fallout 0.2
End
";

fn read(text: impl AsRef<[u8]>, comma: Comma) -> (ScnFile, Result<(), crate::diagnostic::Error>, Vec<Diagnostic>) {
    let mut sink = Sink::default();
    let tree = parse(&SourceFile::from_bytes("test.scn", text.as_ref()), comma, &mut sink);
    let result = sink.finish(());
    (tree, result, sink.take_warnings())
}

fn told(text: impl AsRef<[u8]>, comma: Comma) -> String {
    let (_, result, mut warnings) = read(text, comma);
    let mut texts = Vec::new();
    if let Err(error) = result {
        texts.push(error.render(false));
        warnings = error.warnings;
    }
    texts.extend(warnings.iter().map(Diagnostic::to_string));
    texts.join("\n\n")
}

#[test]
fn a_good_file_reads_without_a_word() {
    let (tree, result, warnings) = read(GOOD, Comma::Separates);
    assert!(result.is_ok() && warnings.is_empty());
    assert_eq!(tree.materials.len(), 2);
    assert_eq!(tree.materials[1].type_id, 2);
    assert_eq!(tree.materials[0].prop("diffuseColor").unwrap().value, PropValue::Rgb([0.7; 3]));
    let model = &tree.models[0];
    assert_eq!(model.translation, Vec3::new(1.0, 2.0, 3.0));
    assert_eq!(model.scale.as_ref().unwrap().value, Vec3::splat(2.0));
    let ShapeKind::Sphere(ball) = &model.shapes[0].kind else { panic!("not a sphere") };
    assert_eq!((ball.centre, ball.radius, model.shapes[0].material), (Vec3::Y, 0.5, 1));
    let ShapeKind::Plane(floor) = &model.shapes[1].kind else { panic!("not a plane") };
    assert_eq!((floor.u, floor.v, floor.normal), (2.0 * Vec3::X, 2.0 * Vec3::Z, Vec3::Y));
    let ShapeKind::Triangle(roof) = &model.shapes[2].kind else { panic!("not a triangle") };
    assert_eq!(roof.vertices, [Vec3::ZERO, Vec3::X, Vec3::Y]);
    assert_eq!((tree.lights[0].kind, tree.lights[0].irv), (LightKind::Area, [5.0, 6.0, 7.0]));
    assert_eq!((tree.lights[1].direction, tree.lights[1].fallout), (Vec3::NEG_Y, 0.2));
}

#[test]
fn windows_and_old_mac_line_ends_change_nothing() {
    for line_end in ["\r\n", "\r"] {
        let (tree, result, warnings) = read(GOOD.replace('\n', line_end), Comma::Separates);
        assert!(result.is_ok() && warnings.is_empty());
        assert_eq!((tree.materials.len(), tree.models[0].shapes.len(), tree.lights.len()), (2, 3, 2));
    }
}

#[test]
fn a_comma_separates_or_ends_the_numbers() {
    let text = "Begin Material\nMaterial Red\nProp diffuseColor RGB 0.63 0.065, 0.05\nEnd";
    let colour = |comma| read(text, comma).0.materials[0].prop("diffuseColor").unwrap().value;
    assert_eq!(colour(Comma::Separates), PropValue::Rgb([0.63, 0.065, 0.05]));
    assert_eq!(colour(Comma::EndsNumbers), PropValue::Rgb([0.63, 0.065, 0.0]));
}

#[test]
fn a_comment_in_any_encoding_is_skipped() {
    let mut bytes = b"# \xC2\xFE\xB7\xB4\xC9\xE4\n".to_vec();
    bytes.extend_from_slice(GOOD.as_bytes());
    let (tree, result, warnings) = read(bytes, Comma::Separates);
    assert!(result.is_ok() && warnings.is_empty());
    assert_eq!(tree.materials.len(), 2);
}

#[test]
fn an_attribute_goes_to_the_last_shape_that_has_it() {
    let text = "Begin Material\nMaterial M\nEnd\nBegin Model\nModel A\nSphere s M\nPlane p M\nR 3\nEnd";
    let (tree, result, warnings) = read(text, Comma::Separates);
    assert!(result.is_ok());
    assert_eq!(warnings.len(), 1);
    let ShapeKind::Sphere(sphere) = &tree.models[0].shapes[0].kind else { panic!("not a sphere") };
    assert_eq!(sphere.radius, 3.0);
}

#[test]
fn reading_stops_after_twenty_errors() {
    let text = format!("Begin Material\n{}End\n", "Nonsense 1\n".repeat(1000));
    let (_, result, _) = read(text, Comma::Separates);
    assert_eq!(result.unwrap_err().errors.len(), MAX_ERRORS);
}

#[test]
fn thousands_of_like_warnings_become_three_and_a_count() {
    let text = format!("Begin Material\nMaterial M\n{}End\n", "Prop a Float 1 oops\n".repeat(1000));
    let (_, result, warnings) = read(text, Comma::Separates);
    assert!(result.is_ok());
    let trailing: Vec<_> = warnings.iter().filter(|w| w.code == "scn::trailing-text").collect();
    assert_eq!(trailing.len(), 3);
    assert_eq!(trailing[2].help, ["997 more of this kind in this file"]);
}

/// (name of the snapshot, input)
const BAD: [(&str, &str); 30] = [
    ("wrong_case_begin", "begin Material\nMaterial A\nend\n"),
    ("unknown_section", "Begin Materials\nMaterial A\nEnd\n"),
    ("section_without_name", "Begin\nEnd\n"),
    ("keyword_of_another_section", "Begin Material\nSphere ball White\nEnd\n"),
    ("unknown_keyword", "Begin Light\nArea Top\nFalloff 0.3\nEnd\n"),
    ("unclosed_section", "Begin Material\nMaterial A\n\nBegin Model\nModel B\nEnd\n"),
    ("missing_end", "Begin Material\nMaterial A\n"),
    ("end_without_begin", "End\nBegin Material\nEnd\n"),
    ("stray_text", "WorldBegin\nAttributeBegin\nShape \"sphere\"\n"),
    ("material_without_name", "Begin Material\nMaterial\nEnd\n"),
    ("material_type_not_a_number", "Begin Material\nMaterial A Glass\nEnd\n"),
    ("duplicate_material", "Begin Material\nMaterial A\nMaterial B\nMaterial A 2\nEnd\n"),
    ("duplicate_property", "Begin Material\nMaterial A\nProp ior Float 1.5\nProp ior Float 1.6\nEnd\n"),
    ("prop_before_material", "Begin Material\nProp diffuseColor RGB 1 1 1\nEnd\n"),
    ("prop_without_type", "Begin Material\nMaterial A\nProp ior\nEnd\n"),
    ("unknown_property_type", "Begin Material\nMaterial A\nProp diffuseMap Texture wood.png\nEnd\n"),
    ("wrong_case_property_type", "Begin Material\nMaterial A\nProp ior float 1.5\nEnd\n"),
    ("missing_number", "Begin Material\nMaterial A\nProp diffuseColor RGB 0.5 0.5\nEnd\n"),
    ("not_a_number", "Begin Material\nMaterial A\nProp diffuseColor RGB 0.5 0.5f x\nEnd\n"),
    ("nan", "Begin Light\nPoint A\nIRV 1 nan 1\nEnd\n"),
    ("infinite", "Begin Light\nPoint A\nIRV 1 -inf 1\nEnd\n"),
    ("overflow", "Begin Light\nPoint A\nIRV 1 1e99 1\nEnd\n"),
    ("comma", "Begin Material\nMaterial Red\nProp diffuseColor RGB 0.63 0.065, 0.05\nEnd\n"),
    ("trailing_text", "Begin Light\nPoint A\nIRV 1 1 1 1\nP 0 0 0 # fine\nEnd\n"),
    ("unknown_material", "Begin Material\nMaterial White\nEnd\nBegin Model\nModel M\nSphere s white\nR 1\nEnd\n"),
    ("material_after_use", "Begin Model\nModel M\nPlane p Red\nEnd\nBegin Material\nMaterial Red\nEnd\n"),
    ("shape_before_model", "Begin Material\nMaterial M\nEnd\nBegin Model\nSphere s M\nR 2\nEnd\n"),
    ("attribute_before_shape", "Begin Model\nModel M\nR 2\nEnd\n"),
    ("direction_before_light", "Begin Light\nD 0 0 1\nEnd\n"),
    ("several_errors", "Begin Light\nArea A\nIRV 1 2\nU 1 0 zero\nQ 1\nEnd\nBegin Modl\nEnd\n"),
];

#[test]
fn every_bad_input_gets_a_message_with_its_place() {
    for (name, input) in BAD {
        let text = told(input, Comma::Separates);
        assert!(text.contains("test.scn:"), "{name}: no place in\n{text}");
        insta::assert_snapshot!(name, format!("{input}\n----\n{text}"));
    }
}

#[test]
fn odd_bytes_get_a_message_too() {
    let cases: [(&str, &[u8]); 3] = [
        ("byte_order_mark", b"\xEF\xBB\xBFBegin Material\nEnd\n"),
        ("not_utf8", b"Begin Material\nMaterial \xB2\xE3\nMaterial \xB2\xE3\nEnd\n"),
        ("zero_bytes", b"Begin Material\n\0\0\0\0\nEnd\n"),
    ];
    for (name, input) in cases {
        insta::assert_snapshot!(name, told(input, Comma::Separates));
    }
    insta::assert_snapshot!("comma_compat", told(BAD[22].1, Comma::EndsNumbers));
}

/// A good file with a few bytes changed, cut, or repeated.
fn mutated() -> impl Strategy<Value = Vec<u8>> {
    let edit = (0..GOOD.len(), 0..GOOD.len(), any::<u8>(), 0..4_u8);
    proptest::collection::vec(edit, 1..12).prop_map(|edits| {
        let mut bytes = GOOD.as_bytes().to_vec();
        for (at, other, byte, kind) in edits {
            let (at, other) = (at % bytes.len().max(1), other % bytes.len().max(1));
            match kind {
                0 if !bytes.is_empty() => bytes[at] = byte,
                1 => bytes.insert(at, byte),
                2 => drop(bytes.drain(at.min(other)..at.max(other))),
                _ => {
                    let copy = bytes[at.min(other)..at.max(other)].to_vec();
                    bytes.splice(at..at, copy);
                }
            }
        }
        bytes
    })
}

proptest! {
    #[test]
    fn no_mutation_of_a_good_file_makes_the_parser_panic(bytes in mutated(), compat in any::<bool>()) {
        let comma = if compat { Comma::EndsNumbers } else { Comma::Separates };
        let (tree, result, _) = read(&bytes, comma);
        if result.is_ok() {
            for shape in tree.models.iter().flat_map(|m| &m.shapes) {
                prop_assert!(shape.material < tree.materials.len());
            }
        }
        told(&bytes, comma);
    }
}
