//! The JSON Schema and the reader accept the same scenes.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

use serde_json::{Value, json};

use crate::common::{Folder, LAB, names_in};

fn repository() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
}

fn schema() -> Value {
    Folder::new().ok("schema").json()
}

#[test]
fn the_schema_in_the_repository_is_the_programs() {
    let kept = std::fs::read_to_string(repository().join("schema/scene.schema.json")).unwrap();
    assert!(kept == Folder::new().ok("schema").stdout, "run `isophote schema > schema/scene.schema.json`");
}

#[test]
fn every_scene_of_the_repository_is_valid_by_the_schema_and_by_the_program() {
    let schema = schema();
    let folder = repository().join("scenes");
    let is_scene = |name: &String| Path::new(name).extension().is_some_and(|suffix| suffix == "toml");
    let names: Vec<String> = names_in(&folder).into_iter().filter(is_scene).collect();
    assert!(names.len() >= 20, "{names:?}");
    for name in names {
        let text = std::fs::read_to_string(folder.join(&name)).unwrap();
        let scene = serde_json::to_value(text.parse::<toml::Table>().unwrap()).unwrap();
        assert_eq!(violations(&schema, &schema, &scene), Vec::<String>::new(), "{name}");
        // Where it is, for the files beside it.
        Folder::new().ok(&format!("check {}", folder.join(&name).display()));
    }
}

#[test]
fn the_schema_refuses_what_the_program_refuses() {
    let schema = schema();
    let lab = serde_json::to_value(LAB.parse::<toml::Table>().unwrap()).unwrap();
    for (pointer, wrong) in [
        ("/version", json!(2)),
        ("/length", json!("inch")),
        ("/convention", json!("phong")),
        ("/camera/eye", json!([0, 0])),
        ("/camera/resolution/0", json!(0)),
        ("/camera/screen", json!({"distance": 5, "x": [-4, 4]})),
        ("/camera/screen/distance", json!(-5)),
        ("/material/clay/diffuse", json!(1.5e6)),
        ("/material/clay/diffuse", json!([0.5, 0.5])),
        ("/material/clay/diffuse", json!([0.5, 0.5, -1.5])),
        ("/material/clay/shininess", json!(0)),
        ("/sphere/0/radius", json!(0)),
        ("/sphere/0", json!({"center": [0, 0, 5], "raduis": 1})),
        ("/light/0/emission", json!("laser")),
        ("/light/0/intensity", json!(-1)),
        ("/light/0/intensity", json!([1, -1, 1])),
        ("/probe/0/at", Value::Null),
    ] {
        let mut scene = lab.clone();
        *scene.pointer_mut(pointer).unwrap() = wrong;
        assert_ne!(violations(&schema, &schema, &scene), Vec::<String>::new(), "{pointer}");
        let folder = Folder::with("scene.json", scene.to_string());
        assert_eq!(folder.run("check scene.json").code, Some(3), "{pointer}");
    }
}

#[test]
fn the_reader_knows_exactly_the_keys_of_the_schema() {
    let schema = schema();
    // Each table: its schema, and a scene with an unknown key in it, which the reader answers with those it knows.
    let tables = [
        ("", "zzz = 1"),
        ("/camera", "[camera]\nzzz = 1"),
        ("/camera/screen", "[camera.screen]\nzzz = 1"),
        ("/material/*", "[material.clay]\nzzz = 1"),
        ("/sphere/*", "[[sphere]]\nzzz = 1"),
        ("/light/*", "[[light]]\nzzz = 1"),
        ("/ambient", "[ambient]\nzzz = 1"),
        ("/probe/*", "[[probe]]\nzzz = 1"),
        ("/grid/*", "[[grid]]\nzzz = 1"),
    ];
    for (path, scene) in tables {
        let table = path.split('/').skip(1).fold(&schema, |outer, step| {
            let inner = match step {
                "*" => outer.get("items").or_else(|| outer.get("additionalProperties")).unwrap(),
                key => &outer["properties"][key],
            };
            resolved(&schema, inner)
        });
        assert_eq!(table["additionalProperties"], false, "{path}");
        let keys: BTreeSet<&str> = table["properties"].as_object().unwrap().keys().map(String::as_str).collect();
        let refusal = Folder::with("scene.toml", scene).run("check scene.toml").failed(3, &["has no key `zzz`"]);
        let (_, after) = refusal.stderr.split_once("has no key `zzz`").unwrap();
        let list = after.split_once("allowed: ").unwrap().1.lines().next().unwrap();
        assert_eq!(list.split(", ").collect::<BTreeSet<_>>(), keys, "{path}");
        // And each of them is read: whatever is wrong with it, it is not called unknown.
        for key in keys {
            let refusal = Folder::with("scene.toml", scene.replace("zzz", key)).run("check scene.toml").failed(3, &[]);
            assert!(!refusal.stderr.contains("has no key"), "{path}/{key}: {}", refusal.stderr);
        }
    }
}

