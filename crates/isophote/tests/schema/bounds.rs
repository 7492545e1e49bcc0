//! Where a scene's values stand in the schema, and what it allows there.

use serde_json::Value;

/// A value of a scene and what the schema says of it.
#[derive(Clone, Debug)]
pub struct Visit {
    /// The way to the rule: keys, and `*` for any item of a list or any name.
    pub place: String,
    /// The way to the value.
    pub pointer: String,
    /// The rule.
    pub rule: Value,
}

/// All values of a scene, the scene itself included.
pub fn visit(schema: &Value, scene: &Value) -> Vec<Visit> {
    let mut found = Vec::new();
    below(schema, schema, scene, "", "", &mut found);
    found
}

fn below(schema: &Value, rule: &Value, value: &Value, place: &str, pointer: &str, found: &mut Vec<Visit>) {
    let rule = resolved(schema, rule);
    if let Some(choices) = rule["anyOf"].as_array() {
        let fitting = |choice: &&Value| (choice["type"] == "array") == value.is_array();
        for choice in choices.iter().filter(fitting) {
            below(schema, choice, value, place, pointer, found);
        }
        return;
    }
    found.push(Visit { place: place.into(), pointer: pointer.into(), rule: rule.clone() });
    for (key, inner) in value.as_object().into_iter().flatten() {
        let pointer = format!("{pointer}/{key}");
        match rule["properties"].get(key) {
            Some(rule) => below(schema, rule, inner, &format!("{place}/{key}"), &pointer, found),
            None => below(schema, &rule["additionalProperties"], inner, &format!("{place}/*"), &pointer, found),
        }
    }
    for (index, inner) in value.as_array().into_iter().flatten().enumerate() {
        below(schema, &rule["items"], inner, &format!("{place}/*"), &format!("{pointer}/{index}"), found);
    }
}

/// The rule itself, where another place is named for it.
pub fn resolved<'s>(schema: &'s Value, rule: &'s Value) -> &'s Value {
    match rule.get("$ref").and_then(Value::as_str) {
        Some(place) => schema.pointer(place.trim_start_matches('#')).expect("the place is there"),
        None => rule,
    }
}

/// Which side of the numbers a limit is on.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Side {
    /// `minimum`
    Minimum,
    /// `exclusiveMinimum`
    Above,
    /// `maximum`
    Maximum,
}

/// A limit on a number; as text, which can be ordered.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Bound {
    side: Side,
    number: String,
}

impl Visit {
    /// The table of the scene that the value is in, as problems call it.
    pub fn table(&self) -> String {
        let mut steps = self.pointer.split('/').skip(1);
        let (name, next) = (steps.next().unwrap_or_default(), steps.next().unwrap_or_default());
        match (name, next.parse::<usize>()) {
            (_, Ok(index)) => format!("{name}[{index}]"),
            ("material", _) => format!("{name}.{next}"),
            _ => name.into(),
        }
    }

    /// The limits on this value.
    pub fn bounds(&self) -> Vec<Bound> {
        let sides = [("minimum", Side::Minimum), ("exclusiveMinimum", Side::Above), ("maximum", Side::Maximum)];
        let is_fixed = self.rule.get("const").is_some();
        let limited =
            sides.into_iter().filter_map(|(key, side)| Some(Bound { side, number: self.rule.get(key)?.to_string() }));
        limited.filter(|_| !is_fixed).collect()
    }
}

impl Bound {
    pub fn number(&self) -> f64 {
        self.number.parse().expect("a limit is a number")
    }

    /// A value at the limit; just above it where the limit itself is not allowed.
    pub fn allowed(&self) -> Value {
        match self.side {
            Side::Above => Value::from(self.number() + isophote::scene::limits::SMALLEST),
            Side::Minimum | Side::Maximum => serde_json::from_str(&self.number).expect("a limit is a number"),
        }
    }

    /// A value just beyond the limit; the limit itself where that is not allowed.
    pub fn beyond(&self) -> Value {
        let outwards = if self.side == Side::Maximum { 1 } else { -1 };
        if self.side == Side::Above {
            return Value::from(self.number());
        }
        if let Ok(whole) = self.number.parse::<i64>() {
            return Value::from(whole + outwards);
        }
        let number = self.number();
        let step = if number == 0.0 { 1e-12 } else { number.abs() * 1e-6 };
        Value::from(if self.side == Side::Maximum { number + step } else { number - step })
    }
}
