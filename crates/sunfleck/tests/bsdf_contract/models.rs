//! The models under test, each at several settings, and the directions they are seen from.
use glam::{Vec2, Vec3, Vec4};
use std::collections::BTreeSet;
use sunfleck::{
    bsdf::*,
    math::Local,
    spectrum::{Ior, Rgb, Wavelengths},
    texture::Texture,
};

/// A model at one setting.
pub(crate) struct Case {
    /// What it is, for messages.
    pub(crate) label: String,
    pub(crate) model: &'static str,
    pub(crate) bsdf: Bsdf,
    /// η below the surface over η above it, for the first three lanes.
    pub(crate) eta: Vec3,
}

impl Case {
    /// Whether it has an inside and an outside.
    pub(crate) fn transmits(&self) -> bool {
        self.model.ends_with("dielectric")
            || [DiffuseTransmissionMaterial::NAME, DisneyThinMaterial::NAME].contains(&self.model)
            || self.label.contains("disney glass")
    }
    /// Relative error that f32 leaves: near grazing, the half vector of a narrow lobe is a small difference of unit vectors.
    pub(crate) fn tolerance(&self) -> f32 {
        if self.label.contains("alpha 0.001") || self.label.contains("roughness 0 ") { 2e-2 } else { 2e-3 }
    }
    /// Whether it never gives back more light than it gets, and is reciprocal. `NRenderer`'s Phong formula is neither: its
    /// highlight lacks the cosine that physics demands, and it is kept for the sake of its pictures. Disney's lobes are reciprocal,
    /// but just added up; sheets and coats of theirs give back too much.
    pub(crate) fn is_physical(&self) -> bool {
        ![NRendererPhongMaterial::NAME, DisneyMaterial::NAME, DisneyThinMaterial::NAME].contains(&self.model)
    }
}

/// Textures by their colours, so that a material can be written in one line.
struct Shelf {
    lambda: Wavelengths,
    textures: Vec<Texture>,
    cases: Vec<Case>,
}

impl Shelf {
    fn colour(&mut self, r: f32, g: f32, b: f32) -> TextureId {
        self.textures.push(Texture::Constant(Rgb::new(r, g, b).into()));
        TextureId(self.textures.len() as u32 - 1)
    }
    fn grey(&mut self, v: f32) -> TextureId {
        self.colour(v, v, v)
    }
    fn add(&mut self, setting: &str, material: impl Into<Material>) {
        self.add_between(setting, 1.0, material);
    }
    fn add_between(&mut self, setting: &str, eta: f32, material: impl Into<Material>) {
        self.add_by_lane(setting, Vec3::splat(eta), material);
    }
    fn add_by_lane(&mut self, setting: &str, eta: Vec3, material: impl Into<Material>) {
        let material = material.into();
        assert!(material.textures().iter().all(|t| (t.0 as usize) < self.textures.len()));
        let at = Lookup::new(&self.textures, Vec2::ZERO, Vec3::ZERO, self.lambda);
        let (bsdf, model) = (material.resolve(&at), material.name());
        self.cases.push(Case { label: format!("{model} {setting}"), model, bsdf, eta });
    }
}

/// Every model of the list, at settings that cover its range.
pub(crate) fn cases() -> Vec<Case> {
    let mut shelf = Shelf { lambda: Wavelengths::Rgb, textures: Vec::new(), cases: Vec::new() };
    plain(&mut shelf);
    dielectrics(&mut shelf);
    conductors(&mut shelf);
    glossy(&mut shelf);
    layered(&mut shelf);
    mitsubas(&mut shelf);
    dispersive(&mut shelf);
    shelf.cases
}

/// Glass that parts the wavelengths of a pass, more than any real one. In these cases lanes are not colours.
fn dispersive(s: &mut Shelf) {
    let (white, nm) = (s.grey(1.0), Vec4::new(560.0, 640.0, 430.0, 490.0));
    s.lambda = Wavelengths::Spectral(nm);
    let ior = Ior::Cauchy([1.4, 0.03, 0.0]);
    let eta = ior.at(s.lambda).to_rgb(Wavelengths::Rgb);
    let glass = DielectricMaterial { eta: ior, reflectance: white, transmittance: white };
    s.add_by_lane("dispersive", eta, glass);
    for alpha in [0.02, 0.3, 1.0] {
        s.add_by_lane(
            &format!("dispersive alpha {alpha}"),
            eta,
            RoughDielectricMaterial { glass, alpha: alpha.into() },
        );
    }
    s.lambda = Wavelengths::Rgb;
}

