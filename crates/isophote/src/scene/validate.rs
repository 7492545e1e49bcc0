//! From what is written to what is valid: every check of a scene, once.

use std::collections::HashMap;

use super::document::Path;
use super::error::{Problem, ProblemKind};
use super::read::{Problems, closest, short, suggestion};
use super::source::{
    CameraSource, EmissionName, LightSource, MaterialSource, ProbeSource, SceneSource, ScreenSource, SphereSource,
};
use super::{Material, Probe, Scene, Shape};
use crate::camera::{Camera, Handedness, Screen};
use crate::light::{Emission, Light};
use crate::map::Resolution;
use crate::reflectance::{Convention, Reflectance};
use crate::shape::{Geometry, Sphere, surface_at};
use crate::units::{LengthUnit, Quantities};
use crate::vector::Vector;

/// What a scene may hold. The bounds on numbers keep every formula far from overflow.
pub mod limits {
    /// Size of a scene file in bytes.
    pub const FILE_BYTES: u64 = 64 << 20;
    /// Pixels in a row, and rows.
    pub const SIDE: u32 = 65_536;
    /// Pixels of an image: a channel of this many doubles takes 1 GiB.
    pub const PIXELS: u64 = 1 << 27;
    /// Lights in a scene.
    pub const LIGHTS: usize = 100_000;
    /// Shapes in a scene.
    pub const SHAPES: usize = 100_000;
    /// Probes in a scene.
    pub const PROBES: usize = 100_000;
    /// The largest coordinate, in metres: a hundred times the distance of the nearest star would not fit.
    pub const COORDINATE: f64 = 1e15;
    /// The smallest radius and screen, in metres.
    pub const SMALLEST: f64 = 1e-12;
    /// The largest intensity and power.
    pub const INTENSITY: f64 = 1e30;
    /// The largest shininess.
    pub const SHININESS: f64 = 1e5;
}

/// Checks a scene, given what is already known to be wrong with it.
pub(super) fn validate(source: SceneSource, problems: Problems) -> Result<Scene, Vec<Problem>> {
    let mut validator = Validator {
        length: source.length.unwrap_or(LengthUnit::Metre),
        convention: source.convention.unwrap_or(Convention::Radiance),
        problems,
        warnings: Problems::default(),
    };
    validator.head(&source);
    let camera = validator.camera(&source);
    let materials = validator.materials(&source);
    let shapes = validator.shapes(&source);
    let lights = validator.lights(&source);
    let probes = validator.probes(&source);
    validator.eye_against_shapes(camera.as_ref(), &shapes);
    validator.lights_against_shapes(camera.as_ref(), &lights, &shapes);
    validator.probes_against_shapes(&probes, &shapes);
    validator.words_of_advice(&source, camera.as_ref());
    let Validator { length, convention, problems, warnings } = validator;
    match camera {
        Some(camera) if problems.is_empty() => Ok(Scene {
            title: source.title.clone().unwrap_or_default(),
            length,
            convention,
            quantities: source.quantities.unwrap_or(Quantities::Radiometric),
            camera,
            materials: materials.into_iter().flatten().collect(),
            shapes: shapes.into_iter().flatten().collect(),
            lights: lights.into_iter().flatten().collect(),
            probes: probes.into_iter().flatten().collect(),
            warnings: warnings.into_list(),
            source,
        }),
        _ => Err(problems.into_list()),
    }
}

/// Lists keep the places of items that are wrong, as `None`, so that indices stay those of the file.
type Checked<T> = Vec<Option<T>>;

struct Validator {
    length: LengthUnit,
    convention: Convention,
    problems: Problems,
    warnings: Problems,
}

impl Validator {
    fn head(&mut self, source: &SceneSource) {
        let root = Path::root();
        match source.version {
            None => self.problems.missing(&root, "version", "write `version = 1` on top"),
            Some(1) => {}
            Some(version) => self.wrong(&root.key("version"), format!("`version` is {version}"), "allowed: 1"),
        }
        if source.length.is_none() {
            let help = "write `length = \"m\"`, \"cm\" or \"mm\": the unit of every length in the scene";
            self.problems.missing(&root, "length", help);
        }
    }