#[test]
fn every_key_of_the_schema_is_described() {
    fn undescribed(schema: &Value, path: &str, found: &mut Vec<String>) {
        for (key, property) in schema["properties"].as_object().into_iter().flatten() {
            let path = format!("{path}/{key}");
            if property["description"].as_str().is_none_or(str::is_empty) {
                found.push(path.clone());
            }
            for inner in [property, &property["items"], &property["additionalProperties"]] {
                undescribed(inner, &path, found);
            }
        }
    }
    let mut found = Vec::new();
    undescribed(&schema(), "", &mut found);
    assert_eq!(found, Vec::<String>::new());
}

fn resolved<'s>(root: &'s Value, schema: &'s Value) -> &'s Value {
    match schema.get("$ref").and_then(Value::as_str) {
        Some(place) => root.pointer(place.strip_prefix('#').unwrap()).unwrap(),
        None => schema,
    }
}

/// What a value violates, by as much of JSON Schema as the schema uses; a keyword that is not known here fails.
fn violations(root: &Value, schema: &Value, value: &Value) -> Vec<String> {
    let mut found = Vec::new();
    if let Value::Bool(allowed) = schema {
        return if *allowed { found } else { vec![format!("{value} is not allowed")] };
    }
    for (keyword, rule) in schema.as_object().unwrap() {
        let number = || value.as_f64().zip(rule.as_f64());
        let length = || value.as_array().map(|items| items.len() as u64).zip(rule.as_u64());
        let holds = match keyword.as_str() {
            "$schema" | "$defs" | "title" | "description" | "default" | "format" => true,
            "$ref" => violations(root, resolved(root, schema), value).is_empty(),
            "type" => match rule.as_str().unwrap() {
                "object" => value.is_object(),
                "array" => value.is_array(),
                "string" => value.is_string(),
                "boolean" => value.is_boolean(),
                "number" => value.is_number(),
                "integer" => value.is_u64() || value.is_i64(),
                other => panic!("type {other}"),
            },
            "const" => value == rule,
            "enum" => rule.as_array().unwrap().contains(value),
            "oneOf" => {
                rule.as_array().unwrap().iter().filter(|one| violations(root, one, value).is_empty()).count() == 1
            }
            "anyOf" => rule.as_array().unwrap().iter().any(|one| violations(root, one, value).is_empty()),
            "minimum" => number().is_none_or(|(value, bound)| value >= bound),
            "maximum" => number().is_none_or(|(value, bound)| value <= bound),
            "exclusiveMinimum" => number().is_none_or(|(value, bound)| value > bound),
            "minItems" => length().is_none_or(|(length, bound)| length >= bound),
            "maxItems" => length().is_none_or(|(length, bound)| length <= bound),
            "items" => value.as_array().into_iter().flatten().all(|item| violations(root, rule, item).is_empty()),
            "required" => value.as_object().is_none_or(|table| {
                rule.as_array().unwrap().iter().all(|key| table.contains_key(key.as_str().unwrap()))
            }),
            "properties" => value
                .as_object()
                .into_iter()
                .flatten()
                .filter_map(|(key, inner)| Some((rule.get(key)?, inner)))
                .all(|(rule, inner)| violations(root, rule, inner).is_empty()),
            "additionalProperties" => {
                let known =
                    |key: &str| schema.get("properties").is_some_and(|properties| properties.get(key).is_some());
                value
                    .as_object()
                    .into_iter()
                    .flatten()
                    .all(|(key, inner)| known(key) || violations(root, rule, inner).is_empty())
            }
            other => panic!("the keyword {other}"),
        };
        if !holds {
            found.push(format!("{keyword} {rule} by {value}"));
        }
    }
    found
}
