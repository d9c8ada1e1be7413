//! MTL material libraries.

use crate::diagnostic::{Diagnostic, Sink, SourceFile, Span};
use crate::lines::{Line, Lines, finite, shortened};

/// A `newmtl` with its statements. `None` means the file does not say.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct MtlMaterial {
    /// The name; blanks inside are kept.
    pub name: String,
    /// `Kd`: diffuse reflectance.
    pub diffuse: Option<[f32; 3]>,
    /// `Ks`: specular reflectance.
    pub specular: Option<[f32; 3]>,
    /// `Ke`: emitted radiance.
    pub emission: Option<[f32; 3]>,
    /// `Tf`: transmittance.
    pub transmission: Option<[f32; 3]>,
    /// `Ns`: Phong exponent.
    pub exponent: Option<f32>,
    /// `Ni`: index of refraction.
    pub ior: Option<f32>,
    /// `d`, or 1 − `Tr`: opacity.
    pub opacity: Option<f32>,
    /// `illum`: the illumination model, 0 to 10.
    pub model: Option<u32>,
    /// `Pr`: roughness (the common extension for physically based materials).
    pub roughness: Option<f32>,
    /// `Pm`: metallic (the same extension).
    pub metallic: Option<f32>,
    /// `Pc`: clear coat (the same extension, as the next ones).
    pub coat: Option<f32>,
    /// `Pcr`: roughness of the clear coat.
    pub coat_roughness: Option<f32>,
    /// `Ps`: sheen.
    pub sheen: Option<f32>,
    /// `aniso`: anisotropy.
    pub anisotropy: Option<f32>,
    /// `anisor`: its rotation in turns.
    pub anisotropy_rotation: Option<f32>,
    /// `map_Kd`: picture of the diffuse reflectance, as written but with `/` between folders.
    pub diffuse_map: Option<String>,
    /// `map_Pr`: picture of the roughness.
    pub roughness_map: Option<String>,
    /// `map_Pm`: picture of the metalness.
    pub metallic_map: Option<String>,
    /// `map_Ps`: picture of the sheen.
    pub sheen_map: Option<String>,
    /// `map_Ke`: picture of the emitted radiance.
    pub emission_map: Option<String>,
    /// `map_d`: picture of the opacity.
    pub opacity_map: Option<String>,
    /// `norm`, or a picture of normals where heights are expected, as many programs write it.
    pub normal_map: Option<String>,
}

const KEYWORDS: [&str; 25] = [
    "newmtl", "Ka", "Kd", "Ks", "Ke", "Tf", "Ns", "Ni", "d", "Tr", "illum", "map_Kd", "Pr", "Pm", "Pc", "Pcr", "Ps",
    "aniso", "anisor", "map_Pr", "map_Pm", "map_Ps", "map_Ke", "map_d", "norm",
];

/// Statements that have no meaning for sunfleck.
const SILENT: [&str; 5] = ["ka", "map_ka", "sharpness", "map_aat", "tr_filter"];

/// Statements whose effect is left out.
const UNSUPPORTED: [&str; 10] =
    ["map_ks", "map_ns", "disp", "decal", "refl", "map_refl", "map_disp", "map_tr", "map_tf", "map_ni"];

impl MtlMaterial {
    fn set_picture(&mut self, key: &str, file: Option<String>) {
        match key {
            "map_kd" => self.diffuse_map = file,
            "map_pr" => self.roughness_map = file,
            "map_pm" => self.metallic_map = file,
            "map_ps" => self.sheen_map = file,
            "map_ke" => self.emission_map = file,
            "map_d" => self.opacity_map = file,
            // What is called by its name wins.
            "norm" | "map_norm" => self.normal_map = file.or(self.normal_map.take()),
            _ => self.normal_map = self.normal_map.take().or(file),
        }
    }
}

/// Reads an `.mtl` file. Keywords may be written in any case.
pub fn parse_mtl(source: &SourceFile, sink: &mut Sink) -> Vec<MtlMaterial> {
    let mut parser = Parser { source, sink, materials: Vec::new() };
    let start = if source.bytes().starts_with(b"\xEF\xBB\xBF") { 3 } else { 0 };
    for mut line in Lines::with_continuations(source, start) {
        if parser.sink.is_full() {
            break;
        }
        if let Some(word) = line.word() {
            parser.statement(&mut line, word);
        }
    }
    parser.materials
}

struct Parser<'s> {
    source: &'s SourceFile,
    sink: &'s mut Sink,
    materials: Vec<MtlMaterial>,
}

