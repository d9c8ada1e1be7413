//! `bsdf`: what Mitsuba's models are among ours. What is only near is told of, once for each model.

use super::document::Found;
use super::indices;
use super::props::Props;
use super::scene::Importer;
use super::spectra::Role;
use glam::Vec3;
use sunfleck::bsdf::{
    BlackMaterial, BumpMapMaterial, DielectricMaterial, DiffuseMaterial, Facets, MaskMaterial, Material, MixMaterial,
    NormalMapMaterial, NullMaterial, PhongMaterial, PlasticMaterial, RoughBoundary, RoughConductorMaterial,
    RoughDielectricMaterial, RoughPlasticMaterial, Roughness, ThinDielectricMaterial, TwoSidedMaterial,
};
use sunfleck::scene::MaterialId;

/// The models of version 3, then those that only older versions have.
const BSDFS: [&str; 37] = [
    "blendbsdf",
    "bumpmap",
    "circular",
    "conductor",
    "dielectric",
    "diffuse",
    "hair",
    "mask",
    "measured",
    "measured_polarized",
    "normalmap",
    "null",
    "plastic",
    "polarizer",
    "pplastic",
    "principled",
    "principledthin",
    "retarder",
    "roughconductor",
    "roughdielectric",
    "roughplastic",
    "thindielectric",
    "twosided",
    "bump",
    "coating",
    "difftrans",
    "glass",
    "hk",
    "irawan",
    "lambertian",
    "mirror",
    "mixturebsdf",
    "phong",
    "roughcoating",
    "roughdiffuse",
    "roughglass",
    "ward",
];

/// What covers a surface.
#[derive(Clone, Copy, Debug)]
pub(super) struct Cover {
    pub(super) material: MaterialId,
    /// A boundary between media only: nothing to see.
    pub(super) is_nothing: bool,
    /// Whether it looks at texture coordinates.
    pub(super) varies: bool,
}

/// Which material of an element is meant.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(super) struct Wanted {
    /// Its number.
    pub(super) number: usize,
    /// What reflects does so on both sides, because a `twosided` is around it. In Mitsuba the inner side is black.
    pub(super) both_sides: bool,
    /// The mesh's texture coordinates are turned over, which pictures of normals must follow.
    pub(super) is_flipped: bool,
}

impl Importer<'_, '_> {
    /// What covers shapes that say nothing: matt grey.
    pub(super) fn plain_cover(&mut self) -> Cover {
        if let Some(cover) = self.plain {
            return cover;
        }
        let reflectance = self.constant(Vec3::splat(0.5)).id;
        let material = self.one_sided(DiffuseMaterial { reflectance });
        let cover = Cover { material, is_nothing: false, varies: false };
        self.plain = Some(cover);
        cover
    }

    /// A material that is black on the inner side.
    pub(super) fn one_sided(&mut self, model: impl Into<Material>) -> MaterialId {
        let front = Some(self.target.builder().material(model));
        self.target.builder().material(TwoSidedMaterial { front, back: None })
    }

    /// The material of an element, made once.
    pub(super) fn cover(&mut self, wanted: Wanted) -> Found<Cover> {
        if let Some(cover) = self.covers.get(&wanted) {
            return Ok(*cover);
        }
        let mut cover = self.once(wanted.number, |this| {
            let props = this.props(wanted.number);
            let cover = this.make_cover(&props, wanted)?;
            this.tell_unused(&props);
            Ok(cover)
        })?;
        cover.varies |= self.mentions_texture(wanted.number);
        if let Some(id) = self.document.elements[wanted.number].attribute("id") {
            self.target.name_material(&id.value, cover.material);
        }
        self.covers.insert(wanted, cover);
        Ok(cover)
    }

    /// Whether a texture is in an element, or in what it refers to.
    fn mentions_texture(&self, number: usize) -> bool {
        self.document.elements[number].children.iter().any(|child| {
            let target = self.document.resolve(*child).unwrap_or(*child);
            self.document.elements[target].tag == "texture"
        })
    }

    fn make_cover(&mut self, props: &Props, wanted: Wanted) -> Found<Cover> {
        let (name, _) = props.element.plugin()?;
        match name {
            "null" => {
                let material = self.target.builder().material(NullMaterial);
                return Ok(Cover { material, is_nothing: true, varies: false });
            }
            "twosided" => return self.two_sided(props, wanted),
            "mask" | "bumpmap" | "bump" | "normalmap" | "coating" | "roughcoating" => {
                return self.laid_over(name, props, wanted);
            }
            "blendbsdf" | "mixturebsdf" => return self.blend(name, props, wanted),
            "principled" | "principledthin" => return self.principled(name, props, wanted),
            _ => {}
        }
        let model = self.model(name, props)?;
        let is_clear =
            matches!(model, Material::Dielectric(_) | Material::RoughDielectric(_) | Material::ThinDielectric(_));
        let material =
            if wanted.both_sides || is_clear { self.target.builder().material(model) } else { self.one_sided(model) };
        Ok(Cover { material, is_nothing: false, varies: false })
    }

