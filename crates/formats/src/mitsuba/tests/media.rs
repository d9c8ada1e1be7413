//! What fills shapes.

use super::{loaded, told};
use glam::Vec3;
use sunfleck::spectrum::Wavelengths;

/// The absorption coefficients behind the surfaces that have something behind them.
fn behind(inner: &str) -> Vec<Vec3> {
    let file = loaded(inner);
    let parts = file.builder.parts();
    let filling = |m: u32| parts.fillings.get(m as usize).copied().flatten();
    let ids = parts.surfaces.iter().filter_map(|s| filling(s.material.0));
    ids.map(|id| parts.interiors[usize::from(id.0)].sigma_a(Wavelengths::Rgb).to_rgb(Wavelengths::Rgb)).collect()
}

#[test]
fn media_that_absorb_lie_behind_their_shapes() {
    let light = "<emitter type='point'/>";
    let shape = |medium: &str| format!("{light}<shape type='sphere'><bsdf type='dielectric'/>{medium}</shape>");
    let three = "<rgb name='sigma_t' value='1 2 3'/><float name='albedo' value='0'/><float name='scale' value='2'/>";
    let two = "<rgb name='sigmaA' value='2 4 6'/><spectrum name='sigmaS' value='0'/>";
    for inside in [three, two] {
        let medium = format!("<medium type='homogeneous' name='interior'>{inside}</medium>");
        let got = behind(&shape(&medium));
        assert!(got.len() == 1 && got[0].distance(Vec3::new(2.0, 4.0, 6.0)) < 1e-4, "{got:?}");
        assert_eq!(told(&shape(&medium)), "");
        let named = format!(
            "{}<shape type='sphere'><ref name='interior' id='m'/></shape>",
            medium.replace("name='interior'", "id='m'")
        );
        assert_eq!(behind(&format!("{light}{named}")).len(), 1);
        assert_eq!(behind(&shape(&medium.replace("interior", "exterior"))).len(), 0);
    }
    let fog = "<medium type='homogeneous' name='interior'><rgb name='sigma_t' value='1'/><float name='albedo' value='0.5'/></medium>";
    assert!(behind(&shape(fog)).is_empty() && told(&shape(fog)).contains("media that scatter are left out"));
}