    fn camera(&mut self, source: &SceneSource) -> Option<Camera> {
        let path = Path::root().key("camera");
        let Some(camera) = &source.camera else {
            self.problems.missing(&Path::root(), "camera", "write a table [camera] with `eye`, `forward` and `screen`");
            return None;
        };
        let eye = self.required_point(&path, "eye", camera.eye);
        let forward = self.direction_or_target(&path, eye, ("forward", camera.forward), camera.target);
        let up = self.direction(&path.key("up"), camera.up.unwrap_or([0.0, 1.0, 0.0]));
        if let (Some(forward), Some(up)) = (forward, up) {
            self.not_parallel(&path, camera, forward, up);
        }
        let screen = self.screen(&path, camera.screen.as_ref());
        let resolution = self.resolution(&path.key("resolution"), camera.resolution.unwrap_or([800, 600]));
        Some(Camera {
            eye: eye?,
            forward: forward?,
            up: up?,
            handedness: source.handedness.unwrap_or(Handedness::Right),
            screen: screen?,
            resolution: resolution?,
        })
    }

    fn not_parallel(&mut self, path: &Path, camera: &CameraSource, forward: Vector, up: Vector) {
        if forward.normalized().cross(up.normalized()).length() < 1e-6 {
            let key = ["up", "target", "forward"];
            let written = [camera.up.is_some(), camera.target.is_some(), true];
            let key = key.into_iter().zip(written).find_map(|(key, written)| written.then_some(key)).unwrap_or("up");
            let message =
                format!("`camera.up` is parallel to the direction of view {}", vector_text(forward.to_array()));
            self.wrong(
                &path.key(key),
                message,
                "allowed: any other direction; it shows where the top of the picture is",
            );
        }
    }

    fn screen(&mut self, path: &Path, screen: Option<&ScreenSource>) -> Option<Screen> {
        let Some(screen) = screen else {
            let help = "write `screen = { distance = 5, x = [-4, 4], y = [-3, 3] }`";
            self.problems.missing(path, "screen", help);
            return None;
        };
        let path = path.key("screen");
        let distance = self.required_size(&path, "distance", screen.distance);
        let x = self.edges(&path, "x", screen.x, "left and right");
        let y = self.edges(&path, "y", screen.y, "lower and upper");
        Some(Screen { distance: distance?, x: x?, y: y? })
    }

    fn edges(&mut self, path: &Path, key: &str, edges: Option<[f64; 2]>, which: &str) -> Option<[f64; 2]> {
        let Some(edges) = edges else {
            self.problems.missing(path, key, format!("write `{key} = [a, b]`: the {which} edge of the window"));
            return None;
        };
        let path = path.key(key);
        let metres = edges.map(|edge| self.length.to_metres(edge));
        if metres.iter().any(|edge| edge.abs() > limits::COORDINATE) {
            self.too_far(&path);
            return None;
        }
        if metres[1] - metres[0] < limits::SMALLEST {
            let [first, second] = edges;
            let message = format!("`{path}` runs from {first} to {second}");
            let help = format!("allowed: the {which} edge, the smaller one first; `handedness` mirrors the picture");
            self.wrong(&path, message, &help);
            return None;
        }
        Some(metres)
    }

    fn resolution(&mut self, path: &Path, [width, height]: [u64; 2]) -> Option<Resolution> {
        let allowed =
            format!("allowed: width and height from 1 to {}, together at most {} pixels", limits::SIDE, limits::PIXELS);
        let side = |side: u64| u32::try_from(side).ok().filter(|side| (1..=limits::SIDE).contains(side));
        match (side(width), side(height)) {
            (Some(width), Some(height)) if u64::from(width) * u64::from(height) <= limits::PIXELS => {
                Some(Resolution { width, height })
            }
            _ => {
                self.wrong(path, format!("the resolution is {width} × {height} pixels"), &allowed);
                None
            }
        }
    }

    fn materials(&mut self, source: &SceneSource) -> Checked<Material> {
        source.material.iter().map(|(name, material)| self.material(name, material)).collect()
    }

