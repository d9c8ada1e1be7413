//! From XML files to a document: includes are joined, `$names` filled in.

use super::document::{At, Attribute, Document, Element, Found, snake_case};
use super::words;
use crate::diagnostic::{Diagnostic, SourceFile, Span};
use crate::files::Files;
use crate::lines::shortened;
use crate::load::Target;
use std::collections::BTreeMap;
use std::ops::Range;
use std::path::Path;
use std::rc::Rc;

/// Elements may lie this deep in one another, files included.
const MAX_DEPTH: usize = 64;
/// A document may have this many elements.
const MAX_ELEMENTS: usize = 1 << 22;
/// One after the other, so many files may be included.
const MAX_FILES: usize = 10_000;
/// A value may have this many letters once names are filled in.
const MAX_VALUE: usize = 1 << 24;

/// What a `$name` stands for.
struct Define {
    value: String,
    is_used: bool,
}

/// Reads a scene's files.
pub(super) struct Reader<'t> {
    target: &'t mut Target,
    pub(super) files: Files,
    defines: BTreeMap<String, Define>,
    document: Document,
    aliases: Vec<(Attribute, Attribute)>,
    count: usize,
    /// Files that are open, to see when one includes itself.
    open: Vec<String>,
}

/// A place in the file that is being read.
#[derive(Clone, Copy)]
struct Here<'s> {
    source: &'s Rc<SourceFile>,
    is_old: bool,
    depth: usize,
}

impl Here<'_> {
    fn at(&self, range: Range<usize>) -> At {
        At { source: self.source.clone(), span: Span::new(range.start, range.end) }
    }
}

impl<'t> Reader<'t> {
    /// `defines` are those of the command line, which count before those of files.
    pub(super) fn new(target: &'t mut Target, files: Files, defines: &[(String, String)]) -> Self {
        let define = |(name, value): &(String, String)| (name.clone(), Define { value: value.clone(), is_used: false });
        Self {
            target,
            files,
            defines: defines.iter().map(define).collect(),
            document: Document::default(),
            aliases: Vec::new(),
            count: 0,
            open: Vec::new(),
        }
    }

    /// Reads the scene of `source` and all that it includes.
    pub(super) fn read(mut self, source: &Rc<SourceFile>) -> Found<(Document, Files)> {
        let given: Vec<String> = self.defines.keys().cloned().collect();
        let children = self.file(source, 0)?;
        self.document.top = children;
        for (old, new) in std::mem::take(&mut self.aliases) {
            let Some(target) = self.document.ids.get(&old.value).copied() else {
                return Err(old.at.unknown("object with the id", &old.value, self.ids()));
            };
            self.name(new.value, target, &new.at)?;
        }
        for name in given.into_iter().filter(|name| !self.defines[name].is_used) {
            let message = format!("no file uses `${name}`, which the command line sets");
            let names: Vec<&str> = self.defines.iter().filter(|(_, d)| d.is_used).map(|(n, _)| n.as_str()).collect();
            let told = Diagnostic::warning("mitsuba::unused-define", message).one_of(&name, names);
            self.target.sink.warn("mitsuba::unused-define", || told.in_file(source.name()));
        }
        Ok((self.document, self.files))
    }

    fn ids(&self) -> impl Iterator<Item = &str> {
        self.document.ids.keys().map(String::as_str)
    }

    /// What a file adds to the element that includes it: the children of its scene, or its one object.
    fn file(&mut self, source: &Rc<SourceFile>, depth: usize) -> Found<Vec<usize>> {
        self.count += 1;
        if self.open.iter().any(|name| name == source.name()) || self.count > MAX_FILES {
            let error = Diagnostic::error("mitsuba::include", "this file includes itself").in_file(source.name());
            return Err(Box::new(error));
        }
        let text = std::str::from_utf8(source.bytes()).map_err(|e| not_text(source, e.valid_up_to()))?;
        let options = roxmltree::ParsingOptions { nodes_limit: 1 << 24, ..Default::default() };
        let xml = roxmltree::Document::parse_with_options(text, options).map_err(|e| malformed(source, text, &e))?;
        let root = xml.root_element();
        let here = Here { source, is_old: is_old(&root), depth };
        self.open.push(source.name().to_owned());
        let found = if root.tag_name().name() == "scene" {
            self.children(root, here)
        } else if depth > 0 {
            let mut list = Vec::new();
            self.child(root, here, &mut list).map(|()| list)
        } else {
            let at = here.at(name_range(&root));
            let message = format!("the root of a scene is `scene`, not `{}`", shortened(root.tag_name().name()));
            Err(at.bad("mitsuba::root", message))
        };
        self.open.pop();
        found
    }

