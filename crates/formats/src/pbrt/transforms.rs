//! Directives that change the current transformation.

use super::directives::{Importer, bad, unknown};
use super::lexer::Kind;
use super::params::{Found, number};
use super::state;
use super::tokens::At;
use crate::diagnostic::Diagnostic;
use glam::{DAffine3, DVec3};

impl Importer<'_> {
    /// Whether this was such a directive.
    pub(super) fn transform(&mut self, word: &str, at: &At) -> Found<bool> {
        match word {
            "Identity" => self.state.change(|_| DAffine3::IDENTITY),
            "Translate" => {
                let v = DVec3::from_array(self.numbers(at)?);
                self.state.concat(DAffine3::from_translation(v));
            }
            "Scale" => {
                let v = DVec3::from_array(self.numbers(at)?);
                self.state.concat(DAffine3::from_scale(v));
            }
            "Rotate" => {
                let [angle, x, y, z] = self.numbers(at)?;
                let axis = DVec3::new(x, y, z).try_normalize();
                let axis = axis.ok_or_else(|| bad(at, "pbrt::transform", "a rotation needs an axis"))?;
                self.state.concat(DAffine3::from_axis_angle(axis, angle.to_radians()));
            }
            "LookAt" => {
                let [a, b, c, d, e, f, g, h, i] = self.numbers(at)?;
                let m = state::look_at(DVec3::new(a, b, c), DVec3::new(d, e, f), DVec3::new(g, h, i));
                let message = "the eye, the point looked at and the direction up must not lie in a line";
                self.state.concat(m.ok_or_else(|| bad(at, "pbrt::transform", message))?);
            }
            "Transform" => {
                let m = self.matrix(at)?;
                self.state.change(|_| m);
            }
            "ConcatTransform" => {
                let m = self.matrix(at)?;
                self.state.concat(m);
            }
            "CoordinateSystem" => {
                let name = self.string(at)?;
                self.coordinates.insert(name, self.state.ctm);
            }
            "CoordSysTransform" => self.coord_sys_transform(at)?,
            "ActiveTransform" => self.active_transform(at)?,
            // Passed over: motion begins and ends with the shutter.
            "TransformTimes" => drop(self.numbers::<2>(at)?),
            _ => return Ok(false),
        }
        Ok(true)
    }

    /// Exactly `N` numbers, in brackets or not.
    fn numbers<const N: usize>(&mut self, at: &At) -> Found<[f64; N]> {
        let opened = self.tokens.next_if(Kind::Open)?.is_some();
        let mut numbers = [0.0; N];
        for value in &mut numbers {
            let Some(token) = self.tokens.next_if(Kind::Number)? else {
                let error = at.tell(Diagnostic::error("pbrt::numbers", "too few numbers"), "behind this");
                return Err(Box::new(error.expected(format!("{N} numbers"))));
            };
            *value = number(&token)?;
        }
        if opened && self.tokens.next_if(Kind::Close)?.is_none() {
            let error = at.tell(Diagnostic::error("pbrt::numbers", "too many numbers"), "behind this");
            return Err(Box::new(error.expected(format!("{N} numbers"))));
        }
        Ok(numbers)
    }

    fn matrix(&mut self, at: &At) -> Found<DAffine3> {
        let m = state::matrix(&self.numbers(at)?);
        m.ok_or_else(|| {
            let error = bad(at, "pbrt::transform", "this matrix is no affine transformation");
            Box::new(error.expected("a last row of 0 0 0 1 (every fourth number)"))
        })
    }

    fn coord_sys_transform(&mut self, at: &At) -> Found<()> {
        let name = self.string(at)?;
        match self.coordinates.get(&name) {
            Some(ctm) => self.state.ctm = *ctm,
            None => return Err(unknown(at, "coordinate system", &name, self.coordinates.keys().map(String::as_str))),
        }
        Ok(())
    }

    fn active_transform(&mut self, at: &At) -> Found<()> {
        let Some(token) = self.tokens.next_if(Kind::Word)? else {
            return Err(Box::new(bad(at, "pbrt::transform", "which one?").expected("StartTime, EndTime or All")));
        };
        let word = token.at.text();
        self.state.active = match word.as_str() {
            "StartTime" => [true, false],
            "EndTime" => [false, true],
            "All" => [true, true],
            _ => return Err(unknown(&token.at, "time", &word, ["StartTime", "EndTime", "All"])),
        };
        Ok(())
    }

    pub(super) fn world_begin(&mut self) {
        self.state.ctm = [DAffine3::IDENTITY; 2];
        self.state.active = [true; 2];
        self.coordinates.insert("world".to_owned(), self.state.ctm);
    }
}