fn plain(s: &mut Shelf) {
    let (white, tint) = (s.grey(1.0), s.colour(0.9, 0.3, 0.1));
    s.add("white", DiffuseMaterial { reflectance: white });
    s.add("tinted", DiffuseMaterial { reflectance: tint });
    s.add("white", MirrorMaterial { reflect: white });
    s.add("tinted", MirrorMaterial { reflect: tint });
    s.add("", BlackMaterial);
}

fn dielectrics(s: &mut Shelf) {
    let (white, black) = (s.grey(1.0), s.grey(0.0));
    let (pink, green) = (s.colour(0.9, 0.4, 0.5), s.colour(0.2, 0.8, 0.3));
    for eta in [1.5, 1.33, 1.0 / 1.5, 2.4, 1.0] {
        let glass = DielectricMaterial { eta: eta.into(), reflectance: white, transmittance: white };
        s.add_between(&format!("eta {eta:.2}"), eta, glass);
    }
    for eta in [1.5, 1.0 / 1.5] {
        let pane = ThinDielectricMaterial { eta: eta.into(), reflectance: white, transmittance: white };
        s.add(&format!("eta {eta:.2}"), pane);
    }
    s.add("tinted", ThinDielectricMaterial { eta: 1.5.into(), reflectance: pink, transmittance: green });
    let brushed = Roughness::aligned(0.3.into(), 0.05.into());
    let glass = DielectricMaterial { eta: 1.5.into(), reflectance: white, transmittance: white };
    s.add_between("brushed", 1.5, RoughDielectricMaterial { glass, alpha: brushed });
    let tinted = DielectricMaterial { eta: 1.5.into(), reflectance: pink, transmittance: green };
    s.add_between("tinted", 1.5, tinted);
    for alpha in [0.0, 1e-3, 0.05, 0.3, 1.0] {
        for eta in [1.5, 1.0 / 1.33, 1.1] {
            let glass = DielectricMaterial { eta: eta.into(), reflectance: white, transmittance: white };
            s.add_between(
                &format!("eta {eta:.2} alpha {alpha}"),
                eta,
                RoughDielectricMaterial { glass, alpha: alpha.into() },
            );
        }
    }
    s.add_between("tinted", 1.5, RoughDielectricMaterial { glass: tinted, alpha: 0.4.into() });
    let opaque = DielectricMaterial { transmittance: black, ..tinted };
    s.add_between("opaque", 1.5, RoughDielectricMaterial { glass: opaque, alpha: 0.4.into() });
    let clear = DielectricMaterial { reflectance: black, ..tinted };
    s.add_between("without reflection", 1.5, RoughDielectricMaterial { glass: clear, alpha: 0.4.into() });
}

fn conductors(s: &mut Shelf) {
    let white = s.grey(1.0);
    // Johnson & Christy 1972 at about 650, 550 and 450 nm.
    let gold = (s.colour(0.16, 0.42, 1.38), s.colour(3.48, 2.36, 1.92));
    let (none, huge) = (s.grey(0.0), s.grey(1000.0));
    let ideal = ConductorMaterial { eta: none, k: huge, reflectance: white };
    let metal = ConductorMaterial { eta: gold.0, k: gold.1, reflectance: white };
    s.add("gold", metal);
    for (u, v) in [(0.4, 0.05), (0.02, 0.7)] {
        let alpha = Roughness::aligned(u.into(), v.into());
        s.add(&format!("gold brushed {u} {v}"), RoughConductorMaterial { metal, alpha });
        s.add(&format!("ideal brushed {u} {v}"), RoughConductorMaterial { metal: ideal, alpha });
    }
    s.add("ideal", ideal);
    for alpha in [0.0, 1e-3, 0.02, 0.3, 1.0] {
        s.add(&format!("gold alpha {alpha}"), RoughConductorMaterial { metal, alpha: alpha.into() });
        s.add(&format!("ideal alpha {alpha}"), RoughConductorMaterial { metal: ideal, alpha: alpha.into() });
    }
}