    fn model(&mut self, name: &str, props: &Props) -> Found<Material> {
        Ok(match name {
            "diffuse" | "lambertian" => self.diffuse(props)?.into(),
            "roughdiffuse" => {
                props.ignore(&["alpha", "use_fast_approx"]);
                self.near(name, props, "evenly matt (Lambert)");
                self.diffuse(props)?.into()
            }
            "dielectric" | "glass" => self.glass(props, "bk7")?.into(),
            "roughdielectric" | "roughglass" => {
                let glass = self.glass(props, "bk7")?;
                let alpha = self.alpha(props)?;
                RoughDielectricMaterial { glass, alpha }.into()
            }
            "thindielectric" => {
                let DielectricMaterial { eta, reflectance, transmittance } = self.glass(props, "bk7")?;
                ThinDielectricMaterial { eta, reflectance, transmittance }.into()
            }
            "conductor" | "mirror" => {
                props.ignore(&["alpha"]);
                self.metal(props)?.into()
            }
            "roughconductor" => {
                let alpha = self.alpha(props)?;
                RoughConductorMaterial { metal: self.metal(props)?, alpha }.into()
            }
            "plastic" | "roughplastic" | "pplastic" => self.plastic(name, props)?,
            "phong" => PhongMaterial {
                diffuse: self.input(props, &["diffuse_reflectance"], Vec3::splat(0.5), Role::Reflectance)?.id,
                specular: self.input(props, &["specular_reflectance"], Vec3::splat(0.2), Role::Reflectance)?.id,
                exponent: self.mean_of(props, "exponent", 30.0)?.clamp(0.0, 1e6) as f32,
            }
            .into(),
            "ward" => self.ward(props)?.into(),
            _ if BSDFS.contains(&name) => self.substitute(name, props)?.into(),
            _ => return Err(props.unknown_plugin("BSDF", &BSDFS)),
        })
    }

    fn diffuse(&mut self, props: &Props) -> Found<DiffuseMaterial> {
        let reflectance =
            self.input(props, &["reflectance", "diffuse_reflectance"], Vec3::splat(0.5), Role::Reflectance)?;
        Ok(DiffuseMaterial { reflectance: reflectance.id })
    }

    fn glass(&mut self, props: &Props, inside: &'static str) -> Found<DielectricMaterial> {
        Ok(DielectricMaterial {
            eta: indices::relative(props, inside)?.into(),
            reflectance: self.input(props, &["specular_reflectance"], Vec3::ONE, Role::Reflectance)?.id,
            transmittance: self.input(props, &["specular_transmittance"], Vec3::ONE, Role::Reflectance)?.id,
        })
    }

    /// The kind of landscape; others than Mitsuba 3's two are shown as GGX of the same roughness.
    fn facets(&mut self, props: &Props) -> Found<Facets> {
        let kind = props.word("distribution", "beckmann", &["beckmann", "ggx", "phong", "as"])?;
        if !["beckmann", "ggx"].contains(&kind) {
            self.near(&format!("distribution {kind}"), props, "the distribution `ggx` of the same roughness");
        }
        Ok(if kind == "beckmann" { Facets::Beckmann } else { Facets::GgxSeparate })
    }

    /// Roughness.
    fn alpha(&mut self, props: &Props) -> Found<Roughness> {
        props.ignore(&["sample_visible"]);
        let facets = self.facets(props)?;
        let alpha = self.scalar(props, "alpha", 0.1)?;
        let (u, v) = if props.has("alpha_u") || props.has("alpha_v") {
            (self.scalar(props, "alpha_u", 0.1)?, self.scalar(props, "alpha_v", 0.1)?)
        } else {
            (alpha, alpha)
        };
        Ok(Roughness::aligned(u, v).with(facets))
    }

    /// A matt base under a clear boundary.
    fn plastic(&mut self, name: &str, props: &Props) -> Found<Material> {
        props.ignore(&["specular_sampling_weight"]);
        let diffuse = self.input(props, &["diffuse_reflectance"], Vec3::splat(0.5), Role::Reflectance)?.id;
        let specular = self.input(props, &["specular_reflectance"], Vec3::ONE, Role::Reflectance)?.id;
        let ior = indices::relative(props, "polypropylene")?;
        let nonlinear = props.boolean("nonlinear", false)?;
        if name == "plastic" {
            return Ok(PlasticMaterial { diffuse, specular, ior, alpha: 0.0.into(), nonlinear }.into());
        }
        props.ignore(&["sample_visible"]);
        let alpha = self.mean_of(props, "alpha", 0.1)? as f32;
        let boundary = RoughBoundary::new(ior, alpha, self.facets(props)?);
        Ok(RoughPlasticMaterial { diffuse, specular, boundary, nonlinear }.into())
    }

    /// Ward's highlights as those of Phong's model that are as wide.
    fn ward(&mut self, props: &Props) -> Found<PhongMaterial> {
        self.near("ward", props, "Phong's highlights");
        props.ignore(&["variant"]);
        let alpha = self.mean_of(props, "alpha_u", 0.1)?.max(1e-3) * self.mean_of(props, "alpha_v", 0.1)?.max(1e-3);
        Ok(PhongMaterial {
            diffuse: self.input(props, &["diffuse_reflectance"], Vec3::splat(0.5), Role::Reflectance)?.id,
            specular: self.input(props, &["specular_reflectance"], Vec3::splat(0.2), Role::Reflectance)?.id,
            exponent: (2.0 / alpha - 2.0).clamp(0.0, 1e6) as f32,
        })
    }