    fn material(&mut self, name: &str, material: &MaterialSource) -> Option<Material> {
        let path = Path::root().key("material").key(name);
        if material.diffuse.is_none() {
            self.problems.missing(&path, "diffuse", "write the diffuse coefficient k_d, 0 to 1");
        }
        let diffuse = self.fraction(&path.key("diffuse"), material.diffuse.unwrap_or(0.0));
        let specular = self.fraction(&path.key("specular"), material.specular.unwrap_or(0.0));
        if material.shininess.is_none() && material.specular.is_some_and(|specular| specular != 0.0) {
            self.problems.missing(&path, "shininess", "write the shininess n > 0: `specular` is not 0");
        }
        let shininess = material.shininess.unwrap_or(1.0);
        if !(shininess > 0.0 && shininess <= limits::SHININESS) {
            let message = format!("`{path}.shininess` is {shininess}");
            let help = format!("allowed: above 0, up to {}", limits::SHININESS);
            self.wrong(&path.key("shininess"), message, &help);
            return None;
        }
        let reflectance = Reflectance { diffuse: diffuse?, specular: specular?, shininess };
        let reflected = reflectance.diffuse + reflectance.specular;
        if reflected > 1.0 && matches!(self.convention, Convention::CoursePi | Convention::Radiance) {
            let message = format!("`{path}` reflects more than it receives: k_d + k_s = {reflected}");
            self.warn(&path, message, "a real surface has k_d + k_s ≤ 1 in this convention");
        }
        Some(Material { name: name.into(), reflectance })
    }

    fn shapes(&mut self, source: &SceneSource) -> Checked<Shape> {
        if !self.few_enough("sphere", source.sphere.len(), limits::SHAPES) {
            return Vec::new();
        }
        let mut names = Names::new("sphere");
        let known: Vec<&str> = source.material.keys().map(String::as_str).collect();
        let check = |(index, sphere): (usize, &SphereSource)| {
            let path = Path::root().key("sphere").index(index);
            let name = names.check(self, &path, index, sphere.name.as_deref());
            let center = self.required_point(&path, "center", sphere.center);
            let radius = self.required_size(&path, "radius", sphere.radius);
            let material = self.material_of(&path, sphere.material.as_deref(), &known);
            let geometry = Geometry::Sphere(Sphere { center: center?, radius: radius? });
            Some(Shape { name: name?, material: material?, geometry })
        };
        source.sphere.iter().enumerate().map(check).collect()
    }

    /// The index of a material by its name; `Some(None)` where none is needed.
    fn material_of(&mut self, path: &Path, name: Option<&str>, known: &[&str]) -> Option<Option<usize>> {
        let Some(name) = name else {
            if self.convention.uses_material() {
                let help = format!("write the name of a material{}", listed(known));
                self.problems.missing(path, "material", help);
                return None;
            }
            return Some(None);
        };
        let index = known.iter().position(|material| *material == name);
        if index.is_none() {
            let message = format!("there is no material \"{}\"", short(name));
            let help = match known {
                [] => format!("the scene has no materials; write a table [material.{}]", short(name)),
                _ => format!("allowed: {}{}", known.join(", "), suggestion(closest(name, known))),
            };
            self.wrong(&path.key("material"), message, &help);
            return None;
        }
        Some(index)
    }

    fn lights(&mut self, source: &SceneSource) -> Checked<Light> {
        if !self.few_enough("light", source.light.len(), limits::LIGHTS) {
            return Vec::new();
        }
        let mut names = Names::new("light");
        let check = |(index, light): (usize, &LightSource)| {
            let path = Path::root().key("light").index(index);
            let name = names.check(self, &path, index, light.name.as_deref());
            let position = self.required_point(&path, "position", light.position);
            let emission = self.emission(&path, light, position);
            let intensity = self.intensity(&path, light, emission);
            Some(Light { name: name?, position: position?, intensity: intensity?, emission: emission? })
        };
        source.light.iter().enumerate().map(check).collect()
    }