impl Parser<'_> {
    fn statement(&mut self, line: &mut Line, word: Span) {
        let source = self.source;
        let keyword = source.text(word).to_ascii_lowercase();
        if keyword == "newmtl" {
            let name = source.text(line.rest());
            return self.materials.push(MtlMaterial { name, ..MtlMaterial::default() });
        }
        if self.materials.is_empty() {
            return self.sink.warn("mtl::no-material", || {
                let message = format!("`{}` before any `newmtl`", shortened(&keyword));
                Diagnostic::warning("mtl::no-material", message).at(source, word, "skipped")
            });
        }
        let key = keyword.as_str();
        match key {
            "kd" | "ks" | "ke" | "tf" => self.colour(key, line, word),
            "ns" | "ni" | "d" | "tr" | "illum" | "pr" | "pm" | "pc" | "pcr" | "ps" | "aniso" | "anisor" => {
                self.number(key, line, word);
            }
            "map_kd" | "map_ke" | "map_pr" | "map_pm" | "map_ps" | "map_d" | "norm" | "map_norm" | "map_bump"
            | "bump" => {
                let file = picture_name(&source.text(line.rest()));
                if let Some(m) = self.materials.last_mut() {
                    m.set_picture(key, file);
                }
            }
            _ if SILENT.contains(&key) => {}
            _ if UNSUPPORTED.contains(&key) => self.sink.warn("mtl::unsupported", || {
                let message = format!("`{}` is not supported", source.text(word));
                Diagnostic::warning("mtl::unsupported", message).at(source, word, "left out")
            }),
            _ => self.sink.warn("mtl::unknown-keyword", || {
                Diagnostic::warning("mtl::unknown-keyword", format!("unknown keyword `{}`", shortened(key)))
                    .at(source, word, "the line is skipped")
                    .one_of(key, KEYWORDS)
            }),
        }
    }

    /// `r g b`, or `r` for grey.
    fn colour(&mut self, key: &str, line: &mut Line, word: Span) {
        let source = self.source;
        let mut values = Vec::with_capacity(3);
        while values.len() < 3
            && let Some(span) = line.number()
        {
            if values.is_empty() && matches!(source.slice(span), b"spectral" | b"xyz") {
                return self.sink.warn("mtl::unsupported", || {
                    let message = format!("a colour given as `{}` is not supported", source.text(span));
                    Diagnostic::warning("mtl::unsupported", message).at(source, span, "left out")
                });
            }
            match finite(source, span, "mtl::bad-number") {
                Ok(x) => values.push(x),
                Err(error) => return self.sink.error(*error),
            }
        }
        let Some(&first) = values.first() else { return self.missing(word) };
        let value = Some([first, values.get(1).copied().unwrap_or(first), values.get(2).copied().unwrap_or(first)]);
        let Some(m) = self.materials.last_mut() else { return };
        match key {
            "kd" => m.diffuse = value,
            "ks" => m.specular = value,
            "ke" => m.emission = value,
            _ => m.transmission = value,
        }
    }

    fn number(&mut self, key: &str, line: &mut Line, word: Span) {
        let Some(mut span) = line.number() else { return self.missing(word) };
        if key == "d" && self.source.slice(span) == b"-halo" {
            let Some(behind) = line.number() else { return self.missing(word) };
            span = behind;
        }
        let value = match finite(self.source, span, "mtl::bad-number") {
            Ok(value) => value,
            Err(error) => return self.sink.error(*error),
        };
        let Some(m) = self.materials.last_mut() else { return };
        match key {
            "ns" => m.exponent = Some(value),
            "ni" => m.ior = Some(value),
            "d" => m.opacity = Some(value),
            // `d` says the same thing more clearly; where both are given it wins.
            "tr" => m.opacity = m.opacity.or(Some(1.0 - value)),
            "pr" => m.roughness = Some(value),
            "pm" => m.metallic = Some(value),
            "pc" => m.coat = Some(value),
            "pcr" => m.coat_roughness = Some(value),
            "ps" => m.sheen = Some(value),
            "aniso" => m.anisotropy = Some(value),
            "anisor" => m.anisotropy_rotation = Some(value),
            _ => m.model = Some(value.max(0.0) as u32),
        }
    }

    fn missing(&mut self, word: Span) {
        let source = self.source;
        self.sink.warn("mtl::missing-number", || {
            let message = format!("`{}` without a number", source.text(word));
            Diagnostic::warning("mtl::missing-number", message).at(source, word, "the line is skipped")
        });
    }
}

/// The file name behind the options of a `map_` statement; `None` if there is none.
fn picture_name(text: &str) -> Option<String> {
    let mut rest = text.trim();
    while rest.starts_with('-') {
        let (option, behind) = rest.split_once(char::is_whitespace)?;
        let (least, most) = match option {
            "-o" | "-s" | "-t" => (1, 3),
            "-mm" => (2, 2),
            "-blendu" | "-blendv" | "-cc" | "-clamp" | "-bm" | "-boost" | "-texres" | "-imfchan" | "-type" => (1, 1),
            _ => (0, 0),
        };
        rest = behind.trim_start();
        for i in 0..most {
            let (word, behind) = rest.split_once(char::is_whitespace).unwrap_or((rest, ""));
            if i >= least && word.parse::<f32>().is_err() {
                break;
            }
            rest = behind.trim_start();
        }
    }
    (!rest.is_empty()).then(|| rest.replace('\\', "/"))
}
