//! `MakeNamedMedium` and `MediumInterface`: what fills surfaces. Media that absorb are read; those that scatter are told of, and
//! left out.

use super::directives::{Importer, warning};
use super::params::{Found, Params};
use super::spectra::Role;
use super::tokens::At;
use crate::lines::shortened;
use glam::Vec3;
use std::rc::Rc;
use sunfleck::medium::{Interior, InteriorId};
use sunfleck::scene::MaterialId;
use sunfleck::spectrum::Colour;

/// The absorption coefficient of a medium that says nothing (pbrt 3 and 4), per scene unit.
const SIGMA_A: Vec3 = Vec3::new(0.0011, 0.0024, 0.014);

/// What the two names of `MediumInterface` are.
pub(super) type Interface = [Option<Rc<str>>; 2];

impl Importer<'_> {
    pub(super) fn make_named_medium(&mut self, name: &str, params: Params) -> Found<()> {
        let params = self.with_defaults("medium", params);
        let kind = params.string("type")?.unwrap_or("homogeneous").to_owned();
        // Without a word on scattering, a medium scatters.
        let scatters = match params.get("sigma_s").cloned() {
            Some(sigma_s) => self.colour(&sigma_s, Role::Index)?.rgb() != Vec3::ZERO,
            None => true,
        };
        if kind != "homogeneous" || scatters || params.get("preset").is_some() {
            let message = format!("the medium `{}` is left out: media do not scatter yet", shortened(name));
            self.warn_once("pbrt::medium", "", || params.at.tell(warning("pbrt::medium", message), ""));
            return Ok(());
        }
        let sigma_a = match params.get("sigma_a").cloned() {
            Some(sigma_a) => self.colour(&sigma_a, Role::Index)?,
            None => SIGMA_A.into(),
        };
        let scale = params.number("scale", 1.0)?.max(0.0) as f32;
        // Ours: pbrt has no such parameters.
        let ior = match params.get("ior").cloned() {
            Some(ior) => self.index(&ior)?,
            None => 1.0.into(),
        };
        let priority = params.integer("priority", 0..=i64::from(u16::MAX))?.unwrap_or(0) as u16;
        params.ignore(&["g"]);
        if params.get("Le").is_some() {
            self.near("a medium that glows", &params, "dark");
        }
        self.tell_unused(&params);
        let interior = absorbing(&sigma_a, scale, ior).with_priority(priority);
        let id = self.target.builder().interior(interior);
        self.media.insert(name.into(), id);
        Ok(())
    }

    /// The second name is optional: version 3 gives one for both sides.
    pub(super) fn medium_interface(&mut self, inside: &str, at: &At) -> Found<()> {
        let outside = match self.tokens.next_if(super::lexer::Kind::String)? {
            Some(token) => token.at.text(),
            None => inside.to_owned(),
        };
        let named = |name: &str| (!name.is_empty()).then(|| Rc::from(name));
        self.state.interface = [named(inside), named(&outside)];
        let known = |name: &Option<Rc<str>>| name.as_ref().is_none_or(|name| self.media.contains_key(name));
        if !self.state.interface.iter().all(known) {
            let message = "where a medium is left out, space is taken as empty";
            self.warn_once("pbrt::medium", "interface", || at.tell(warning("pbrt::medium", message), ""));
        }
        Ok(())
    }

    /// What lies behind shapes that come now.
    pub(super) fn filling(&mut self) -> Option<InteriorId> {
        let [inside, outside] = self.state.interface.clone();
        if inside == outside {
            return None;
        }
        let [inside, outside] = [inside, outside].map(|name| name.and_then(|name| self.media.get(&name).copied()));
        // A bubble in what absorbs holds nothing, which is something.
        inside.or_else(|| {
            outside.map(|_| {
                let Self { empty, target, .. } = self;
                *empty.get_or_insert_with(|| target.builder().interior(Interior::clear(1.0)))
            })
        })
    }

    /// `of` with something behind it, made once.
    pub(super) fn filled(&mut self, of: MaterialId, interior: InteriorId) -> MaterialId {
        if let Some((.., id)) = self.fillings.iter().rev().find(|f| (f.0, f.1) == (of, interior)) {
            return *id;
        }
        let id = self.target.filled(of, interior);
        self.fillings.push((of, interior, id));
        id
    }
}

fn absorbing(sigma_a: &Colour, scale: f32, ior: sunfleck::spectrum::Ior) -> Interior {
    match sigma_a.curve() {
        Some(curve) => Interior::absorbing_curve(&curve.scaled(scale), ior),
        None => Interior::absorbing((sigma_a.rgb() * scale).max(Vec3::ZERO), ior),
    }
}