    fn emission(&mut self, path: &Path, light: &LightSource, position: Option<Vector>) -> Option<Emission> {
        if light.emission == Some(EmissionName::Lambertian) {
            let axis = self.direction_or_target(path, position, ("axis", light.axis), light.target)?;
            return Some(Emission::Lambertian { axis: axis.normalized() });
        }
        for (key, written) in [("axis", light.axis.is_some()), ("target", light.target.is_some())] {
            if written {
                let message = format!("`{path}.{key}` means nothing for an isotropic light");
                self.wrong(&path.key(key), message, "leave it out, or write `emission = \"lambertian\"`");
            }
        }
        Some(Emission::Isotropic)
    }

    fn intensity(&mut self, path: &Path, light: &LightSource, emission: Option<Emission>) -> Option<f64> {
        let (key, value) = match (light.intensity, light.power) {
            (Some(intensity), None) => ("intensity", intensity),
            (None, Some(power)) => ("power", power),
            (Some(_), Some(_)) => {
                let message = format!("`{path}` has both `intensity` and `power`");
                self.wrong(&path.key("power"), message, "allowed: one of the two");
                return None;
            }
            (None, None) => {
                let help = "write `intensity` (W/sr or cd), or `power` (W or lm) instead";
                self.problems.missing(path, "intensity", help);
                return None;
            }
        };
        if !(0.0..=limits::INTENSITY).contains(&value) {
            let help = format!("allowed: 0 to {:e}", limits::INTENSITY);
            self.wrong(&path.key(key), format!("`{path}.{key}` is {value}"), &help);
            return None;
        }
        if key == "power" { Some(value / emission?.solid_angle()) } else { Some(value) }
    }

    fn probes(&mut self, source: &SceneSource) -> Checked<Probe> {
        if !self.few_enough("probe", source.probe.len(), limits::PROBES) {
            return Vec::new();
        }
        let mut names = Names::new("probe");
        let check = |(index, probe): (usize, &ProbeSource)| {
            let path = Path::root().key("probe").index(index);
            let name = names.check(self, &path, index, probe.name.as_deref());
            let at = self.required_point(&path, "at", probe.at);
            Some(Probe { name: name?, at: at?, published: probe.published })
        };
        source.probe.iter().enumerate().map(check).collect()
    }

    fn eye_against_shapes(&mut self, camera: Option<&Camera>, shapes: &Checked<Shape>) {
        let Some(camera) = camera else { return };
        for shape in shapes.iter().flatten() {
            let distance = shape.geometry.signed_distance(camera.eye);
            if distance.abs() <= shape.geometry.surface_tolerance() {
                let message = format!("the eye is on the surface of \"{}\"", shape.name);
                let path = Path::root().key("camera").key("eye");
                self.wrong(&path, message, "allowed: outside or inside a shape, not on its surface");
            }
        }
    }

    fn lights_against_shapes(&mut self, camera: Option<&Camera>, lights: &Checked<Light>, shapes: &Checked<Shape>) {
        for shape in shapes.iter().flatten() {
            let eye_inside = camera.is_some_and(|camera| shape.geometry.signed_distance(camera.eye) < 0.0);
            for (index, light) in lights.iter().enumerate() {
                let Some(light) = light else { continue };
                let distance = shape.geometry.signed_distance(light.position);
                let path = Path::root().key("light").index(index).key("position");
                if distance.abs() <= shape.geometry.surface_tolerance() {
                    let message = format!("the light \"{}\" is on the surface of \"{}\"", light.name, shape.name);
                    self.wrong(&path, message, "move it away: the irradiance next to a point light has no bound");
                } else if distance < 0.0 && !eye_inside && camera.is_some() {
                    let message = format!("the light \"{}\" is inside \"{}\"", light.name, shape.name);
                    let depth = self.length_text(-distance);
                    let help =
                        format!("its surface is {depth} away and lets no light out; move the light out, or the eye in");
                    self.wrong(&path, message, &help);
                } else if distance > 0.0 && eye_inside {
                    let message = format!(
                        "the eye is inside \"{}\" and the light \"{}\" outside: it lights nothing there",
                        shape.name, light.name
                    );
                    self.warn(&path, message, "move the light in, or the eye out");
                }
            }
        }
    }