fn glossy(s: &mut Shelf) {
    let (white, black) = (s.grey(1.0), s.grey(0.0));
    let (diffuse, specular) = (s.colour(0.5, 0.3, 0.0), s.colour(0.4, 0.6, 0.2));
    for exponent in [0.0, 1.0, 10.0, 500.0, 1e5] {
        s.add(&format!("n {exponent}"), PhongMaterial { diffuse, specular, exponent });
        s.add(&format!("pure n {exponent}"), PhongMaterial { diffuse: black, specular: white, exponent });
        s.add(&format!("n {exponent}"), NRendererPhongMaterial { diffuse, specular, exponent });
    }
    s.add("too bright", PhongMaterial { diffuse: white, specular: white, exponent: 20.0 });
    s.add("nothing", PhongMaterial { diffuse: black, specular: black, exponent: 20.0 });
    let plastic = s.grey(0.04);
    for roughness in [0.0, 0.2, 0.5, 1.0] {
        for (f0, word, metallic) in
            [(black, "0", 0.0), (plastic, "0.04", 0.0), (plastic, "0.04", 0.5), (white, "1", 0.0)]
        {
            let setting = format!("white f0 {word} roughness {roughness} metallic {metallic}");
            s.add(&setting, CookTorranceMaterial { albedo: white, f0, roughness, metallic });
        }
    }
    s.add("metal", CookTorranceMaterial { albedo: diffuse, f0: black, roughness: 0.3, metallic: 1.0 });
    s.add("tinted", CookTorranceMaterial { albedo: diffuse, f0: plastic, roughness: 0.4, metallic: 0.2 });
}

/// Coats over matt surfaces and metals, and sheets.
fn layered(s: &mut Shelf) {
    let (white, black, body) = (s.grey(1.0), s.grey(0.0), s.colour(0.7, 0.4, 0.1));
    for (name, reflectance, transmittance) in
        [("white", white, white), ("paper", body, s.colour(0.2, 0.3, 0.3)), ("opaque", body, black)]
    {
        s.add(name, DiffuseTransmissionMaterial { reflectance, transmittance });
    }
    for (name, diffuse) in [("white", white), ("tinted", body), ("black", black)] {
        for nonlinear in [false, true] {
            for alpha in [0.0, 0.1, 0.5] {
                let plastic = PlasticMaterial { diffuse, specular: white, ior: 1.5, alpha: alpha.into(), nonlinear };
                s.add(&format!("{name} nonlinear {nonlinear} at {alpha}"), plastic);
            }
        }
    }
    let plain = PrincipledMaterial::new(white);
    for (i, r) in [0.1, 0.5, 1.0].into_iter().enumerate() {
        let rough = PrincipledMaterial { roughness: r.into(), ..plain };
        s.add(&format!("paint {r}"), rough);
        s.add(&format!("metal {r}"), PrincipledMaterial { metallic: 1.0.into(), ..rough });
        s.add(&format!("half metal {r}"), PrincipledMaterial { metallic: 0.5.into(), base: body, ..rough });
        let coat_roughness = [0.2, 0.6, 0.3][i].into();
        let coated = PrincipledMaterial { coat: 1.0.into(), coat_roughness, ..rough };
        s.add(&format!("coated {r}"), coated);
        s.add(&format!("coated metal {r}"), PrincipledMaterial { metallic: 1.0.into(), ..coated });
        let cloth = PrincipledMaterial { sheen: Some(white), sheen_roughness: r.into(), ..plain };
        s.add(&format!("cloth {r}"), cloth);
        let half = PrincipledMaterial { coat: 0.5.into(), metallic: 0.3.into(), base: body, ..cloth };
        let film = |thickness: f32| Some(FilmMaterial { share: 1.0.into(), ior: 1.8, thickness: thickness.into() });
        s.add(&format!("film on paint {r}"), PrincipledMaterial { film: film(280.0), ..rough });
        s.add(
            &format!("film on metal {r}"),
            PrincipledMaterial { film: film(450.0), metallic: 1.0.into(), base: body, ..rough },
        );
        s.add(&format!("all {r}"), PrincipledMaterial { coat_roughness: 0.4.into(), ..half });
    }
    let brushed = Roughness::aligned(0.8.into(), 0.3.into());
    s.add("brushed", PrincipledMaterial { roughness: brushed, metallic: 1.0.into(), ..plain });
    let gold = ConductorMaterial { eta: s.colour(0.16, 0.42, 1.38), k: s.colour(3.48, 2.36, 1.92), reflectance: white };
    for alpha in [0.1, 0.5] {
        let coated =
            CoatedConductorMaterial { metal: gold, alpha: alpha.into(), coat_ior: 1.5, coat_alpha: 0.05.into() };
        s.add(&format!("gold {alpha}"), coated);
    }
}

