use super::loaded;
use glam::{Vec2, Vec3};
use sunfleck::bsdf::{Facets, Lookup, Material, Scalar};
use sunfleck::spectrum::Wavelengths;

/// The models of a rectangle's material, without what lies over them.
fn models(bsdf: &str) -> (Vec<Material>, Vec<sunfleck::texture::Texture>) {
    let file = loaded(&format!("<shape type='rectangle'>{bsdf}</shape>"));
    let parts = file.builder.parts();
    (parts.materials.to_vec(), parts.textures.to_vec())
}

#[test]
fn checkerboards_begin_with_their_second_value_where_numbers_are_asked_for() {
    let board = "type='checkerboard'><float name='color0' value='0.1'/><float name='color1' value='0.3'/></texture>";
    let (models, textures) = models(&format!(
        "<bsdf type='roughconductor'><texture name='alpha' {board}<texture name='specular_reflectance' {board}</bsdf>"
    ));
    let rough = models.iter().find_map(|m| if let Material::RoughConductor(m) = m { Some(*m) } else { None }).unwrap();
    for (uv, number) in [(Vec2::splat(0.2), 0.3), (Vec2::new(0.2, 0.7), 0.1), (Vec2::splat(0.7), 0.3)] {
        let at = Lookup::new(&textures, uv, Vec3::ZERO, Wavelengths::Rgb);
        assert_eq!(at.scalar(rough.alpha.u), number);
        assert!((at.spectrum(rough.metal.reflectance).hero() - (0.4 - number)).abs() < 1e-6);
    }
}

#[test]
fn numbers_of_checkerboards_may_be_above_one() {
    let board = "<texture name='diff_trans' type='checkerboard'><float name='color0' value='1.5'/></texture>";
    let (models, textures) = models(&format!("<bsdf type='principledthin'>{board}</bsdf>"));
    let thin = models.iter().find_map(|m| if let Material::DisneyThin(m) = m { Some(*m) } else { None }).unwrap();
    let at = |u| Lookup::new(&textures, Vec2::new(u, 0.2), Vec3::ZERO, Wavelengths::Rgb).scalar(thin.through);
    assert_eq!((at(0.2), at(0.7)), (0.2, 1.5));
}

#[test]
fn rough_surfaces_are_beckmanns_unless_said_otherwise() {
    for (word, facets) in [("", Facets::Beckmann), ("<string name='distribution' value='ggx'/>", Facets::GgxSeparate)] {
        let (metal, _) = models(&format!("<bsdf type='roughconductor'>{word}</bsdf>"));
        let (plastic, _) = models(&format!("<bsdf type='roughplastic'>{word}<float name='alpha' value='0.2'/></bsdf>"));
        assert!(metal.iter().any(|m| matches!(m, Material::RoughConductor(m) if m.alpha.facets == facets)));
        let is_it = |m: &Material| matches!(m, Material::RoughPlastic(m) if m.boundary.facets() == facets && m.boundary.alpha() == 0.2);
        assert!(plastic.iter().any(is_it));
    }
}

#[test]
fn principled_materials_keep_all_their_numbers() {
    let number = |name: &str, value: f32| format!("<float name='{name}' value='{value}'/>");
    let both = [("roughness", 0.2), ("anisotropic", 0.3), ("sheen", 0.4), ("sheen_tint", 0.5), ("flatness", 0.6)];
    let said: String = both.iter().map(|(n, v)| number(n, *v)).collect();
    let (thick, _) = models(&format!(
        "<bsdf type='principled'>{said}{}{}{}</bsdf>",
        number("spec_trans", 0.7),
        number("clearcoat", 0.8),
        number("specular", 0.5)
    ));
    let (thin, _) = models(&format!("<bsdf type='principledthin'>{said}{}</bsdf>", number("diff_trans", 1.5)));
    let thick = thick.iter().find_map(|m| if let Material::Disney(m) = m { Some(*m) } else { None }).unwrap();
    let thin = thin.iter().find_map(|m| if let Material::DisneyThin(m) = m { Some(*m) } else { None }).unwrap();
    let all = [thick.roughness, thick.anisotropic, thick.sheen, thick.sheen_tint, thick.flatness, thick.coat];
    assert_eq!(all, [0.2, 0.3, 0.4, 0.5, 0.6, 0.8].map(Scalar::Constant));
    assert!(thick.transmission == Some(0.7.into()) && (thick.ior - 1.5).abs() < 1e-5, "{thick:?}");
    let all = [thin.roughness, thin.anisotropic, thin.sheen, thin.sheen_tint, thin.flatness, thin.through, thin.ior];
    assert_eq!(all, [0.2, 0.3, 0.4, 0.5, 0.6, 1.5, 1.5].map(Scalar::Constant));
}
