//! Diagnostics as text, in the shape of rustc's.

use super::{Diagnostic, Place, Severity};
use annotate_snippets::{AnnotationKind, Group, Level, Origin, Renderer, Snippet};

/// At most this many valid names are listed.
const MAX_NAMES: usize = 24;

pub(super) fn render(diagnostic: &Diagnostic, colour: bool) -> String {
    let level = match diagnostic.severity {
        Severity::Error => Level::ERROR,
        Severity::Warning => Level::WARNING,
    };
    let mut group = Group::with_title(level.primary_title(diagnostic.message.as_str()));
    if let Some(place) = &diagnostic.place {
        group = add_place(group, place, AnnotationKind::Primary);
    }
    for place in &diagnostic.related {
        group = add_place(group, place, AnnotationKind::Context);
    }
    if let Some(expected) = &diagnostic.expected {
        group = group.element(Level::NOTE.message(format!("expected {expected}")));
    }
    if let Some(nearest) = &diagnostic.nearest {
        group = group.element(Level::HELP.message(format!("did you mean `{nearest}`?")));
    }
    if !diagnostic.valid.is_empty() {
        group = group.element(Level::NOTE.message(format!("known: {}", list(&diagnostic.valid))));
    }
    for help in &diagnostic.help {
        group = group.element(Level::HELP.message(help.as_str()));
    }
    let renderer = if colour { Renderer::styled() } else { Renderer::plain() };
    renderer.render(&[group])
}

/// The library finds the column by itself, except for an excerpt from the middle of a line.
fn add_place<'d>(group: Group<'d>, place: &'d Place, kind: AnnotationKind) -> Group<'d> {
    let origin = Origin::path(place.file.as_str());
    let Some(at) = &place.at else { return group.element(origin) };
    let mark = kind.span(at.excerpt.mark.clone()).label(label_of(place));
    let snippet = Snippet::source(at.excerpt.text.as_str()).line_start(at.line).annotation(mark);
    if at.excerpt.begins_late {
        group.element(origin.line(at.line).char_column(at.column)).element(snippet)
    } else {
        group.element(snippet.path(place.file.as_str()))
    }
}

fn label_of(place: &Place) -> Option<&str> {
    (!place.label.is_empty()).then_some(place.label.as_str())
}

fn list(names: &[String]) -> String {
    if names.len() <= MAX_NAMES {
        return names.join(", ");
    }
    format!("{}, … ({} in all)", names[..MAX_NAMES].join(", "), names.len())
}
