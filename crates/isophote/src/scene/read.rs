//! From the tree to [`SceneSource`]: types and keys. Every key is named here once; what it may hold is checked in
//! `validate`.

mod files;
mod shapes;

use std::collections::{BTreeMap, HashSet};

use super::document::{Document, Entry, Node, Path, Value};
use super::error::{Problem, ProblemKind, Target};
use super::source::{
    AmbientSource, Amount, CameraSource, GridSource, LightSource, MaterialSource, ProbeSource, SamplingSource,
    SceneSource, ScreenSource, ShadowSource, SphereSource, WindowSource,
};
use crate::import::Origin;
use crate::units::Keyword;

/// Reads a scene out of a document. What cannot be read is reported and left out.
pub fn read(document: &Document, problems: &mut Problems) -> SceneSource {
    let mut source = SceneSource::default();
    if let Value::Table(entries) = &document.root.value {
        let mut table = Table { entries, path: Path::root(), known: Vec::new(), problems };
        source = read_scene(&mut table);
        table.refuse_unknown_keys();
    }
    source
}

fn read_scene(table: &mut Table<'_>) -> SceneSource {
    SceneSource {
        origin: Origin::default(),
        version: table.count("version"),
        title: table.text("title"),
        length: table.keyword("length"),
        handedness: table.keyword("handedness"),
        convention: table.keyword("convention"),
        quantities: table.keyword("quantities"),
        shadows: table.boolean("shadows"),
        color_space: table.keyword("color_space"),
        camera: table.table("camera", read_camera),
        sampling: table.table("sampling", read_sampling),
        material: table.named_tables("material", read_material),
        sphere: table.tables("sphere", read_sphere),
        ellipsoid: table.tables("ellipsoid", shapes::read_ellipsoid),
        cuboid: table.tables("box", shapes::read_cuboid),
        cylinder: table.tables("cylinder", shapes::read_cylinder),
        cone: table.tables("cone", shapes::read_cone),
        plane: table.tables("plane", shapes::read_plane),
        rectangle: table.tables("rectangle", shapes::read_rectangle),
        disk: table.tables("disk", shapes::read_disk),
        mesh: table.tables("mesh", files::read_mesh),
        spheres: table.tables("spheres", files::read_spheres),
        light: table.tables("light", read_light),
        ambient: table.table("ambient", read_ambient),
        probe: table.tables("probe", read_probe),
        grid: table.tables("grid", read_grid),
    }
}

fn read_camera(table: &mut Table<'_>) -> CameraSource {
    CameraSource {
        eye: table.numbers("eye"),
        forward: table.numbers("forward"),
        target: table.numbers("target"),
        up: table.numbers("up"),
        projection: table.keyword("projection"),
        screen: table.table("screen", read_screen),
        field_of_view: table.number("field_of_view"),
        window: table.table("window", read_window),
        longitude: table.numbers("longitude"),
        latitude: table.numbers("latitude"),
        resolution: table.counts("resolution"),
    }
}

fn read_sampling(table: &mut Table<'_>) -> SamplingSource {
    SamplingSource {
        samples: table.count("samples"),
        tolerance: table.number("tolerance"),
        filter: table.keyword("filter"),
    }
}

fn read_screen(table: &mut Table<'_>) -> ScreenSource {
    ScreenSource { distance: table.number("distance"), x: table.numbers("x"), y: table.numbers("y") }
}

fn read_window(table: &mut Table<'_>) -> WindowSource {
    WindowSource { x: table.numbers("x"), y: table.numbers("y") }
}

fn read_material(table: &mut Table<'_>) -> MaterialSource {
    MaterialSource {
        diffuse: table.amount("diffuse"),
        specular: table.amount("specular"),
        shininess: table.number("shininess"),
    }
}

fn read_sphere(table: &mut Table<'_>) -> SphereSource {
    SphereSource {
        name: table.text("name"),
        center: table.numbers("center"),
        radius: table.number("radius"),
        material: table.text("material"),
        shadow: read_shadow(table),
    }
}

fn read_shadow(table: &mut Table<'_>) -> ShadowSource {
    ShadowSource { casts_shadow: table.boolean("casts_shadow"), receives_shadow: table.boolean("receives_shadow") }
}

