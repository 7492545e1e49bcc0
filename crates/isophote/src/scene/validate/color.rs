//! Validates coefficients and strengths that may be three numbers.

use crate::message;
use crate::text::Message;
use std::collections::HashMap;

use super::Validator;
use crate::color::{ColorSpace, Component, Rgb};
use crate::import::NoFiles;
use crate::reflectance::Reflectance;
use crate::scene::document::Path;
use crate::scene::limits;
use crate::scene::problems::Problems;
use crate::scene::source::{Amount, SceneSource};
use crate::scene::source_files::NotedFiles;
use crate::scene::{Lighting, SceneColor};
use crate::units::Keyword;

/// Which single number is taken from three.
#[derive(Clone, Copy)]
pub(super) enum ComponentSelector {
    /// The luminance (3.10), for listings.
    Luminance(ColorSpace),
    /// One component.
    Component(Component),
}

impl ComponentSelector {
    pub(super) fn one(self, amount: Amount) -> f64 {
        match (amount, self) {
            (Amount::Number(number), _) => number,
            (Amount::Rgb(numbers), Self::Luminance(space)) => Rgb::from(numbers).weighted_by(space.luminance_weights()),
            (amount, Self::Component(component)) => amount.of(component),
        }
    }
}

impl Validator<'_> {
    /// The parts that depend on the component, for a scene in which any amount is written as three numbers; all other parts,
    /// and all mistakes, have been found by then.
    pub(super) fn color(&mut self, source: &SceneSource) -> Option<SceneColor> {
        let space = source.color_space.unwrap_or_default();
        if source.is_colored() {
            return self
                .problems
                .is_empty()
                .then(|| SceneColor { space, lighting: Rgb::from_fn(|component| self.lighting(source, component)) });
        }
        // A triple that could not be parsed is already a mistake.
        if source.color_space.is_some() && self.problems.is_empty() {
            let message = message!("`color_space` means nothing in a scene without colours");
            let help = message!(
                "leave it out, or write a coefficient, an intensity, an irradiance or a radiance as [R, G, B]"
            );
            self.wrong(&Path::root().key("color_space"), message, help);
        }
        None
    }

    fn lighting(&self, source: &SceneSource, component: Component) -> Lighting {
        let mut validator = Self {
            kept: super::files::GeometryCache::default(),
            length: self.length,
            convention: self.convention,
            shadows: self.shadows,
            collapse: ComponentSelector::Component(component),
            // Materials and lights name none.
            files: NotedFiles::new(&NoFiles),
            materials: HashMap::new(),
            suggested: 0,
            problems: Problems::default(),
            warnings: Problems::default(),
        };
        Lighting {
            materials: validator.materials(source).into_iter().flatten().collect(),
            lights: validator.lights(source).into_iter().flatten().collect(),
            ambient: validator.ambient(source),
        }
    }

    /// A coefficient: between 0 and 1 if it is an albedo in the scene's convention.
    pub(super) fn coefficient(&mut self, path: &Path, amount: Amount, is_albedo: bool) -> Option<f64> {
        let convention = self.convention.name();
        let most = if is_albedo { limits::ALBEDO } else { limits::COEFFICIENT };
        let help = || {
            if is_albedo {
                message!(
                    "allowed: 0 to {most}: in the convention \"{convention}\" it is the fraction of light that is reflected",
                    most,
                    convention
                )
            } else {
                // Not with all of its zeros.
                let most = format!("{most:?}").replace(".0", "");
                message!("allowed: 0 to {most} in the convention \"{convention}\"", most, convention)
            }
        };
        self.amount(path, amount, most, help)
    }

    /// An intensity, power, irradiance or radiance.
    pub(super) fn strength(&mut self, path: &Path, amount: Amount) -> Option<f64> {
        let help = || message!("allowed: 0 to {most}", most = format!("{:e}", limits::INTENSITY));
        self.amount(path, amount, limits::INTENSITY, help)
    }

    fn amount(&mut self, path: &Path, amount: Amount, most: f64, help: impl Fn() -> Message) -> Option<f64> {
        let mut is_allowed = |path: &Path, number: f64| {
            let is_allowed = (0.0..=most).contains(&number);
            if !is_allowed {
                self.wrong(path, message!("`{path}` is {value}", path, value = number), help());
            }
            is_allowed
        };
        let all_allowed = match amount {
            Amount::Number(number) => is_allowed(path, number),
            Amount::Rgb(numbers) => {
                let check = |(index, number)| is_allowed(&path.index(index), number);
                // Not `all`, which would stop at the first mistake.
                numbers.into_iter().enumerate().map(check).filter(|is_allowed| !is_allowed).count() == 0
            }
        };
        all_allowed.then(|| self.collapse.one(amount))
    }

    /// The fraction of the incident light that a material reflects at normal incidence; the largest of all components.
    pub(super) fn most_reflected(&self, [diffuse, specular]: [Amount; 2], shininess: f64) -> (f64, Option<Component>) {
        let albedo = |component| {
            let reflectance =
                Reflectance { diffuse: diffuse.of(component), specular: specular.of(component), shininess };
            self.convention.albedo(&reflectance)
        };
        if !diffuse.is_colored() && !specular.is_colored() {
            return (albedo(Component::Red), None);
        }
        let albedos = Component::ALL.iter().map(|component| (albedo(*component), Some(*component)));
        albedos.reduce(|most, next| if next.0 > most.0 { next } else { most }).unwrap_or((0.0, None))
    }
}
