//! What each directive does.

use super::lexer::Kind;
use super::meshes::MeshCache;
use super::params::{Found, Params};
use super::picture::Picture;
use super::spectra::Role;
use super::state::{Attributes, Cover};
use super::textures::Textures;
use super::tokens::{At, Tokens};
use super::words;
use crate::diagnostic::Diagnostic;
use crate::files::Files;
use crate::lines::shortened;
use crate::load::Target;
use glam::DAffine3;
use std::collections::{HashMap, HashSet};
use std::rc::Rc;
use sunfleck::bsdf::Scalar;
use sunfleck::medium::InteriorId;
use sunfleck::scene::{MaterialId, ObjectId, SurfaceDef};
use sunfleck::spectrum::Colour;

/// Blocks may be nested this deep.
const MAX_BLOCKS: usize = 1000;
/// `Attribute` may set this many parameters for each kind of directive.
const MAX_DEFAULTS: usize = 250;

/// What is saved at the beginning of a block.
struct Block {
    /// Which directive began it.
    begin: &'static str,
    at: At,
    saved: Attributes,
}

/// Builds the scene while reading.
pub(super) struct Importer<'t> {
    pub(super) target: &'t mut Target,
    pub(super) files: Files,
    pub(super) tokens: Tokens,
    pub(super) state: Attributes,
    blocks: Vec<Block>,
    pub(super) coordinates: HashMap<String, [DAffine3; 2]>,
    pub(super) named_materials: HashMap<String, Cover>,
    /// Materials named before they were made: what stands for them, and where they were named first.
    pub(super) awaited: HashMap<String, (MaterialId, At)>,
    /// Materials with holes, by what is pierced and how.
    pub(super) masks: Vec<(MaterialId, Scalar, MaterialId)>,
    /// Materials with something behind them, by what they are and what that is.
    pub(super) fillings: Vec<(MaterialId, InteriorId, MaterialId)>,
    pub(super) media: HashMap<Rc<str>, InteriorId>,
    /// The material of what is a boundary of media only.
    pub(super) nothing: Option<MaterialId>,
    /// An interior that takes nothing.
    pub(super) empty: Option<InteriorId>,
    pub(super) meshes: MeshCache,
    pub(super) textures: Textures,
    pub(super) objects: HashMap<String, Option<ObjectId>>,
    /// The object that is being defined.
    pub(super) object: Option<(String, Vec<SurfaceDef>)>,
    pub(super) picture: Picture,
    /// Triangles that other shapes were cut into so far.
    pub(super) cut: usize,
    pub(super) known_spectra: HashMap<(&'static str, Role), Colour>,
    told: HashSet<String>,
}

impl<'t> Importer<'t> {
    pub(super) fn new(target: &'t mut Target, files: Files, tokens: Tokens) -> Self {
        Self {
            target,
            files,
            tokens,
            state: Attributes::default(),
            blocks: Vec::new(),
            coordinates: HashMap::new(),
            named_materials: HashMap::new(),
            awaited: HashMap::new(),
            masks: Vec::new(),
            fillings: Vec::new(),
            media: HashMap::new(),
            nothing: None,
            empty: None,
            meshes: MeshCache::default(),
            textures: Textures::default(),
            objects: HashMap::new(),
            object: None,
            picture: Picture::default(),
            cut: 0,
            known_spectra: HashMap::new(),
            told: HashSet::new(),
        }
    }

    /// Reads everything; findings go to the target's sink.
    pub(super) fn run(&mut self) {
        while !self.target.sink.is_full() {
            match self.step() {
                Ok(true) => {}
                Ok(false) => break,
                Err(error) => {
                    self.target.sink.error(*error);
                    // After a mistake in the text itself, what follows means nothing.
                    if !self.recover() {
                        break;
                    }
                }
            }
        }
        for block in std::mem::take(&mut self.blocks) {
            let message = format!("`{}` has no end", block.begin);
            let warning = Diagnostic::warning("pbrt::open-block", message);
            self.target.sink.warn("pbrt::open-block", || block.at.tell(warning, "begins here"));
        }
        self.tell_awaited();
        if self.target.sink.is_ok()
            && let Err(error) = self.finish_picture()
        {
            self.target.sink.error(*error);
        }
    }