fn read_light(table: &mut Table<'_>) -> LightSource {
    LightSource {
        name: table.text("name"),
        position: table.numbers("position"),
        intensity: table.amount("intensity"),
        power: table.amount("power"),
        emission: table.keyword("emission"),
        axis: table.numbers("axis"),
        target: table.numbers("target"),
        inner_angle: table.number("inner_angle"),
        outer_angle: table.number("outer_angle"),
        direction: table.numbers("direction"),
        irradiance: table.amount("irradiance"),
        casts_shadows: table.boolean("casts_shadows"),
    }
}

fn read_ambient(table: &mut Table<'_>) -> AmbientSource {
    AmbientSource {
        radiance: table.amount("radiance"),
        obstructed: table.boolean("obstructed"),
        samples: table.count("samples"),
    }
}

fn read_probe(table: &mut Table<'_>) -> ProbeSource {
    ProbeSource { name: table.text("name"), at: table.numbers("at"), published: table.number("published") }
}

fn read_grid(table: &mut Table<'_>) -> GridSource {
    GridSource {
        name: table.text("name"),
        corner: table.numbers("corner"),
        center: table.numbers("center"),
        u: table.numbers("u"),
        v: table.numbers("v"),
        points: table.counts("points"),
        side: table.keyword("side"),
    }
}

/// Problems as they are found, each place at most once.
#[derive(Default)]
pub struct Problems {
    list: Vec<Problem>,
    reported: HashSet<Path>,
}

impl Problems {
    /// Notes a problem, unless something around its place is already known to be wrong.
    pub fn push(&mut self, kind: ProblemKind, path: &Path, message: impl Into<String>, help: impl Into<String>) {
        if !self.reported.contains(path) {
            self.reported.insert(path.clone());
            let problem = Problem::new(kind, Target::Value(path.clone()), message.into());
            self.list.push(problem.with_help(help));
        }
    }

    /// Notes that a key is missing from a table, unless the key is there and already known to be wrong.
    pub fn missing(&mut self, table: &Path, key: &str, help: impl Into<String>) {
        if self.reported.insert(table.key(key)) {
            let target = Target::Table(table.clone());
            let place = if *table == Path::root() { String::new() } else { format!(" in `{table}`") };
            let message = format!("the key `{key}` is missing{place}");
            let mut problem = Problem::new(ProblemKind::MissingKey, target, message).with_help(help);
            problem.path = table.key(key).to_string();
            self.list.push(problem);
        }
    }

    /// Notes problems that were found before the scene was read.
    pub fn extend(&mut self, problems: impl IntoIterator<Item = Problem>) {
        self.list.extend(problems);
    }

    /// All problems, in the order in which they were found.
    pub fn into_list(self) -> Vec<Problem> {
        self.list
    }

    /// Whether the thing at a path is known to be wrong.
    pub fn has(&self, path: &Path) -> bool {
        self.reported.contains(path)
    }

    /// Whether nothing was found.
    pub fn is_empty(&self) -> bool {
        self.list.is_empty()
    }
}

/// A table while it is read.
struct Table<'t> {
    entries: &'t [Entry],
    path: Path,
    known: Vec<&'static str>,
    problems: &'t mut Problems,
}

