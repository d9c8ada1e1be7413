//! Matt and metal surfaces under a clear boundary, gloss over matt, and sheets that let light through.

use super::directives::Importer;
use super::params::{Found, Params};
use glam::Vec3;
use sunfleck::bsdf::{
    CoatedConductorMaterial, DiffuseTransmissionMaterial, Material, PlasticMaterial, PrincipledMaterial, Roughness,
    Scalar, TextureId,
};
use sunfleck::spectrum::Colour;
use sunfleck::texture::{Product, Texture};

const SMOOTH: Scalar = Scalar::Constant(0.0);

impl Importer<'_> {
    /// Version 4's matt base under a boundary.
    pub(super) fn coated_diffuse(&mut self, params: &Params) -> Found<Material> {
        self.pass_over_medium(params)?;
        let names = ["roughness", "uroughness", "vroughness"];
        Ok(PlasticMaterial {
            diffuse: self.spectrum(params, &["reflectance"], Vec3::splat(0.5))?,
            specular: self.target.builder().constant(Vec3::ONE),
            ior: self.eta(params, 1.5)?.d(),
            alpha: self.roughness(params, names, 0.0)?.unwrap_or(SMOOTH.into()),
            nonlinear: true,
        }
        .into())
    }

    /// Version 4's metal under a boundary.
    pub(super) fn coated_conductor(&mut self, params: &Params) -> Found<Material> {
        self.pass_over_medium(params)?;
        let names = ["conductor.roughness", "conductor.uroughness", "conductor.vroughness"];
        let alpha = self.roughness(params, names, 0.0)?.unwrap_or(SMOOTH.into());
        let names = ["interface.roughness", "interface.uroughness", "interface.vroughness"];
        let Roughness { u: coat_alpha, v, .. } = self.roughness(params, names, 0.0)?.unwrap_or(SMOOTH.into());
        if coat_alpha != v {
            self.near("anisotropic coats", params, "as rough along as across");
        }
        let metal = self.metal(params, ["conductor.eta", "conductor.k", "reflectance"])?;
        let coat_ior = self.index_of(params, "interface.eta", 1.5)?;
        Ok(CoatedConductorMaterial { metal, alpha, coat_ior, coat_alpha }.into())
    }

    /// What lies between the two boundaries is clear here, and takes up no room.
    fn pass_over_medium(&mut self, params: &Params) -> Found<()> {
        params.ignore(&["thickness", "g", "maxdepth", "nsamples", "twosided"]);
        if let Some(param) = params.get("albedo").cloned()
            && self.mean_spectrum(&param)? != Vec3::ZERO
        {
            self.near("a medium under a coat", params, "clear");
        }
        Ok(())
    }

    /// Gloss over a matt base, as version 3 has it: the boundary of an index tinted by `Ks`.
    pub(super) fn gloss(&mut self, name: &str, params: &Params) -> Found<Material> {
        self.near(name, params, "a matt base under a gloss (`principled`)");
        params.ignore(&["Kr", "Kt", "opacity"]);
        let base = self.spectrum(params, &["Kd"], Vec3::splat(if name == "substrate" { 0.5 } else { 0.25 }))?;
        let alpha = self.roughness(params, ["roughness", "uroughness", "vroughness"], 0.1)?;
        let roughness = self.perceived(alpha);
        let (ks, default) = (params.get("Ks").cloned(), if name == "substrate" { 0.5 } else { 0.25 });
        let specular_color = match ks {
            Some(_) => self.spectrum(params, &["Ks"], Vec3::ZERO)?,
            None => self.target.builder().constant(Vec3::splat(default)),
        };
        // `substrate` gives the reflectance along the normal itself: that of an endless index, tinted.
        let ior = if name == "substrate" { 1e6 } else { self.eta(params, 1.5)?.d() };
        Ok(PrincipledMaterial {
            roughness,
            ior: ior.into(),
            specular_color: Some(specular_color),
            ..PrincipledMaterial::new(base)
        }
        .into())
    }

    /// Disney's model, as far as ours has it.
    pub(super) fn disney(&mut self, params: &Params) -> Found<Material> {
        params.ignore(&["scatterdistance", "thin", "difftrans", "flatness", "speculartint", "sheentint"]);
        self.near("disney", params, "its opaque part (`principled`)");
        params.ignore(&["spectrans", "anisotropic"]);
        let base = self.spectrum(params, &["color"], Vec3::splat(0.5))?;
        let roughness = Scalar::Constant(self.float(params, "roughness", 0.5)?.clamp(0.0, 1.0) as f32);
        let unit = |this: &mut Self, name| -> Found<f32> { Ok(this.float(params, name, 0.0)?.clamp(0.0, 1.0) as f32) };
        let (metallic, coat, sheen) = (unit(self, "metallic")?, unit(self, "clearcoat")?, unit(self, "sheen")?);
        let gloss = self.float(params, "clearcoatgloss", 1.0)?.clamp(0.0, 1.0) as f32;
        Ok(PrincipledMaterial {
            metallic: metallic.into(),
            roughness: roughness.into(),
            ior: self.eta(params, 1.5)?.d().into(),
            // Its coat is a quarter of a boundary's, of alpha 0.1 to 0.001.
            coat: (0.25 * coat).into(),
            coat_roughness: (0.1 + (0.001 - 0.1) * gloss).sqrt().into(),
            sheen: (sheen > 0.0).then(|| self.target.builder().constant(Vec3::splat(sheen))),
            ..PrincipledMaterial::new(base)
        }
        .into())
    }

    /// Perceived roughness, of which alpha is the square.
    fn perceived(&mut self, alpha: Option<Roughness>) -> Roughness {
        let Some(Roughness { u, v, .. }) = alpha else { return SMOOTH.into() };
        let [u, v] = [u, v].map(|s| match s {
            Scalar::Constant(a) => Scalar::Constant(a.max(0.0).sqrt()),
            Scalar::Texture(id) => match self.mapped_values(id, &|a: f32| a.max(0.0).sqrt(), 0) {
                Some(id) => Scalar::Texture(id),
                None => Scalar::Constant(0.3),
            },
        });
        Roughness::aligned(u, v)
    }

    /// Paper and leaves: version 4 has a number to multiply both by, version 3 a colour.
    pub(super) fn sheet(&mut self, name: &str, params: &Params) -> Found<Material> {
        if name == "diffusetransmission" {
            let scale = params.number("scale", 1.0)? as f32;
            let reflectance = self.spectrum(params, &["reflectance"], Vec3::splat(0.25))?;
            let transmittance = self.spectrum(params, &["transmittance"], Vec3::splat(0.25))?;
            let [reflectance, transmittance] = [reflectance, transmittance].map(|id| self.times(id, scale));
            return Ok(DiffuseTransmissionMaterial { reflectance, transmittance }.into());
        }
        self.near(name, params, "evenly matt on both sides");
        params.ignore(&["Ks", "roughness", "remaproughness"]);
        let kd = self.spectrum(params, &["Kd"], Vec3::splat(0.25))?;
        let reflect = self.spectrum(params, &["reflect"], Vec3::splat(0.5))?;
        let transmit = self.spectrum(params, &["transmit"], Vec3::splat(0.5))?;
        let [reflectance, transmittance] = [reflect, transmit].map(|by| self.product_of(kd, by));
        Ok(DiffuseTransmissionMaterial { reflectance, transmittance }.into())
    }

    fn times(&mut self, id: TextureId, scale: f32) -> TextureId {
        if scale == 1.0 {
            return id;
        }
        let by = self.target.builder().constant(Colour::from(Vec3::splat(scale)));
        self.product_of(id, by)
    }

    fn product_of(&mut self, a: TextureId, b: TextureId) -> TextureId {
        self.target.builder().texture(Texture::Product(Product { of: [a, b] }))
    }
}