    /// Passes over what cannot be a directive. False at the end.
    fn recover(&mut self) -> bool {
        loop {
            match self.tokens.peek() {
                Ok(Some(token)) if token.kind == Kind::Word && words::is_directive(&token.at.text()) => return true,
                Ok(Some(_)) => {
                    if self.tokens.next().is_err() {
                        return false;
                    }
                }
                Ok(None) | Err(_) => return false,
            }
        }
    }

    /// One directive; false at the end of the file.
    fn step(&mut self) -> Found<bool> {
        let Some(token) = self.tokens.next()? else { return Ok(false) };
        let word = token.at.text();
        if token.kind != Kind::Word {
            let message = format!("`{}` where a directive should stand", shortened(&word));
            return Err(Box::new(token.at.tell(Diagnostic::error("pbrt::stray", message), "")));
        }
        self.directive(&word, token.at)?;
        Ok(true)
    }

    fn directive(&mut self, word: &str, at: At) -> Found<()> {
        if self.transform(word, &at)? {
            return Ok(());
        }
        match word {
            "AttributeBegin" => self.begin("AttributeBegin", at)?,
            "TransformBegin" => self.begin("TransformBegin", at)?,
            "AttributeEnd" => self.end("AttributeBegin", &at)?,
            "TransformEnd" => self.end("TransformBegin", &at)?,
            "ObjectBegin" => self.object_begin(at)?,
            "ObjectEnd" => self.object_end(&at)?,
            "ObjectInstance" => self.object_instance(&at)?,
            "ReverseOrientation" => self.state.reverse = !self.state.reverse,
            "WorldBegin" => self.world_begin(),
            "WorldEnd" => {}
            "Include" | "Import" => self.include(&at)?,
            _ => return self.with_params(word, at),
        }
        Ok(())
    }

    /// Directives with parameters behind them.
    fn with_params(&mut self, word: &str, at: At) -> Found<()> {
        if !words::is_directive(word) {
            let message = format!("an unknown directive `{}`", shortened(word));
            let error = at.tell(Diagnostic::error("pbrt::unknown-directive", message), "");
            return Err(Box::new(error.one_of(word, words::all())));
        }
        if word == "Option" {
            return Params::read(&mut self.tokens, at).map(drop);
        }
        let name = self.string(&at)?;
        match word {
            "MediumInterface" => return self.medium_interface(&name, &at),
            "NamedMaterial" => {
                self.named_material(&name, &at);
                return Ok(());
            }
            "ColorSpace" => {
                if name != "srgb" {
                    let message = format!("colours of the space `{name}` are taken as sRGB's");
                    self.warn_once("pbrt::colour-space", &name, || at.tell(warning("pbrt::colour-space", message), ""));
                }
                return Ok(());
            }
            "Texture" => return self.texture(&name, &at),
            _ => {}
        }
        let params = Params::read(&mut self.tokens, at)?;
        match word {
            "Attribute" => self.attribute(&name, params)?,
            "Camera" => {
                let world_from_camera = self.state.ctm.map(|m| m.inverse());
                self.coordinates.insert("camera".to_owned(), world_from_camera);
                self.picture.camera = Some((name, params, self.state.ctm));
            }
            "Film" => self.film(&name, &params)?,
            "Sampler" => self.picture.sampler = Some(params),
            "PixelFilter" => self.picture.filter = Some((name, params)),
            "Integrator" | "SurfaceIntegrator" => self.picture.integrator = Some((name, params)),
            "Shape" => self.shape(&name, params)?,
            "LightSource" => self.light_source(&name, params)?,
            "AreaLightSource" => self.state.area_light = Some(Rc::new(self.area_light(&name, params)?)),
            "Material" => self.state.cover = Some(self.material(&name, params)?),
            "MakeNamedMaterial" => self.make_named_material(&name, params)?,
            "MakeNamedMedium" => self.make_named_medium(&name, params)?,
            _ => {}
        }
        Ok(())
    }

    /// The string behind a directive.
    pub(super) fn string(&mut self, at: &At) -> Found<String> {
        if let Some(token) = self.tokens.next_if(Kind::String)? {
            return Ok(token.at.text());
        }
        let error = at.tell(Diagnostic::error("pbrt::no-name", "this directive needs a name"), "");
        Err(Box::new(error.expected("a string in quotes")))
    }