/// Mitsuba's kinds of landscape, and its plastic and Disney's materials.
fn mitsubas(s: &mut Shelf) {
    let (white, body) = (s.grey(1.0), s.colour(0.7, 0.4, 0.1));
    let gold = ConductorMaterial { eta: s.colour(0.16, 0.42, 1.38), k: s.colour(3.48, 2.36, 1.92), reflectance: white };
    let glass = DielectricMaterial { eta: 1.5.into(), reflectance: white, transmittance: white };
    for (word, facets) in [("separate", Facets::GgxSeparate), ("beckmann", Facets::Beckmann)] {
        for alpha in [0.001, 0.05, 0.3, 1.0] {
            let rough = Roughness::from(alpha).with(facets);
            s.add(&format!("{word} alpha {alpha}"), RoughConductorMaterial { metal: gold, alpha: rough });
            s.add_between(&format!("{word} alpha {alpha}"), 1.5, RoughDielectricMaterial { glass, alpha: rough });
        }
        let alpha = Roughness::aligned(0.4.into(), 0.05.into()).with(facets);
        s.add(&format!("{word} brushed"), RoughConductorMaterial { metal: gold, alpha });
        s.add_between(&format!("{word} brushed"), 1.5, RoughDielectricMaterial { glass, alpha });
        for (diffuse, nonlinear) in [(white, false), (white, true), (body, true)] {
            for alpha in [0.05, 0.4] {
                let boundary = RoughBoundary::new(1.5, alpha, facets);
                let plastic = RoughPlasticMaterial { diffuse, specular: white, boundary, nonlinear };
                s.add(&format!("{word} {} {nonlinear} {alpha}", diffuse.0), plastic);
            }
        }
    }
    let plain = DisneyMaterial { roughness: 0.4.into(), ..DisneyMaterial::new(body) };
    let dressed = DisneyMaterial { sheen: 0.8.into(), coat: 0.9.into(), coat_gloss: 0.3.into(), ..plain };
    let all = DisneyMaterial { metallic: 0.3.into(), anisotropic: 0.7.into(), flatness: 0.5.into(), ..dressed };
    let all = DisneyMaterial { specular_tint: 0.4.into(), sheen_tint: 0.6.into(), ..all };
    s.add("plain", plain);
    s.add("metal", DisneyMaterial { metallic: 1.0.into(), ..plain });
    s.add("dressed", dressed);
    s.add("all", all);
    for (word, opaque, clear) in
        [("plain", plain, 1.0), ("dressed", dressed, 1.0), ("all", all, 0.6), ("none", all, 0.0)]
    {
        s.add_between(&format!("glass {word}"), 1.5, DisneyMaterial { transmission: Some(clear.into()), ..opaque });
    }
    for (word, transmission, through) in [("matt", 0.0, 1.2), ("clear", 1.0, 0.0), ("half", 0.5, 0.7)] {
        let sheet = DisneyThinMaterial {
            base: body,
            roughness: 0.5.into(),
            anisotropic: 0.6.into(),
            transmission: transmission.into(),
            through: through.into(),
            ior: 1.33.into(),
            specular_tint: 0.3.into(),
            sheen: 0.5.into(),
            sheen_tint: 0.2.into(),
            flatness: 0.4.into(),
        };
        s.add(word, sheet);
    }
}

/// Directions from along the normal to grazing, above and below.
pub(crate) fn outgoing() -> Vec<Local> {
    let mut out = Vec::new();
    for side in [1.0, -1.0] {
        for (i, cos) in [1.0f32, 0.8, 0.5, 0.2, 0.02, 1e-4].into_iter().enumerate() {
            let (sin, phi) = ((1.0 - cos * cos).sqrt(), 0.4 + 2.0 * i as f32);
            out.push(Local(Vec3::new(sin * phi.cos(), sin * phi.sin(), side * cos)));
        }
    }
    out
}

#[test]
fn every_model_of_the_list_is_under_test() {
    let tested: BTreeSet<_> = cases().iter().map(|c| c.model).collect();
    let listed: BTreeSet<_> = MATERIALS.iter().map(|m| m.name).collect();
    assert_eq!(tested, listed);
    assert_eq!(listed.len(), MATERIALS.len(), "two models share a name");
}

#[test]
fn closures_stay_small() {
    // A light vertex or a gather point keeps one for a whole pass.
    assert!(size_of::<RoughConductor>() <= 64 && size_of::<RoughDielectric>() <= 64 && size_of::<CookTorrance>() <= 64);
    assert!(size_of::<Principled>() <= 64 && size_of::<Plastic>() <= 64 && size_of::<CoatedConductor>() <= 64);
    assert!(size_of::<Disney>() <= 64 && size_of::<DisneyThin>() <= 64 && size_of::<RoughPlastic>() <= 64);
    assert!(size_of::<Phong>() <= 64 && size_of::<NRendererPhong>() <= 64 && size_of::<Bsdf>() <= 80);
}

#[test]
fn vanishing_roughness_gives_the_smooth_model() {
    for c in cases().iter().filter(|c| c.label.ends_with("alpha 0")) {
        assert!(matches!(c.bsdf, Bsdf::Dielectric(_) | Bsdf::Conductor(_)), "{}", c.label);
    }
}
