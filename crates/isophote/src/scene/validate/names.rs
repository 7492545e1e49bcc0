//! Validates names, which must differ among items of one kind.

use std::collections::HashMap;

use super::Validator;
use crate::scene::document::Path;
use crate::scene::limits;
use crate::scene::problems::short;
use crate::text::is_control;

/// Whether a name can be shown as it is, on one line.
pub(super) fn is_usable(name: &str) -> bool {
    !name.is_empty() && name.len() <= limits::NAME_BYTES && !name.chars().any(is_control)
}

/// What names may be.
pub(super) fn usable() -> String {
    let most = limits::NAME_BYTES;
    format!("allowed: any line of text of up to {most} bytes, without control and bidirectional characters")
}

/// Names of one kind of item, which must differ.
pub(super) struct Names {
    kind: &'static str,
    seen: HashMap<String, Path>,
}

impl Names {
    pub(super) fn new(kind: &'static str) -> Self {
        Self { kind, seen: HashMap::new() }
    }

    /// The name of the item at a path, or the default, which is that path.
    pub(super) fn check(&mut self, validator: &mut Validator<'_>, thing: &Path, name: Option<&str>) -> Option<String> {
        let name = name.map_or_else(|| thing.to_string(), str::to_owned);
        if !is_usable(&name) {
            validator.wrong(&thing.key("name"), format!("the name \"{}\" is not usable", short(&name)), &usable());
            return None;
        }
        if let Some(first) = self.seen.insert(name.clone(), thing.clone()) {
            let message = format!("there are two {}s named \"{}\"", self.kind, short(&name));
            validator.wrong(&thing.key("name"), message, &format!("the other is {first}; names must differ"));
            return None;
        }
        Some(name)
    }
}