impl<'t> Table<'t> {
    fn find(&mut self, key: &'static str) -> Option<&'t Node> {
        self.known.push(key);
        self.entries.iter().find(|entry| entry.key == key).map(|entry| &entry.node)
    }

    /// The value of a key by `convert`; one that has none is reported as not being `expected`.
    fn value<T>(&mut self, key: &'static str, expected: &str, convert: impl FnOnce(&Value) -> Option<T>) -> Option<T> {
        let node = self.find(key)?;
        let value = convert(&node.value);
        if value.is_none() {
            self.wrong_type(&self.path.key(key), &node.value, expected);
        }
        value
    }

    fn wrong_type(&mut self, path: &Path, value: &Value, expected: &str) {
        let message = format!("`{path}` is {}", value.describe());
        self.problems.push(ProblemKind::WrongType, path, message, format!("allowed: {expected}"));
    }

    fn text(&mut self, key: &'static str) -> Option<String> {
        self.value(key, "a text in quotes", |value| match value {
            Value::Text(text) => Some(text.clone()),
            _ => None,
        })
    }

    fn number(&mut self, key: &'static str) -> Option<f64> {
        let number = self.value(key, "a number", as_number)?;
        self.finite(&self.path.key(key), number)
    }

    /// A number, or three.
    fn amount(&mut self, key: &'static str) -> Option<Amount> {
        const EXPECTED: &str = "a number, or a list of three: [red, green, blue]";
        let entry = self.entries.iter().find(|entry| entry.key == key);
        if entry.is_some_and(|entry| matches!(entry.node.value, Value::Array(_))) {
            return self.numbers_expected(key, EXPECTED).map(Amount::Rgb);
        }
        let number = self.value(key, EXPECTED, as_number)?;
        self.finite(&self.path.key(key), number).map(Amount::Number)
    }

    fn boolean(&mut self, key: &'static str) -> Option<bool> {
        self.value(key, "true or false", |value| match value {
            Value::Boolean(value) => Some(*value),
            _ => None,
        })
    }

    fn count(&mut self, key: &'static str) -> Option<u64> {
        self.value(key, "a whole number, not negative", as_count)
    }

    fn numbers<const N: usize>(&mut self, key: &'static str) -> Option<[f64; N]> {
        self.numbers_expected(key, &format!("a list of {N} numbers"))
    }

    fn numbers_expected<const N: usize>(&mut self, key: &'static str, expected: &str) -> Option<[f64; N]> {
        let numbers: [f64; N] = self.list(key, expected, as_number)?;
        let mut all_finite = true;
        for (index, number) in numbers.into_iter().enumerate() {
            all_finite &= self.finite(&self.path.key(key).index(index), number).is_some();
        }
        if !all_finite {
            self.problems.reported.insert(self.path.key(key));
        }
        all_finite.then_some(numbers)
    }

    fn counts<const N: usize>(&mut self, key: &'static str) -> Option<[u64; N]> {
        self.list(key, &format!("a list of {N} whole numbers, not negative"), as_count)
    }

    fn list<T: Copy + Default, const N: usize>(
        &mut self,
        key: &'static str,
        expected: &str,
        convert: impl Fn(&Value) -> Option<T>,
    ) -> Option<[T; N]> {
        let node = self.find(key)?;
        let path = self.path.key(key);
        let Value::Array(items) = &node.value else {
            self.wrong_type(&path, &node.value, expected);
            return None;
        };
        if items.len() != N {
            self.wrong_type(&path, &node.value, expected);
            return None;
        }
        let mut list = [T::default(); N];
        let mut complete = true;
        for (index, item) in items.iter().enumerate() {
            if let Some(value) = convert(&item.value) {
                list[index] = value;
            } else {
                self.wrong_type(&path.index(index), &item.value, &format!("`{key}` is {expected}"));
                complete = false;
            }
        }
        // The whole key is then known to be wrong, and not to be missing.
        if !complete {
            self.problems.reported.insert(path);
        }
        complete.then_some(list)
    }

    fn keyword<C: Keyword>(&mut self, key: &'static str) -> Option<C> {
        let text = self.text(key)?;
        let choice = C::from_name(&text);
        if choice.is_none() {
            let names: Vec<&str> = C::ALL.iter().map(|choice| choice.name()).collect();
            let path = self.path.key(key);
            let message = format!("`{path}` cannot be \"{}\"", short(&text));
            let help = format!("allowed: {}{}", names.join(", "), suggestion(closest(&text, &names)));
            self.problems.push(ProblemKind::Value, &path, message, help);
        }
        choice
    }

    fn table<T>(&mut self, key: &'static str, read: impl FnOnce(&mut Table<'_>) -> T) -> Option<T> {
        let path = self.path.key(key);
        let node = self.find(key)?;
        self.read_table(node, path, read)
    }

