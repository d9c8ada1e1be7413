//! The JSON of a file, and short ways to its values.

use super::findings::Findings;
use crate::diagnostic::{Diagnostic, Sink, SourceFile, Span};
use serde_json::Value;

/// Parses the text. `None` after an error, which is in the sink, with line and column.
pub(super) fn parse(json: &[u8], told: &Findings, sink: &mut Sink) -> Option<Value> {
    let text = if let Some(rest) = json.strip_prefix(b"\xEF\xBB\xBF") {
        told.lapse(sink, "gltf::byte-order-mark", "JSON", "the text begins with a byte order mark");
        rest
    } else {
        json
    };
    match serde_json::from_slice::<Value>(text) {
        Ok(root) if root.is_object() => Some(root),
        Ok(root) => {
            let message = format!("the JSON holds {}", kind_of(&root));
            sink.error(told.file_error("gltf::json", message).expected("an object"));
            None
        }
        Err(error) => {
            sink.error(syntax_error(&error, text, told));
            None
        }
    }
}

fn syntax_error(error: &serde_json::Error, text: &[u8], told: &Findings) -> Diagnostic {
    let full = error.to_string();
    let reason = full.split(" at line ").next().unwrap_or(&full);
    let source = SourceFile::from_bytes(&told.file, text);
    let start: usize =
        text.split_inclusive(|b| *b == b'\n').take(error.line().saturating_sub(1)).map(<[u8]>::len).sum();
    let at = (start + error.column().saturating_sub(1)).min(text.len());
    let span = Span::new(at, (at + 1).min(text.len()));
    Diagnostic::error("gltf::json", format!("this is not JSON: {reason}")).at(&source, span, "")
}

/// A word for the kind of a value.
pub(super) fn kind_of(value: &Value) -> &'static str {
    match value {
        Value::Null => "null",
        Value::Bool(_) => "true or false",
        Value::Number(_) => "a number",
        Value::String(_) => "a text",
        Value::Array(_) => "a list",
        Value::Object(_) => "an object",
    }
}

static NOTHING: Value = Value::Null;

/// Short ways to the values of an object; what is missing or of another kind is the default.
pub(super) trait Fields {
    /// A value, or null.
    fn field(&self, key: &str) -> &Value;
    /// The elements of a list.
    fn items(&self, key: &str) -> &[Value];
    /// A number.
    fn number(&self, key: &str, default: f32) -> f32;
    /// Exactly `N` numbers.
    fn numbers<const N: usize>(&self, key: &str, default: [f32; N]) -> [f32; N];
    /// A whole number that counts or points to something.
    fn index(&self, key: &str) -> Option<usize>;
    /// A text.
    fn text(&self, key: &str) -> Option<&str>;
    /// Whether it is said to be true.
    fn flag(&self, key: &str) -> bool;
    /// The object of an extension.
    fn extension(&self, name: &str) -> Option<&Value>;
}

impl Fields for Value {
    fn field(&self, key: &str) -> &Value {
        self.get(key).unwrap_or(&NOTHING)
    }
    fn items(&self, key: &str) -> &[Value] {
        self.field(key).as_array().map_or(&[], Vec::as_slice)
    }
    fn number(&self, key: &str, default: f32) -> f32 {
        self.field(key).as_f64().map_or(default, |v| v as f32)
    }
    fn numbers<const N: usize>(&self, key: &str, default: [f32; N]) -> [f32; N] {
        let items = self.items(key);
        if items.len() != N {
            return default;
        }
        std::array::from_fn(|i| items[i].as_f64().map_or(default[i], |v| v as f32))
    }
    fn index(&self, key: &str) -> Option<usize> {
        whole(self.field(key))
    }
    fn text(&self, key: &str) -> Option<&str> {
        self.field(key).as_str()
    }
    fn flag(&self, key: &str) -> bool {
        self.field(key).as_bool().unwrap_or(false)
    }
    fn extension(&self, name: &str) -> Option<&Value> {
        self.field("extensions").get(name).filter(|e| e.is_object())
    }
}

/// A whole number of 0 or more, written with or without a decimal point.
pub(super) fn whole(value: &Value) -> Option<usize> {
    let number = value.as_u64().or_else(|| {
        let number = value.as_f64()?;
        (number >= 0.0 && number.fract() == 0.0 && number < 9e15).then_some(number as u64)
    });
    number.and_then(|n| usize::try_from(n).ok())
}