    fn probes_against_shapes(&mut self, probes: &Checked<Probe>, shapes: &Checked<Shape>) {
        // With a shape missing, its probes would be called wrong for nothing.
        if shapes.iter().any(Option::is_none) || self.problems.has(&Path::root().key("sphere")) {
            return;
        }
        for (index, probe) in probes.iter().enumerate() {
            let Some(probe) = probe else { continue };
            let path = Path::root().key("probe").index(index).key("at");
            if let Err(miss) = surface_at(shapes.iter().flatten().map(|shape| &shape.geometry), probe.at) {
                let message = format!("the probe \"{}\" is on no surface", probe.name);
                let help = miss.map_or("the scene has no shapes".into(), |miss| {
                    let name = shapes.iter().flatten().nth(miss.shape).map_or("", |shape| &shape.name);
                    miss.describe(name, self.length)
                });
                self.wrong(&path, message, &help);
            }
        }
    }

    fn words_of_advice(&mut self, source: &SceneSource, camera: Option<&Camera>) {
        let root = Path::root();
        if source.sphere.is_empty() {
            self.warn(&root.key("sphere"), "the scene has no shapes".into(), "write a table [[sphere]]");
        }
        if source.light.is_empty() {
            self.warn(&root.key("light"), "the scene has no lights: all is black".into(), "write a table [[light]]");
        }
        for name in source.material.keys() {
            if !source.sphere.iter().any(|sphere| sphere.material.as_ref() == Some(name)) {
                let message = format!("no shape is made of the material \"{}\"", short(name));
                self.warn(&root.key("material").key(name), message, "leave it out, or use it");
            }
        }
        if let Some(Camera { screen, resolution, .. }) = camera {
            let width = (screen.x[1] - screen.x[0]) / f64::from(resolution.width);
            let height = (screen.y[1] - screen.y[0]) / f64::from(resolution.height);
            if (width / height - 1.0).abs() > 1e-9 {
                let (width, height) = (self.length_text(width), self.length_text(height));
                let message = format!("pixels are not square: {width} wide, {height} high");
                let help = "pictures look stretched; give `resolution` the proportions of `screen`";
                self.warn(&root.key("camera").key("resolution"), message, help);
            }
        }
    }

    fn required_point(&mut self, path: &Path, key: &str, point: Option<[f64; 3]>) -> Option<Vector> {
        let Some(point) = point else {
            self.problems.missing(path, key, format!("write `{key} = [x, y, z]`"));
            return None;
        };
        self.point(&path.key(key), point)
    }

    fn point(&mut self, path: &Path, point: [f64; 3]) -> Option<Vector> {
        let metres = point.map(|coordinate| self.length.to_metres(coordinate));
        if metres.iter().any(|coordinate| coordinate.abs() > limits::COORDINATE) {
            self.too_far(path);
            return None;
        }
        Some(Vector::from(metres))
    }

    fn too_far(&mut self, path: &Path) {
        let bound = self.length.from_metres(limits::COORDINATE);
        let help = format!("allowed: coordinates from {:e} to {bound:e} {}", -bound, self.unit());
        self.wrong(path, format!("`{path}` is too far away"), &help);
    }

    fn required_size(&mut self, path: &Path, key: &str, size: Option<f64>) -> Option<f64> {
        let Some(size) = size else {
            self.problems.missing(path, key, format!("write `{key} = …`, a length above 0"));
            return None;
        };
        let path = path.key(key);
        let metres = self.length.to_metres(size);
        if (limits::SMALLEST..=limits::COORDINATE).contains(&metres) {
            return Some(metres);
        }
        let [smallest, largest] = [limits::SMALLEST, limits::COORDINATE].map(|bound| self.length.from_metres(bound));
        let help = format!("allowed: above 0 ({smallest:e} to {largest:e} {})", self.unit());
        self.wrong(&path, format!("`{path}` is {size}"), &help);
        None
    }

