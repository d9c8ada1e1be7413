//! Over the document, from top to bottom.

use super::bsdfs::{Cover, Wanted};
use super::document::{Document, Found};
use super::props::Props;
use super::textures::{Made, Picture};
use super::words;
use crate::diagnostic::Diagnostic;
use crate::files::Files;
use crate::load::Target;
use std::collections::{HashMap, HashSet};
use sunfleck::medium::InteriorId;
use sunfleck::scene::{MaterialId, ObjectId};

/// Makes a scene of a document.
pub(super) struct Importer<'d, 't> {
    pub(super) target: &'t mut Target,
    pub(super) files: Files,
    pub(super) document: &'d Document,
    /// What was made of elements, by number.
    pub(super) covers: HashMap<Wanted, Cover>,
    pub(super) textures: HashMap<usize, Made>,
    pub(super) groups: HashMap<usize, Option<ObjectId>>,
    /// Pictures that were read.
    pub(super) pictures: HashMap<Picture, Option<Made>>,
    /// Media by element; `None` for those that are left out.
    pub(super) media: HashMap<usize, Option<InteriorId>>,
    /// Materials with something behind them.
    pub(super) fillings: HashMap<(MaterialId, InteriorId), MaterialId>,
    /// The material of shapes that have none.
    pub(super) plain: Option<Cover>,
    /// Elements that are being made, to see when one is made of itself.
    busy: Vec<usize>,
    told: HashSet<String>,
}

impl<'d, 't> Importer<'d, 't> {
    pub(super) fn new(target: &'t mut Target, files: Files, document: &'d Document) -> Self {
        Self {
            target,
            files,
            document,
            covers: HashMap::new(),
            textures: HashMap::new(),
            groups: HashMap::new(),
            pictures: HashMap::new(),
            media: HashMap::new(),
            fillings: HashMap::new(),
            plain: None,
            busy: Vec::new(),
            told: HashSet::new(),
        }
    }

    /// Makes everything; findings go to the target's sink.
    pub(super) fn run(&mut self) {
        for number in &self.document.top {
            if self.target.sink.is_full() {
                return;
            }
            if let Err(error) = self.document.resolve(*number).and_then(|n| self.top(n)) {
                self.target.sink.error(*error);
            }
        }
        if let Err(error) = self.picture() {
            self.target.sink.error(*error);
        }
    }

    /// What stands directly in the scene. Sensors and integrators come last, and the rest waits until it is used.
    fn top(&mut self, number: usize) -> Found<()> {
        match self.document.elements[number].tag.as_str() {
            "shape" => self.shape(number),
            "emitter" => self.emitter(number),
            _ => Ok(()),
        }
    }

    /// What an element says.
    pub(super) fn props(&self, number: usize) -> Props<'d> {
        Props::new(self.document, number)
    }

    /// Makes the object of an element, if it is not being made already.
    pub(super) fn once<T>(&mut self, number: usize, make: impl FnOnce(&mut Self) -> Found<T>) -> Found<T> {
        if self.busy.contains(&number) || self.busy.len() > 100 {
            let at = &self.document.elements[number].at;
            return Err(at.bad("mitsuba::circle", "this object is made of itself"));
        }
        self.busy.push(number);
        let made = make(self);
        self.busy.pop();
        made
    }

    /// Tells of values and objects that meant nothing.
    pub(super) fn tell_unused(&mut self, props: &Props) {
        for finding in props.unused() {
            self.target.sink.warn("mitsuba::unused", || finding);
        }
    }

    /// A warning about the plugin of an element, once for each `code` and `key`.
    pub(super) fn warn_once(&mut self, code: &'static str, key: &str, props: &Props, message: &str) {
        if self.told.insert(format!("{code} {key}")) {
            let at = props.element.attribute("type").map_or(props.at(), |a| &a.at);
            self.target.sink.warn(code, || at.tell(Diagnostic::warning(code, message), ""));
        }
    }

    /// The nearest one stands for a plugin that we have not.
    pub(super) fn near(&mut self, what: &str, props: &Props, shown: &str) {
        let message = format!("`{what}` is shown as {shown}");
        self.warn_once("mitsuba::substitute", what, props, &message);
    }

    /// Whether an element is an object with a plugin, not a plain value.
    pub(super) fn is_object(&self, number: usize) -> bool {
        let element = &self.document.elements[number];
        element.attribute("type").is_some() && (element.tag == "spectrum" || words::OBJECTS.contains(&&*element.tag))
    }
}
