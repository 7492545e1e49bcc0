//! JSON as stores contain it.

use serde_json::{Map, Value};

/// Human-readable JSON with a final newline.
pub fn pretty(value: &Value) -> Vec<u8> {
    format!("{value:#}\n").into_bytes()
}

/// The keys of a JSON object.
pub fn object(value: Value) -> Map<String, Value> {
    match value {
        Value::Object(keys) => keys,
        _ => Map::new(),
    }
}