    fn read_table<T>(&mut self, node: &Node, path: Path, read: impl FnOnce(&mut Table<'_>) -> T) -> Option<T> {
        let Value::Table(entries) = &node.value else {
            self.wrong_type(&path, &node.value, "a table");
            return None;
        };
        let mut table = Table { entries, path, known: Vec::new(), problems: self.problems };
        let value = read(&mut table);
        table.refuse_unknown_keys();
        Some(value)
    }

    fn tables<T: Default>(&mut self, key: &'static str, read: impl Fn(&mut Table<'_>) -> T) -> Vec<T> {
        let path = self.path.key(key);
        let Some(node) = self.find(key) else {
            return Vec::new();
        };
        let Value::Array(items) = &node.value else {
            let help = format!("a list of tables, each headed by [[{key}]]");
            self.wrong_type(&path, &node.value, &help);
            return Vec::new();
        };
        let read_item = |(index, item)| {
            let path = path.index(index);
            // An item that is no table keeps its place, so that the others keep their numbers.
            self.read_table(item, path, &read).unwrap_or_default()
        };
        items.iter().enumerate().map(read_item).collect()
    }

    fn named_tables<T>(&mut self, key: &'static str, read: impl Fn(&mut Table<'_>) -> T) -> BTreeMap<String, T> {
        let path = self.path.key(key);
        let Some(node) = self.find(key) else {
            return BTreeMap::new();
        };
        let Value::Table(tables) = &node.value else {
            self.wrong_type(&path, &node.value, &format!("tables with names, each headed by [{key}.NAME]"));
            return BTreeMap::new();
        };
        let read_entry = |entry: &Entry| {
            let value = self.read_table(&entry.node, path.key(&entry.key), &read)?;
            Some((entry.key.clone(), value))
        };
        tables.iter().filter_map(read_entry).collect()
    }

    fn finite(&mut self, path: &Path, number: f64) -> Option<f64> {
        if number.is_finite() {
            return Some(number);
        }
        let message = format!("`{path}` is {number}");
        self.problems.push(ProblemKind::Value, path, message, "allowed: finite numbers");
        None
    }

    fn refuse_unknown_keys(&mut self) {
        for entry in self.entries {
            if !self.known.contains(&entry.key.as_str()) {
                let path = self.path.key(&entry.key);
                let place = if self.path == Path::root() { "a scene".into() } else { format!("`{}`", self.path) };
                let message = format!("{place} has no key `{}`", short(&entry.key));
                let meant = closest(&entry.key, &self.known);
                // The key that was meant is then not missing as well.
                self.problems.reported.extend(meant.map(|key| self.path.key(key)));
                let help = format!("allowed: {}{}", self.known.join(", "), suggestion(meant));
                let mut problem = Problem::at_span(ProblemKind::UnknownKey, Some(entry.key_span.clone()), message);
                problem.path = path.to_string();
                self.problems.list.push(problem.with_help(help));
            }
        }
    }
}

#[allow(clippy::cast_precision_loss, reason = "a number with more than 15 digits is rounded, as every double is")]
fn as_number(value: &Value) -> Option<f64> {
    match value {
        Value::Integer(number) => Some(*number as f64),
        Value::Float(number) => Some(*number),
        _ => None,
    }
}

fn as_count(value: &Value) -> Option<u64> {
    match value {
        Value::Integer(number) => u64::try_from(*number).ok(),
        _ => None,
    }
}

/// The known word that is closest to the written one, if any is close.
pub(super) fn closest<'w>(written: &str, known: &[&'w str]) -> Option<&'w str> {
    let written = written.to_lowercase();
    known
        .iter()
        .map(|word| (strsim::damerau_levenshtein(&written, word), *word))
        .filter(|(distance, word)| *distance <= 1 + word.chars().count() / 4)
        .min_by_key(|(distance, _)| *distance)
        .map(|(_, word)| word)
}

/// `; did you mean …?`
pub(super) fn suggestion(meant: Option<&str>) -> String {
    meant.map_or(String::new(), |word| format!("; did you mean `{word}`?"))
}

/// A text from the file, fit to stand in a message.
pub(super) fn short(text: &str) -> String {
    const LENGTH: usize = 40;
    let mut short: String = text.chars().take(LENGTH).flat_map(char::escape_debug).collect();
    if text.chars().nth(LENGTH).is_some() {
        short.push('…');
    }
    short
}
