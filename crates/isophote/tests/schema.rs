//! The schema, the reader, the checker and the documentation agree on every key of a scene, limits included.

#[path = "schema/bounds.rs"]
mod bounds;
#[path = "schema/scenes.rs"]
mod scenes;

use std::collections::{BTreeMap, BTreeSet};

use bounds::{Bound, Visit, resolved, visit};
use isophote::scene::{ProblemKind, source};
use serde_json::Value;

fn schema() -> Value {
    serde_json::from_str(&source::schema()).expect("it is JSON")
}

/// What the scenes hold, place by place of the schema.
fn visits(schema: &Value) -> BTreeMap<String, Vec<(Value, Visit)>> {
    let mut visits: BTreeMap<_, Vec<_>> = BTreeMap::new();
    for scene in scenes::all() {
        for found in visit(schema, &scene) {
            visits.entry(found.place.clone()).or_default().push((scene.clone(), found));
        }
    }
    visits
}

/// The places of all keys below a table.
fn keys(schema: &Value, table: &Value, place: &str) -> Vec<String> {
    let table = resolved(schema, table);
    let inner = ["items", "additionalProperties"].into_iter().filter_map(|several| table.get(several));
    let within = inner.filter(|inner| inner.is_object()).flat_map(|inner| keys(schema, inner, &format!("{place}/*")));
    let own = table["properties"].as_object().into_iter().flatten().flat_map(|(key, value)| {
        let place = format!("{place}/{key}");
        let below = keys(schema, value, &place);
        std::iter::once(place).chain(below)
    });
    own.chain(within).collect()
}

#[test]
fn the_scenes_of_this_test_are_valid_and_have_every_key() {
    let schema = schema();
    for scene in scenes::all() {
        scenes::read(&scene).unwrap_or_else(|error| panic!("{error}"));
    }
    let visits = visits(&schema);
    let missing: Vec<String> = keys(&schema, &schema, "").into_iter().filter(|key| !visits.contains_key(key)).collect();
    assert_eq!(missing, Vec::<String>::new());
}

#[test]
fn the_reader_knows_exactly_the_keys_of_the_schema() {
    let schema = schema();
    let mut tables = 0;
    for (place, found) in visits(&schema) {
        let (scene, Visit { pointer, rule, .. }) = &found[0];
        let Some(properties) = rule["properties"].as_object() else { continue };
        tables += 1;
        assert_eq!(rule["additionalProperties"], false, "{place}");
        let mut scene = scene.clone();
        scene.pointer_mut(pointer).unwrap()["zzz"] = Value::from(1);
        let error = scenes::read(&scene).expect_err("no table has such a key");
        let [problem] = &error.problems[..] else { panic!("{place}: {error}") };
        assert_eq!(problem.kind, ProblemKind::UnknownKey, "{place}: {error}");
        let help = problem.help.as_ref().unwrap().to_string();
        let known = help.strip_prefix("allowed: ").unwrap();
        let keys: BTreeSet<&str> = properties.keys().map(String::as_str).collect();
        assert_eq!(known.split(", ").collect::<BTreeSet<_>>(), keys, "{place}");
    }
    assert_eq!(tables, 26, "the scene, and every sort of table in it");
}

/// A table in which a value is at a limit of the schema is valid in some scene; just beyond, it is refused in each. What else
/// is wrong then, such as a light on a shape of that size, is no matter of the limit.
#[test]
fn the_limits_of_the_schema_are_those_of_the_checker() {
    let schema = schema();
    let mut limits = 0;
    for (place, found) in visits(&schema) {
        let bounds: BTreeSet<Bound> = found.iter().flat_map(|(_, visit)| visit.bounds()).collect();
        for bound in bounds {
            limits += 1;
            let is_refused = |(scene, visit): &(Value, Visit), number: Value| {
                let mut scene = scene.clone();
                *scene.pointer_mut(&visit.pointer).unwrap() = number;
                let problems = scenes::read(&scene).err().map_or(Vec::new(), |error| error.problems);
                problems.iter().any(|problem| problem.path.starts_with(&visit.table()))
            };
            let with_it = || found.iter().filter(|(_, visit)| visit.bounds().contains(&bound));
            assert!(!with_it().all(|found| is_refused(found, bound.allowed())), "{place} at {bound:?}");
            assert!(with_it().all(|found| is_refused(found, bound.beyond())), "{place} beyond {bound:?}");
        }
    }
    assert!(limits > 50, "{limits}");
}