    fn direction(&mut self, path: &Path, direction: [f64; 3]) -> Option<Vector> {
        let largest = direction.iter().fold(0.0_f64, |largest, component| largest.max(component.abs()));
        if !(1e-100..=1e100).contains(&largest) {
            let what = if largest < 1.0 { "has no length" } else { "is too long" };
            let message = format!("`{path}` {what}: {}", vector_text(direction));
            self.wrong(path, message, "allowed: any direction, of any length from 1e-100 to 1e100");
            return None;
        }
        // By a power of two, which changes no digit: the squares then neither vanish nor overflow.
        let scale = libm::exp2(-libm::floor(libm::log2(largest)));
        Some(Vector::from(direction.map(|component| component * scale)))
    }

    /// A direction that is given itself or by the point it leads to.
    fn direction_or_target(
        &mut self,
        path: &Path,
        from: Option<Vector>,
        (key, direction): (&str, Option<[f64; 3]>),
        target: Option<[f64; 3]>,
    ) -> Option<Vector> {
        match (direction, target) {
            (Some(direction), None) => self.direction(&path.key(key), direction),
            (None, Some(target)) => {
                let to_target = self.point(&path.key("target"), target)? - from?;
                if to_target.length() < limits::SMALLEST {
                    let message = format!("`{path}.target` is where `{path}` itself is");
                    self.wrong(&path.key("target"), message, "allowed: any other point");
                    return None;
                }
                Some(to_target)
            }
            (Some(_), Some(_)) => {
                let message = format!("`{path}` has both `{key}` and `target`");
                self.wrong(&path.key("target"), message, "allowed: one of the two");
                None
            }
            (None, None) => {
                let help = format!("write `{key} = [x, y, z]`, a direction, or `target = [x, y, z]`, a point");
                self.problems.missing(path, key, help);
                None
            }
        }
    }

    fn fraction(&mut self, path: &Path, value: f64) -> Option<f64> {
        if (0.0..=1.0).contains(&value) {
            return Some(value);
        }
        self.wrong(path, format!("`{path}` is {value}"), "allowed: 0 to 1");
        None
    }

    fn few_enough(&mut self, key: &str, count: usize, limit: usize) -> bool {
        if count > limit {
            let path = Path::root().key(key).index(limit);
            self.wrong(&path, format!("the scene has {count} tables [[{key}]]"), &format!("allowed: at most {limit}"));
        }
        count <= limit
    }

    fn wrong(&mut self, path: &Path, message: String, help: &str) {
        self.problems.push(ProblemKind::Value, path, message, help);
    }

    fn warn(&mut self, path: &Path, message: String, help: &str) {
        self.warnings.push(ProblemKind::Warning, path, message, help);
    }

    fn unit(&self) -> &'static str {
        crate::units::Choice::name(self.length)
    }

    fn length_text(&self, metres: f64) -> String {
        format!("{} {}", rounded(self.length.from_metres(metres)), self.unit())
    }
}

/// Names of one kind of thing, which must differ.
struct Names {
    kind: &'static str,
    seen: HashMap<String, usize>,
}

impl Names {
    fn new(kind: &'static str) -> Self {
        Self { kind, seen: HashMap::new() }
    }

    /// The name of a thing, or the default one.
    fn check(&mut self, validator: &mut Validator, path: &Path, index: usize, name: Option<&str>) -> Option<String> {
        let name = name.map_or_else(|| format!("{}[{index}]", self.kind), str::to_owned);
        let path = path.key("name");
        if name.is_empty() || name.chars().any(char::is_control) {
            validator.wrong(&path, format!("the name \"{}\" is not usable", short(&name)), "allowed: any line of text");
            return None;
        }
        if let Some(first) = self.seen.insert(name.clone(), index) {
            let message = format!("there are two {}s named \"{}\"", self.kind, short(&name));
            validator.wrong(&path, message, &format!("the other is {}[{first}]; names must differ", self.kind));
            return None;
        }
        Some(name)
    }
}

fn listed(known: &[&str]) -> String {
    if known.is_empty() { String::new() } else { format!(": {}", known.join(", ")) }
}

/// A few digits, for messages.
fn rounded(value: f64) -> String {
    let text = format!("{value:.5e}").parse::<f64>().unwrap_or(value);
    format!("{text}")
}

fn vector_text(vector: [f64; 3]) -> String {
    let [x, y, z] = vector;
    format!("[{x}, {y}, {z}]")
}
