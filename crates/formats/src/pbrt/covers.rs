//! Materials laid over others: reliefs, holes and mixes, and materials that are named before they are made.

use super::directives::{Importer, unknown};
use super::params::{Found, Param, Params};
use super::state::Cover;
use super::tokens::At;
use crate::lines::shortened;
use glam::Vec3;
use sunfleck::bsdf::{
    BlackMaterial, BumpMapMaterial, MaskMaterial, Material, MixMaterial, NormalMapMaterial, NullMaterial, Scalar,
};
use sunfleck::scene::MaterialId;

impl Importer<'_> {
    pub(super) fn make_named_material(&mut self, name: &str, params: Params) -> Found<()> {
        let Some(model) = params.string("type")?.map(str::to_owned) else {
            return Err(params.bad("pbrt::no-type", "a named material needs a `type`"));
        };
        let made = self.material(&model, params)?;
        if let Cover::Material(id) = made {
            self.target.name_material(name, id);
        }
        self.named_materials.insert(name.to_owned(), made);
        // As in version 4, names count in the whole file, also before they are given.
        if let Some((awaited, _)) = self.awaited.remove(name) {
            let id = self.material_id(made);
            self.exchange(awaited, id);
            let pierced: Vec<_> = self.masks.iter().filter(|m| m.0 == awaited).copied().collect();
            for (_, opacity, old) in pierced {
                let new = self.masked(id, opacity);
                self.exchange(old, new);
            }
            let held = self.blocks_and_state();
            held.filter(|c| **c == Some(Cover::Material(awaited))).for_each(|c| *c = Some(made));
        }
        Ok(())
    }

    /// Gives all surfaces so far of one material another.
    fn exchange(&mut self, old: MaterialId, new: MaterialId) {
        self.target.builder().exchange_material(old, new);
        if let Some((_, surfaces)) = &mut self.object {
            surfaces.iter_mut().filter(|s| s.material == old).for_each(|s| s.material = new);
        }
        let filled: Vec<_> = self.fillings.iter().filter(|f| f.0 == old).copied().collect();
        for (_, interior, old) in filled {
            let new = self.filled(new, interior);
            self.exchange(old, new);
        }
    }

    pub(super) fn named_material(&mut self, name: &str, at: &At) {
        let cover = self.named_materials.get(name).copied().unwrap_or_else(|| {
            let builder = self.target.builder();
            let awaited = self.awaited.entry(name.to_owned());
            Cover::Material(awaited.or_insert_with(|| (builder.material(BlackMaterial), at.clone())).0)
        });
        self.state.cover = Some(cover);
    }

    /// An error for each name that was never given to a material.
    pub(super) fn tell_awaited(&mut self) {
        let mut awaited: Vec<_> = std::mem::take(&mut self.awaited).into_iter().collect();
        awaited.sort_by(|a, b| a.0.cmp(&b.0));
        for (name, (_, at)) in awaited {
            let error = unknown(&at, "material", &name, self.named_materials.keys().map(String::as_str));
            self.target.sink.error(*error);
        }
    }

    /// The material itself; what is nothing becomes one that is.
    pub(super) fn material_id(&mut self, cover: Cover) -> MaterialId {
        match cover {
            Cover::Material(id) => id,
            Cover::Nothing => self.target.builder().material(NullMaterial),
        }
    }

    /// A material with the relief that its directive asks for.
    pub(super) fn with_relief(&mut self, model: Material, params: &Params) -> Found<MaterialId> {
        let mut of = self.target.builder().material(model);
        for name in ["displacement", "bumpmap"] {
            if let Some(param) = params.get(name).cloned()
                && param.kind == "texture"
            {
                let height = self.texture_of(&param)?.into();
                of = self.target.builder().material(BumpMapMaterial { of, height, scale: 1.0 });
            }
        }
        if params.get("normalmap").is_some()
            && let Some(map) = self.normal_map(params)?
        {
            of = self.target.builder().material(NormalMapMaterial { of, map, scale: 1.0 });
        }
        Ok(of)
    }

    /// Opacity in [0, 1]; `None` where it is 1 everywhere.
    pub(super) fn opacity(&mut self, param: &Param) -> Found<Option<Scalar>> {
        if param.kind == "texture" {
            return Ok(Some(self.texture_of(param)?.into()));
        }
        let Some(&[alpha, ..]) = param.numbers() else { return Err(param.expected("a number or a texture")) };
        Ok((alpha < 1.0).then_some(Scalar::Constant(alpha.max(0.0) as f32)))
    }

    /// `of` with holes, made once for each opacity.
    pub(super) fn masked(&mut self, of: MaterialId, opacity: Scalar) -> MaterialId {
        if let Some((.., id)) = self.masks.iter().rev().find(|m| (m.0, m.1) == (of, opacity)) {
            return *id;
        }
        let id = self.target.builder().material(MaskMaterial { of, opacity });
        self.masks.push((of, opacity, id));
        id
    }

    /// One of two materials at each place, by chance.
    pub(super) fn mix(&mut self, params: &Params) -> Found<Cover> {
        let names: Vec<String> = match params.get("materials").and_then(|p| p.strings()) {
            Some(names) => names.to_vec(),
            None => ["namedmaterial1", "namedmaterial2"]
                .into_iter()
                .filter_map(|n| params.string(n).transpose().map(|s| s.map(str::to_owned)))
                .collect::<Found<_>>()?,
        };
        let [first, second] = names.as_slice() else {
            return Err(params.bad("pbrt::mix", "a mix needs the names of two materials"));
        };
        let mut of = [first, second].map(|name| {
            let found = self.named_materials.get(name).copied();
            found.ok_or_else(|| {
                let known = self.named_materials.keys().map(String::as_str);
                unknown(&params.at, "material", &shortened(name), known)
            })
        });
        // Version 3 gives the share of the first.
        let of_first = self.picture.is_version_3;
        if of_first {
            of.reverse();
        }
        let [a, b] = of;
        let of = [self.material_id(a?), self.material_id(b?)];
        let amount: Scalar = match params.get("amount").cloned() {
            Some(param) if param.kind == "texture" => self.texture_of(&param)?.into(),
            Some(param) => (self.mean_spectrum(&param)?.element_sum() / 3.0).into(),
            None => 0.5.into(),
        };
        Ok(Cover::Material(self.target.builder().material(MixMaterial { of, amount })))
    }

    /// `uber` lets straight through what is not opaque.
    pub(super) fn uber_opacity(&mut self, of: MaterialId, params: &Params) -> Found<MaterialId> {
        let Some(param) = params.get("opacity").cloned() else { return Ok(of) };
        if param.kind == "texture" {
            let opacity = self.texture_of(&param)?.into();
            return Ok(self.masked(of, opacity));
        }
        let opacity = self.mean_spectrum(&param)?.clamp(Vec3::ZERO, Vec3::ONE).element_sum() / 3.0;
        Ok(if opacity < 1.0 { self.masked(of, opacity.into()) } else { of })
    }
}
