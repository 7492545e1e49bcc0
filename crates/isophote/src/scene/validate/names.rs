//! Validates names, which must differ among items of one kind.

use crate::message;
use crate::text::Message;
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
pub(super) fn usable() -> Message {
    let most = limits::NAME_BYTES;
    message!("allowed: any line of text of up to {most} bytes, without control and bidirectional characters", most)
}

/// The kinds of items that have names.
#[derive(Clone, Copy)]
pub(super) enum Kind {
    Shape,
    Light,
    Probe,
    Area,
    Grid,
}

/// Names of one kind of item, which must differ.
pub(super) struct Names {
    kind: Kind,
    seen: HashMap<String, Path>,
}

impl Names {
    pub(super) fn new(kind: Kind) -> Self {
        Self { kind, seen: HashMap::new() }
    }

    /// The name of the item at a path, or the default, which is that path.
    pub(super) fn check(&mut self, validator: &mut Validator<'_>, thing: &Path, name: Option<&str>) -> Option<String> {
        let name = name.map_or_else(|| thing.to_string(), str::to_owned);
        if !is_usable(&name) {
            validator.wrong(
                &thing.key("name"),
                message!("the name \"{name}\" is not usable", name = short(&name)),
                usable(),
            );
            return None;
        }
        if let Some(first) = self.seen.insert(name.clone(), thing.clone()) {
            let name = short(&name);
            let message = match self.kind {
                Kind::Shape => message!("there are two shapes named \"{name}\"", name),
                Kind::Light => message!("there are two lights named \"{name}\"", name),
                Kind::Probe => message!("there are two probes named \"{name}\"", name),
                Kind::Area => message!("there are two areas named \"{name}\"", name),
                Kind::Grid => message!("there are two grids named \"{name}\"", name),
            };
            validator.wrong(&thing.key("name"), message, message!("the other is {first}; names must differ", first));
            return None;
        }
        Some(name)
    }
}