    fn children(&mut self, parent: roxmltree::Node, here: Here) -> Found<Vec<usize>> {
        if here.depth >= MAX_DEPTH {
            let at = here.at(name_range(&parent));
            return Err(at.bad("mitsuba::depth", "elements lie too deep in one another"));
        }
        let mut children = Vec::new();
        for node in parent.children() {
            if node.is_element() {
                self.child(node, here, &mut children)?;
            } else if let Some(text) = node.text().filter(|t| node.is_text() && !t.trim().is_empty()) {
                let at = here.at(node.range());
                let message = format!("text between elements means nothing: `{}`", shortened(text.trim()));
                self.target
                    .sink
                    .warn("mitsuba::text", || at.tell(Diagnostic::warning("mitsuba::text", message), "passed over"));
            }
        }
        Ok(children)
    }

    fn child(&mut self, node: roxmltree::Node, here: Here, list: &mut Vec<usize>) -> Found<()> {
        let tag = words::modern(node.tag_name().name());
        let at = here.at(name_range(&node));
        if !words::is_known(tag) {
            let message = format!("an unknown element `{}`", shortened(tag));
            let told = at.tell(Diagnostic::warning("mitsuba::unknown-element", message), "passed over");
            self.target.sink.warn("mitsuba::unknown-element", || told.one_of(tag, words::all()));
            return Ok(());
        }
        let mut attributes = Vec::new();
        for attribute in node.attributes() {
            let at = here.at(attribute.range_value());
            let value = self.filled(attribute.value(), &at)?;
            attributes.push(Attribute { name: attribute.name().to_owned(), value, at });
        }
        let mut element =
            Element { tag: tag.to_owned(), at, attributes, children: Vec::new(), name: None, is_old: here.is_old };
        if words::STEERING.contains(&tag) {
            return self.steer(&element, here, list);
        }
        element.name = element.attribute("name").map(|a| snake_case(&a.value));
        // Its number comes before those of its children, so that a name is known inside.
        let number = self.document.elements.len();
        if number >= MAX_ELEMENTS {
            return Err(element.at.bad("mitsuba::depth", format!("more than {MAX_ELEMENTS} elements")));
        }
        let id = element.attribute("id").filter(|_| tag != "ref").cloned();
        self.document.elements.push(element);
        if let Some(id) = id {
            self.name(id.value, number, &id.at)?;
        }
        let children = self.children(node, Here { depth: here.depth + 1, ..here })?;
        self.document.elements[number].children = children;
        list.push(number);
        Ok(())
    }

    fn name(&mut self, id: String, element: usize, at: &At) -> Found<()> {
        if let Some(first) = self.document.ids.get(&id) {
            let message = format!("two objects have the id `{}`", shortened(&id));
            let error = at.bad("mitsuba::id", message);
            let first = &self.document.elements[*first].at;
            return Err(Box::new(error.see(&first.source, first.span, "the first one")));
        }
        self.document.ids.insert(id, element);
        Ok(())
    }