    /// The nearest model for what has none of its own.
    fn substitute(&mut self, name: &str, props: &Props) -> Found<DiffuseMaterial> {
        self.near(name, props, "a matt surface");
        props.ignore(&[
            "filename",
            "transmittance",
            "material",
            "sigma_s",
            "sigma_a",
            "sigma_t",
            "albedo",
            "thickness",
        ]);
        props.ignore(&["eumelanin", "pheomelanin", "int_ior", "ext_ior", "theta", "delta", "longitudinal_roughness"]);
        self.diffuse(props)
    }

    /// One BSDF for both sides, or one for each.
    fn two_sided(&mut self, props: &Props, wanted: Wanted) -> Found<Cover> {
        let inner = props.objects("bsdf")?;
        let mut side = |i: usize| inner.get(i).map(|n| self.cover(Wanted { number: *n, both_sides: true, ..wanted }));
        let (front, back) = (side(0).transpose()?, side(1).transpose()?);
        let Some(front) = front else { return Err(props.bad("`twosided` needs a BSDF in it")) };
        let Some(back) = back else { return Ok(front) };
        let sides = TwoSidedMaterial { front: Some(front.material), back: Some(back.material) };
        let material = self.target.builder().material(sides);
        Ok(Cover { material, is_nothing: false, varies: front.varies || back.varies })
    }

    /// A BSDF that changes another one.
    fn laid_over(&mut self, name: &str, props: &Props, wanted: Wanted) -> Found<Cover> {
        let Some(inner) = props.object("bsdf")? else {
            return Err(props.bad(&format!("`{name}` needs a BSDF in it")));
        };
        let cover = self.cover(Wanted { number: inner, ..wanted })?;
        let of = cover.material;
        let picture = props.objects("texture")?.pop();
        let missing = || props.bad(&format!("`{name}` needs a texture in it"));
        let material: Material = match name {
            "mask" => MaskMaterial { of, opacity: self.scalar(props, "opacity", 0.5)? }.into(),
            "normalmap" => {
                props.ignore(&["normalmap", "flip_invalid_normals", "use_shadowing_function"]);
                let map = self.normals(picture.ok_or_else(missing)?, wanted.is_flipped)?;
                NormalMapMaterial { of, map, scale: 1.0 }.into()
            }
            "bumpmap" | "bump" => {
                let height = self.texture(picture.ok_or_else(missing)?)?.id;
                let height = self.as_numbers(height).into();
                BumpMapMaterial { of, height, scale: props.float("scale", 1.0)? as f32 }.into()
            }
            _ => {
                self.near(name, props, "what is below it");
                props.ignore(&[
                    "int_ior",
                    "ext_ior",
                    "thickness",
                    "sigma_a",
                    "alpha",
                    "distribution",
                    "specular_reflectance",
                ]);
                return Ok(cover);
            }
        };
        let material = self.target.builder().material(material);
        Ok(Cover { material, is_nothing: false, varies: true })
    }

    /// Several with weights that sum to 1; what is missing is black.
    fn blend(&mut self, name: &str, props: &Props, wanted: Wanted) -> Found<Cover> {
        let inner = props.objects("bsdf")?;
        let covers: Vec<Cover> =
            inner.iter().map(|n| self.cover(Wanted { number: *n, ..wanted })).collect::<Found<_>>()?;
        let varies = covers.iter().any(|c| c.varies);
        if let Some(weights) = props.string("weights")? {
            let weights = super::props::numbers(weights)?;
            if weights.len() != covers.len() || weights.iter().any(|w| *w < 0.0) {
                return Err(props.bad("there must be as many `weights` as BSDFs, each 0 or more"));
            }
            let black = self.target.builder().material(BlackMaterial);
            let mut mixed = black;
            let mut sum = (1.0 - weights.iter().sum::<f64>()).max(0.0);
            for (cover, weight) in covers.iter().zip(weights) {
                sum += weight;
                let amount = if sum > 0.0 { (weight / sum) as f32 } else { 0.0 };
                mixed =
                    self.target.builder().material(MixMaterial { of: [mixed, cover.material], amount: amount.into() });
            }
            return Ok(Cover { material: mixed, is_nothing: false, varies });
        }
        let [first, second] = covers[..] else {
            return Err(props.bad(&format!("`{name}` needs two BSDFs in it")));
        };
        let of = [first.material, second.material];
        let amount = match props.objects("texture")?.pop() {
            Some(texture) if !props.has("weight") => {
                let amount = self.texture(texture)?.id;
                self.as_numbers(amount).into()
            }
            _ => self.scalar(props, "weight", 0.5)?,
        };
        let material = self.target.builder().material(MixMaterial { of, amount });
        Ok(Cover { material, is_nothing: false, varies: true })
    }
}