    /// All covers that may still be asked for: now, and when a block ends.
    pub(super) fn blocks_and_state(&mut self) -> impl Iterator<Item = &mut Option<Cover>> {
        self.blocks.iter_mut().map(|b| &mut b.saved.cover).chain([&mut self.state.cover])
    }

    pub(super) fn begin(&mut self, begin: &'static str, at: At) -> Found<()> {
        if self.blocks.len() >= MAX_BLOCKS {
            return Err(bad(&at, "pbrt::depth", "too many blocks inside of one another"));
        }
        self.blocks.push(Block { begin, at, saved: self.state.clone() });
        Ok(())
    }

    /// Ends a block. `TransformEnd` brings the transformation back only.
    pub(super) fn end(&mut self, begin: &'static str, at: &At) -> Found<()> {
        match self.blocks.pop_if(|b| b.begin == begin) {
            Some(block) if begin == "TransformBegin" => {
                (self.state.ctm, self.state.active) = (block.saved.ctm, block.saved.active);
            }
            Some(block) => self.state = block.saved,
            None => {
                let error = bad(at, "pbrt::unmatched", "nothing to end here");
                return Err(match self.blocks.last() {
                    Some(open) => Box::new(error.see(&open.at.source, open.at.span, "the block that is open")),
                    None => error,
                });
            }
        }
        Ok(())
    }

    fn include(&mut self, at: &At) -> Found<()> {
        let Some(token) = self.tokens.next_if(Kind::String)? else {
            return Err(Box::new(bad(at, "pbrt::no-name", "which file?").expected("a file name in quotes")));
        };
        let path = self.files.find(&token.at.text(), token.at.source.name());
        let source = self.files.include(&path, self.target).map_err(|e| Box::new(token.at.tell(*e, "named here")))?;
        self.tokens.include(source, &token.at)
    }

    fn attribute(&mut self, kind: &str, params: Params) -> Found<()> {
        const KINDS: [&str; 5] = ["shape", "light", "material", "medium", "texture"];
        if !KINDS.contains(&kind) {
            return Err(unknown(&params.at, "kind", kind, KINDS));
        }
        let all = Rc::make_mut(&mut self.state.defaults);
        let at = params.at.clone();
        let list = all.entry(kind.to_owned()).or_default();
        list.extend(params.into_list());
        if list.len() > MAX_DEFAULTS {
            return Err(bad(&at, "pbrt::depth", "too many parameters for all that follows"));
        }
        Ok(())
    }

    /// What was said by `Attribute` for all directives of a kind.
    pub(super) fn with_defaults(&self, kind: &str, params: Params) -> Params {
        match self.state.defaults.get(kind) {
            Some(defaults) => params.with_defaults(defaults),
            None => params,
        }
    }

    /// Tells of parameters that meant nothing.
    pub(super) fn tell_unused(&mut self, params: &Params) {
        for finding in params.unused() {
            self.target.sink.warn("pbrt::unused-parameter", || finding);
        }
    }

    /// A warning that is told once for each `code` and `key`.
    pub(super) fn warn_once(&mut self, code: &'static str, key: &str, make: impl FnOnce() -> Diagnostic) {
        if self.told.insert(format!("{code} {key}")) {
            self.target.sink.warn(code, make);
        }
    }
}

/// An error at a directive.
pub(super) fn bad(at: &At, code: &'static str, message: &str) -> Box<Diagnostic> {
    Box::new(at.tell(Diagnostic::error(code, message), ""))
}

pub(super) fn warning(code: &'static str, message: impl Into<String>) -> Diagnostic {
    Diagnostic::warning(code, message)
}

/// A name that is not in the list.
pub(super) fn unknown<'n>(
    at: &At,
    what: &str,
    name: &str,
    names: impl IntoIterator<Item = &'n str>,
) -> Box<Diagnostic> {
    let mut names: Vec<&str> = names.into_iter().collect();
    names.sort_unstable();
    let error = at.tell(Diagnostic::error("pbrt::unknown-name", format!("no {what} `{}`", shortened(name))), "");
    Box::new(error.one_of(name, names))
}
