//! Validates materials.

use super::names::{is_usable, usable};
use super::{Checked, Validator};
use crate::message;
use crate::reflectance::{Convention, Reflectance};
use crate::scene::Material;
use crate::scene::document::Path;
use crate::scene::limits;
use crate::scene::problems::{closest, short, suggestion};
use crate::scene::source::{Amount, MaterialSource, SceneSource};
use crate::text::Message;
use crate::text::significant;

impl Validator<'_> {
    pub(super) fn materials(&mut self, source: &SceneSource) -> Checked<Material> {
        source.material.iter().map(|(name, material)| self.material(name, material)).collect()
    }

    fn material(&mut self, name: &str, material: &MaterialSource) -> Option<Material> {
        let path = Path::root().key("material").key(name.to_owned());
        if !is_usable(name) {
            self.wrong(&path, message!("the name \"{name}\" is not usable", name = short(name)), usable());
            return None;
        }
        if material.diffuse.is_none() {
            self.problems.missing(&path, "diffuse", message!("write the diffuse coefficient k_d"));
        }
        let written = [material.diffuse, material.specular].map(|amount| amount.unwrap_or(Amount::Number(0.0)));
        let diffuse = self.coefficient(&path.key("diffuse"), written[0], self.convention.bounds_diffuse());
        let specular = self.coefficient(&path.key("specular"), written[1], self.convention.bounds_specular());
        if material.shininess.is_none() && !written[1].is_zero() {
            self.problems.missing(&path, "shininess", message!("write the shininess n > 0: `specular` is not 0"));
        }
        let shininess = material.shininess.unwrap_or(1.0);
        if !(shininess > 0.0 && shininess <= limits::SHININESS) {
            let message = message!("`{path}.shininess` is {shininess}", path, shininess);
            let help = message!("allowed: above 0, up to {most}", most = limits::SHININESS);
            self.wrong(&path.key("shininess"), message, help);
            return None;
        }
        let reflectance = Reflectance { diffuse: diffuse?, specular: specular?, shininess };
        self.warn_of_albedo(&path, written, shininess);
        Some(Material { name: name.into(), reflectance })
    }

    /// Warns of a material that reflects more light than it receives.
    fn warn_of_albedo(&mut self, path: &Path, written: [Amount; 2], shininess: f64) {
        let (albedo, component) = self.most_reflected(written, shininess);
        // 0.7 + 0.3 may be rounded upwards.
        if albedo <= 1.0 + 1e-12 {
            return;
        }
        let which = component
            .map_or_else(Message::empty, |component| message!(" in {component}", component = component.label()));
        let (formula, albedo) = (self.convention.albedo_formula(), significant(albedo, 6));
        let message = if self.convention == Convention::Lab {
            message!(
                "`{path}` can be brighter than it is lit: {formula} = {albedo}{which}",
                path,
                formula,
                albedo,
                which
            )
        } else {
            message!(
                "`{path}` reflects more than it receives: its albedo at normal incidence is {formula} = {albedo}{which}",
                path,
                formula,
                albedo,
                which
            )
        };
        let help = match self.convention {
            Convention::Course => {
                message!(
                    "a real surface has at most 1; in \"course\" k_d and k_s are per steradian, in \"course-pi\" fractions of the light"
                )
            }
            Convention::BlinnPhong => {
                message!(
                    "a real surface has at most 1; in \"blinn-phong\" k_d and k_s are per steradian, in \"blinn-phong-pi\" fractions of the light"
                )
            }
            _ => message!("a real surface has at most 1"),
        };
        self.warn(path, message, help);
    }

    /// The index of a material by its name; `None` if the convention needs no material.
    pub(super) fn material_of(
        &mut self,
        path: &Path,
        name: Option<&str>,
        known: &[&str],
    ) -> Result<Option<usize>, Reported> {
        let Some(name) = name else {
            if self.convention.uses_material() {
                let help = if known.is_empty() {
                    message!("write the name of a material, and a table [material.NAME] for it")
                } else {
                    message!("write the name of a material: {names}", names = some(known))
                };
                self.problems.missing(path, "material", help);
                return Err(Reported);
            }
            return Ok(None);
        };
        let index = self.materials.get(name).copied();
        if index.is_none() {
            let message = message!("there is no material \"{name}\"", name = short(name));
            // Each name would be compared with every other one.
            self.suggested += 1;
            let meant = if self.suggested * known.len() <= COMPARED { closest(name, known) } else { None };
            let help = match known {
                [] => message!("the scene has no materials; write a table [material.{name}]", name = short(name)),
                _ => message!("allowed: {names}{meant}", names = some(known), meant = suggestion(meant)),
            };
            self.wrong(&path.key("material"), message, help);
            return Err(Reported);
        }
        Ok(index)
    }
}

/// A mistake that has already been reported.
pub(super) struct Reported;

/// The most comparisons of a misspelt name with the names of the materials.
const COMPARED: usize = 1_000_000;

/// The first of the names.
fn some(known: &[&str]) -> String {
    const SHOWN: usize = 20;
    let more = if known.len() > SHOWN { ", …" } else { "" };
    format!("{}{more}", known[..known.len().min(SHOWN)].join(", "))
}