#[test]
fn the_documentation_names_every_key_with_its_limits() {
    let path = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs/scene-file.md");
    let text = std::fs::read_to_string(path).unwrap();
    let sections: Vec<&str> = text.split("\n## ").collect();
    let headed = |name: &str| {
        let headings = ["`[{}]`", "`[[{}]]`", "`[{}.NAME]`"].map(|heading| heading.replace("{}", name));
        sections.iter().filter(move |section| {
            let heading = section.lines().next().unwrap_or_default();
            headings.iter().any(|name| heading.contains(name))
        })
    };
    let schema = schema();
    let mut missing = Vec::new();
    for (place, found) in visits(&schema) {
        let mut steps = place.split('/').filter(|step| !matches!(*step, "" | "*"));
        let (Some(table), key) = (steps.next(), steps.next_back()) else { continue };
        let is_table = found[0].1.pointer.ends_with("/0") || found[0].1.rule.get("properties").is_some();
        let Some(key) = key else {
            // A key on top, or a table with a section of its own.
            let is_told = headed(table).next().is_some() || !lines_naming(sections[1], table).is_empty();
            missing.extend((!is_told).then_some(place));
            continue;
        };
        // What all shapes have is told of the first of them; the numbers that are the same for all, in the end.
        let is_shape = found[0].0.pointer(&format!("/{table}/0/casts_shadow")).is_some();
        let common = headed("sphere").filter(|_| is_shape);
        let limits = sections.iter().filter(|section| section.starts_with("Limits"));
        let lines: Vec<&str> =
            headed(table).chain(common).chain(limits).flat_map(|part| lines_naming(part, key)).collect();
        if lines.is_empty() && !is_table {
            missing.push(place);
            continue;
        }
        let told: Vec<f64> = lines.iter().flat_map(|line| numbers(line)).collect();
        let is_another_ones = lines.iter().any(|line| line.contains("the same; "));
        for bound in found.iter().flat_map(|(_, visit)| visit.bounds()).collect::<BTreeSet<_>>() {
            let is_told = bound.number() == 0.0 || is_another_ones || told.contains(&bound.number());
            missing.extend((!is_told).then(|| format!("{place}: {bound:?}")));
        }
    }
    assert_eq!(missing, Vec::<String>::new());
}

/// The lines of a text in which a word stands as code.
fn lines_naming<'t>(text: &'t str, word: &str) -> Vec<&'t str> {
    let is_word = |code: &str| code.split(|c: char| !c.is_alphanumeric() && c != '_').any(|part| part == word);
    text.lines().filter(|line| line.split('`').skip(1).step_by(2).any(is_word)).collect()
}

/// The numbers in a line.
fn numbers(line: &str) -> impl Iterator<Item = f64> {
    let line = line.replace('−', "-");
    let words: Vec<f64> = line
        .split(|c: char| !c.is_ascii_alphanumeric() && !matches!(c, '.' | '-'))
        .filter_map(|word| word.trim_end_matches('.').parse().ok())
        .collect();
    words.into_iter()
}

/// Numbers that stand in Rust and in the documentation, but not in the schema.
#[test]
fn the_documentation_has_the_limits_of_whole_scenes() {
    use isophote::map::Resolution;
    use isophote::scene::limits;
    let path = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs/scene-file.md");
    let text = std::fs::read_to_string(path).unwrap();
    let row = |start: &str| text.lines().find(|line| line.starts_with(start)).unwrap_or_else(|| panic!("{start}"));
    let has = |start: &str, limit: &dyn std::fmt::Display| {
        let limit: f64 = limit.to_string().parse().expect("it is a number");
        assert!(numbers(row(start)).any(|told| told == limit), "{limit} in {}", row(start));
    };
    has("| size of the file", &(limits::FILE_BYTES >> 20));
    assert_eq!([limits::SHAPES, limits::LIGHTS, limits::PROBES], [limits::SHAPES; 3]);
    has("| shapes of all kinds together, lights, probes", &limits::SHAPES);
    assert_eq!(limits::AREAS, limits::GRIDS);
    has("| areas, grids", &limits::GRIDS);
    has("| coordinates", &limits::COORDINATE);
    has("| radius, side, length", &limits::SMALLEST);
    has("| `points`", &Resolution::MOST_IN_MEMORY);
}
