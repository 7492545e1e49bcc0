//! Materials, lights and probes, each for itself.

use std::collections::HashMap;

use super::{Checked, Validator, limits};
use crate::light::{Emission, Light};
use crate::reflectance::{Convention, Reflectance};
use crate::scene::document::Path;
use crate::scene::read::{closest, short, suggestion};
use crate::scene::source::{EmissionName, LightSource, MaterialSource, ProbeSource, SceneSource};
use crate::scene::{Material, Probe};
use crate::vector::Vector;

impl Validator {
    pub(super) fn materials(&mut self, source: &SceneSource) -> Checked<Material> {
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

    /// The index of a material by its name; none where the convention needs none.
    pub(super) fn material_of(
        &mut self,
        path: &Path,
        name: Option<&str>,
        known: &[&str],
    ) -> Result<Option<usize>, Reported> {
        let Some(name) = name else {
            if self.convention.uses_material() {
                let help = format!("write the name of a material{}", listed(known));
                self.problems.missing(path, "material", help);
                return Err(Reported);
            }
            return Ok(None);
        };
        let index = known.iter().position(|material| *material == name);
        if index.is_none() {
            let message = format!("there is no material \"{}\"", short(name));
            let help = match known {
                [] => format!("the scene has no materials; write a table [material.{}]", short(name)),
                _ => format!("allowed: {}{}", known.join(", "), suggestion(closest(name, known))),
            };
            self.wrong(&path.key("material"), message, &help);
            return Err(Reported);
        }
        Ok(index)
    }

    pub(super) fn lights(&mut self, source: &SceneSource) -> Checked<Light> {
        if !self.few_enough("light", source.light.len(), limits::LIGHTS) {
            return Vec::new();
        }
        let mut names = Names::new("light");
        let check = |(index, light): (usize, &LightSource)| {
            let path = Path::root().key("light").index(index);
            let name = names.check(self, &path, light.name.as_deref());
            let position = self.required_point(&path, "position", light.position);
            let emission = self.emission(&path, light, position);
            let intensity = self.intensity(&path, light, emission);
            let casts_shadows = light.casts_shadows.unwrap_or(true);
            Some(Light { name: name?, position: position?, intensity: intensity?, emission: emission?, casts_shadows })
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

    pub(super) fn probes(&mut self, source: &SceneSource) -> Checked<Probe> {
        if !self.few_enough("probe", source.probe.len(), limits::PROBES) {
            return Vec::new();
        }
        let mut names = Names::new("probe");
        let check = |(index, probe): (usize, &ProbeSource)| {
            let path = Path::root().key("probe").index(index);
            let name = names.check(self, &path, probe.name.as_deref());
            let at = self.required_point(&path, "at", probe.at);
            Some(Probe { name: name?, at: at?, published: probe.published })
        };
        source.probe.iter().enumerate().map(check).collect()
    }
}

/// What is wrong has been noted already.
pub(super) struct Reported;

/// Names of one kind of thing, which must differ.
pub(super) struct Names {
    kind: &'static str,
    seen: HashMap<String, Path>,
}

impl Names {
    pub(super) fn new(kind: &'static str) -> Self {
        Self { kind, seen: HashMap::new() }
    }

    /// The name of the thing at a path, or the default one, which is that path.
    pub(super) fn check(&mut self, validator: &mut Validator, thing: &Path, name: Option<&str>) -> Option<String> {
        let name = name.map_or_else(|| thing.to_string(), str::to_owned);
        let path = thing.key("name");
        if name.is_empty() || name.chars().any(char::is_control) {
            validator.wrong(&path, format!("the name \"{}\" is not usable", short(&name)), "allowed: any line of text");
            return None;
        }
        if let Some(first) = self.seen.insert(name.clone(), thing.clone()) {
            let message = format!("there are two {}s named \"{}\"", self.kind, short(&name));
            validator.wrong(&path, message, &format!("the other is {first}; names must differ"));
            return None;
        }
        Some(name)
    }
}

fn listed(known: &[&str]) -> String {
    if known.is_empty() { ", and a table [material.NAME] for it".into() } else { format!(": {}", known.join(", ")) }
}