    fn steer(&mut self, element: &Element, here: Here, list: &mut Vec<usize>) -> Found<()> {
        match element.tag.as_str() {
            "default" => {
                let (name, value) = (element.required("name")?, element.required("value")?);
                let define = Define { value: value.value.clone(), is_used: false };
                let known = self.defines.entry(name.value.clone()).or_insert(define);
                known.is_used = true;
            }
            "alias" => self.aliases.push((element.required("id")?.clone(), element.required("as")?.clone())),
            "include" => {
                let name = element.required("filename")?;
                let path = self.files.find(&name.value, here.source.name());
                let source =
                    self.files.include(&path, self.target).map_err(|e| Box::new(name.at.tell(*e, "named here")))?;
                if here.depth + 1 >= MAX_DEPTH {
                    return Err(name.at.bad("mitsuba::depth", "files include one another too deeply"));
                }
                list.extend(self.file(&source, here.depth + 1)?);
            }
            _ => {
                let folder = element.required("value")?;
                let beside = Path::new(here.source.name()).parent().unwrap_or(Path::new("."));
                if !self.files.look_into(beside.join(&folder.value)) {
                    let message = format!("there is no folder `{}`", shortened(&folder.value));
                    let told = folder.at.tell(Diagnostic::warning("mitsuba::path", message), "");
                    self.target.sink.warn("mitsuba::path", || told);
                }
            }
        }
        Ok(())
    }

    /// A value with `$names` filled in: of several that fit, the longest one.
    fn filled(&mut self, value: &str, at: &At) -> Found<String> {
        let mut filled = String::new();
        let mut rest = value;
        while let Some(start) = rest.find('$') {
            filled += &rest[..start];
            rest = &rest[start + 1..];
            let longest =
                self.defines.iter_mut().filter(|(n, _)| rest.starts_with(n.as_str())).max_by_key(|(n, _)| n.len());
            let Some((name, define)) = longest else {
                let end = rest.find(|c: char| !(c.is_alphanumeric() || c == '_')).unwrap_or(rest.len());
                let error = at.unknown("value for", &format!("${}", &rest[..end]), []);
                let names: Vec<String> = self.defines.keys().map(|n| format!("${n}")).collect();
                let error = error.one_of(&rest[..end], names.iter().map(String::as_str));
                return Err(Box::new(error.help("give it with -D NAME=VALUE, or by `default` in the file")));
            };
            define.is_used = true;
            filled += &define.value;
            rest = &rest[name.len()..];
            if filled.len() > MAX_VALUE {
                return Err(at.bad("mitsuba::value", "this value is too long"));
            }
        }
        Ok(filled + rest)
    }
}

/// Versions before 2 name properties in camel case and differ in some meanings.
fn is_old(root: &roxmltree::Node) -> bool {
    let major = root.attribute("version").and_then(|v| v.split('.').next()).and_then(|v| v.trim().parse::<u32>().ok());
    major.is_some_and(|major| major < 2)
}

/// The name of an element, for messages.
fn name_range(node: &roxmltree::Node) -> Range<usize> {
    let start = node.range().start + 1;
    start..start + node.tag_name().name().len()
}

fn not_text(source: &Rc<SourceFile>, at: usize) -> Box<Diagnostic> {
    let error = Diagnostic::error("mitsuba::text", "this byte is not UTF-8 text");
    Box::new(error.at(source, Span::new(at, at + 1), ""))
}

/// A mistake of the XML itself.
fn malformed(source: &Rc<SourceFile>, text: &str, error: &roxmltree::Error) -> Box<Diagnostic> {
    let pos = error.pos();
    let words = error.to_string();
    let message = words.strip_suffix(&format!(" at {pos}")).unwrap_or(&words);
    let offset = match error {
        roxmltree::Error::UnclosedRootNode => text.trim_end().len(),
        _ => offset_of(text, pos.row, pos.col),
    };
    let mut told = Diagnostic::error("mitsuba::xml", format!("malformed XML: {message}")).at(
        source,
        Span::new(offset, offset),
        "",
    );
    if let roxmltree::Error::DtdDetected = error {
        told = told.help("scenes have no document type: leave out `<!DOCTYPE ...>`");
    }
    Box::new(told)
}

/// From row and column in characters, both from 1, to bytes.
fn offset_of(text: &str, row: u32, column: u32) -> usize {
    let start: usize = text.split_inclusive('\n').take(row.saturating_sub(1) as usize).map(str::len).sum();
    let line = &text[start..];
    start + line.char_indices().nth(column.saturating_sub(1) as usize).map_or(line.len(), |(i, _)| i)
}
