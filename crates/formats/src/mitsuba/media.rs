//! `medium`: what fills shapes. Media that absorb are read; those that scatter are told of, and left out.

use super::document::Found;
use super::props::Props;
use super::scene::Importer;
use super::spectra::{Given, Role};
use glam::Vec3;
use sunfleck::medium::{Interior, InteriorId};
use sunfleck::scene::MaterialId;

impl<'d> Importer<'d, '_> {
    /// What lies behind a shape.
    pub(super) fn filling(&mut self, shape: &Props<'d>) -> Found<Option<InteriorId>> {
        // Around the shape there is what it is inside of.
        for number in shape.objects("medium")? {
            self.medium(number)?;
        }
        shape.ignore(&["exterior"]);
        let Some((number, _)) = shape.get("interior") else { return Ok(None) };
        let number = self.document.resolve(number)?;
        if self.document.elements[number].tag == "medium" { self.medium(number) } else { Ok(None) }
    }

    /// A medium, made once. `None` if it scatters.
    fn medium(&mut self, number: usize) -> Found<Option<InteriorId>> {
        if let Some(made) = self.media.get(&number) {
            return Ok(*made);
        }
        let props = self.props(number);
        let sigma_a = self.sigma_a(&props)?;
        let made = sigma_a.map(|sigma_a| self.target.builder().interior(sigma_a));
        if made.is_none() {
            self.warn_once("mitsuba::medium", "", &props, "media that scatter are left out");
        }
        self.media.insert(number, made);
        Ok(made)
    }

    /// The absorption of a medium that does not scatter: `sigmaA` with `sigmaS`, or `sigma_t` with an albedo, of 0.
    fn sigma_a(&mut self, props: &Props) -> Found<Option<Interior>> {
        if props.element.plugin()?.0 != "homogeneous" {
            return Ok(None);
        }
        let scale = props.float("scale", 1.0)?.max(0.0) as f32;
        let mut given = |names: [&'static str; 2]| -> Found<Option<Given>> {
            for name in names {
                if let Some((number, element)) = props.get(name)
                    && element.tag != "texture"
                    && element.tag != "volume"
                {
                    return self.given(number).map(Some);
                }
            }
            Ok(None)
        };
        let is_black =
            |g: &Option<Given>| g.as_ref().is_some_and(|g| g.clone().colour(Role::Index).rgb() == Vec3::ZERO);
        let (absorbed, scattered) = (given(["sigmaA", "sigma_a"])?, given(["sigmaS", "sigma_s"])?);
        let (all, albedo) = (given(["sigmaT", "sigma_t"])?, given(["albedo", "albedo"])?);
        let sigma_a = match (absorbed, all) {
            (Some(absorbed), _) if is_black(&scattered) => absorbed,
            (_, Some(all)) if is_black(&albedo) => all,
            _ => return Ok(None),
        };
        Ok(Some(match sigma_a {
            Given::Rgb(rgb) => Interior::absorbing((rgb * scale).max(Vec3::ZERO), 1.0),
            Given::Curve(curve) => Interior::absorbing_curve(&curve.scaled(scale), 1.0),
        }))
    }

    /// `of` with something behind it, made once.
    pub(super) fn filled(&mut self, of: MaterialId, interior: InteriorId) -> MaterialId {
        if let Some(id) = self.fillings.get(&(of, interior)) {
            return *id;
        }
        let id = self.target.filled(of, interior);
        self.fillings.insert((of, interior), id);
        id
    }
}
