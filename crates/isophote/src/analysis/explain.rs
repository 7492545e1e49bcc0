//! Explains every step from the scene to a value, with its numbers and formula numbers.

use std::fmt::Write as _;

use super::probe::{ProbeReading, SeenFromEye};
use crate::camera::Projection;
use crate::color::{Component, Rgb};
use crate::light::{Ambient, Emission, Light, LightKind, ParallelLight, PointLight};
use crate::message;
use crate::prepare::{Components, PreparedScene};
use crate::reflectance::{Convention, Reflectance, lobe_constant};
use crate::shade::LightTerm;
use crate::text::{Language, Message, significant};
use crate::units::{Keyword, LengthUnit};
use crate::vector::Vector;

impl ProbeReading {
    /// The calculation as one would do it with a pocket calculator: every vector, cosine and product of this reading, with
    /// 12 significant digits. `name` is that of the point; formulas, symbols and units are the same in every language.
    #[must_use]
    pub fn explain(&self, scene: &PreparedScene, name: &str, language: Language) -> String {
        let mut text = Page { text: String::new(), language };
        self.explain_geometry(&mut text, scene, name);
        match (scene.components(), self.components.as_deref()) {
            (Some(components), Some(readings)) => explain_components(&mut text, components, readings),
            _ => self.explain_numbers(&mut text, scene),
        }
        text.text
    }

    /// Every light, and their sum.
    fn explain_numbers(&self, text: &mut Page, scene: &PreparedScene) {
        for (index, term) in self.terms.iter().enumerate() {
            self.explain_light(text, scene, index, term);
        }
        if let Some(ambient) = scene.scene().ambient() {
            self.explain_ambient(text, scene, ambient);
        }
        self.explain_sum(text, scene);
    }

    fn explain_geometry(&self, text: &mut Page, scene: &PreparedScene, name: &str) {
        let description = scene.scene();
        let length = description.length();
        let shape = &description.shapes()[self.hit.primitive.shape];
        let point = &self.hit.point;
        let title = description.title();
        line(text, format_args!("{name}{}{title}", if title.is_empty() { "" } else { ": " }));
        let convention = description.convention();
        say(
            text,
            &message!("Convention {label}: {formula}", label = convention.label(), formula = convention.formula()),
        );
        line(text, format_args!(""));
        say(text, &message!("Geometry (2.2), lengths in {unit}", unit = length.name()));
        let on = description.name_of(self.hit.primitive);
        let place = vector_in(point.position(), length);
        say(text, &message!("  P   = {place}   on \"{on}\"", place, on));
        if shape.geometry.is_round() {
            let center = vector_in(point.anchor, length);
            say(text, &message!("  C   = {center}   centre of \"{on}\"", center, on));
        }
        let normal = match (shape.geometry.is_round(), self.hit.from_inside) {
            (true, true) => message!("(C − P)/‖C − P‖, the eye is inside"),
            (true, false) => Message::verbatim("(P − C)/‖P − C‖"),
            (false, true) => message!("inward, the eye is inside"),
            (false, false) => message!("on the eye's side"),
        };
        say(text, &message!("  N   = {vector}   {normal}", vector = vector(point.normal), normal));
        say(text, &message!("  O   = {eye}   eye", eye = vector_in(scene.frame().eye, length)));
        let is_parallel = matches!(description.camera().projection, Projection::Orthographic(_));
        let view = if is_parallel {
            message!("against the direction of view, along parallel rays")
        } else {
            Message::verbatim("(O − P)/‖O − P‖")
        };
        say(text, &message!("  V   = {vector}   {view}", vector = vector(point.view), view));
        line(text, format_args!("  cosθ_o = N·V = {}", digits(point.cos_theta_o)));
        match self.seen {
            SeenFromEye::Seen => {}
            SeenFromEye::FacesAway => {
                say(
                    text,
                    &message!("  θ_o ≥ 90°: the eye does not see this side, and B = 0 where B depends on the viewer"),
                );
            }
            SeenFromEye::Behind => {
                say(text, &message!("  The eye does not see the point: it is behind the plane of the eye."));
            }
            SeenFromEye::HiddenBy(other) => {
                let other = description.name_of(other);
                say(text, &message!("  The eye does not see the point: \"{other}\" stands before it.", other));
            }
        }
    }

    fn explain_light(&self, text: &mut Page, scene: &PreparedScene, index: usize, term: &LightTerm) {
        let Light { name, kind, is_on, .. } = &scene.scene().lights()[index];
        line(text, format_args!(""));
        let number = index + 1;
        if *is_on {
            say(text, &message!("Light {number} \"{name}\"", number, name));
        } else {
            say(text, &message!("Light {number} \"{name}\", switched off", number, name));
        }
        match kind {
            LightKind::Point(light) => self.explain_point_light(text, scene, light, index),
            LightKind::Parallel(light) => self.explain_parallel_light(text, scene, light, index),
        }
        self.explain_reflection(text, scene, index, term);
    }

    fn explain_point_light(&self, text: &mut Page, scene: &PreparedScene, light: &PointLight, index: usize) {
        let term = &self.terms[index];
        let description = scene.scene();
        let length = description.length();
        let unit = description.unit_system().irradiance_unit();
        line(text, format_args!("  S   = {} {}", vector_in(light.position, length), length.name()));
        let metres = digits(term.distance);
        if length == LengthUnit::Metre {
            line(text, format_args!("  r   = ‖S − P‖ = {metres} m"));
        } else {
            let distance = digits(length.from_metres(term.distance));
            line(text, format_args!("  r   = ‖S − P‖ = {distance} {} = {metres} m", length.name()));
        }
        line(text, format_args!("  L   = (S − P)/r = {}", vector(term.direction)));
        self.explain_cosine(text, term);
        explain_emission(text, light, term, description.unit_system().intensity_unit());
        self.explain_visibility(text, scene, index);
        line(
            text,
            format_args!(
                "  E   = v I cosθ_i / r² = {} × {} × {} / {}² = {} {unit}   (3.1)",
                term.visibility,
                digits(term.intensity),
                digits(term.cos_theta_i),
                digits(term.distance),
                digits(term.irradiance)
            ),
        );
    }

    fn explain_parallel_light(&self, text: &mut Page, scene: &PreparedScene, light: &ParallelLight, index: usize) {
        let term = &self.terms[index];
        let unit = scene.scene().unit_system().irradiance_unit();
        say(text, &message!("  D   = {vector}   the way that its light travels", vector = vector(light.direction)));
        line(text, format_args!("  L   = −D = {}", vector(term.direction)));
        self.explain_cosine(text, term);
        let across = digits(light.irradiance);
        say(text, &message!("  E₀  = {across} {unit}, on a plane at right angles to D", across, unit));
        self.explain_visibility(text, scene, index);
        let (visibility, cosine, irradiance) = (term.visibility, digits(term.cos_theta_i), digits(term.irradiance));
        line(
            text,
            format_args!("  E   = v E₀ cosθ_i = {visibility} × {across} × {cosine} = {irradiance} {unit}   (3.8)"),
        );
    }

    fn explain_cosine(&self, text: &mut Page, term: &LightTerm) {
        let cosine = self.hit.point.normal.dot(term.direction);
        line(text, format_args!("  cosθ_i = max(0, N·L) = max(0, {}) = {}", digits(cosine), digits(term.cos_theta_i)));
    }

    fn explain_visibility(&self, text: &mut Page, scene: &PreparedScene, index: usize) {
        if let Some(blocker) = self.blockers[index] {
            let name = scene.scene().name_of(blocker);
            let visibility = self.terms[index].visibility;
            if blocker == self.hit.primitive {
                say(text, &message!("  v   = {visibility}: the wall of \"{name}\" stands between", visibility, name));
            } else {
                say(text, &message!("  v   = {visibility}: \"{name}\" stands between", visibility, name));
            }
        }
    }

    fn explain_ambient(&self, text: &mut Page, scene: &PreparedScene, ambient: &Ambient) {
        let unit = scene.scene().unit_system().irradiance_unit();
        let (radiance, irradiance) = (digits(ambient.radiance), digits(self.shading.ambient));
        line(text, format_args!(""));
        say(text, &message!("Ambient light"));
        if ambient.obstruction.is_none() {
            line(text, format_args!("  E   = π L_a = π × {radiance} = {irradiance} {unit}   (3.9)"));
        } else {
            let whole = ambient.unobstructed_irradiance();
            let share = digits(if whole > 0.0 { self.shading.ambient / whole } else { 0.0 });
            let error = digits(scene.ambient_irradiance(&self.hit).standard_error);
            say(text, &message!("  p   = {share} of the hemisphere, by cosθ, is free", share));
            say(
                text,
                &message!(
                    "  E   = π L_a p = π × {radiance} × {share} = {irradiance} {unit}, standard error {error}   (3.9)",
                    radiance,
                    share,
                    irradiance,
                    unit,
                    error
                ),
            );
        }
        self.explain_diffuse(text, scene, self.shading.ambient);
    }

    fn explain_reflection(&self, text: &mut Page, scene: &PreparedScene, index: usize, term: &LightTerm) {
        self.explain_diffuse(text, scene, term.irradiance);
        let convention = scene.scene().convention();
        let Some(material) = scene.scene().material_of(self.hit.primitive) else { return };
        let Reflectance { specular: k_s, shininess: n, .. } = scene.scene().materials()[material].reflectance;
        if !convention.has_specular_part() || k_s == 0.0 || self.hit.point.cos_theta_o <= 0.0 {
            return;
        }
        let formula = scene.formula(self.hit.primitive);
        let irradiance = digits(term.irradiance);
        let end = format!("{}   ({})", convention.unit(scene.scene().unit_system()), convention.formula_number());
        let half = if term.half.length() > 0.0 { term.half.normalized() } else { term.half };
        line(text, format_args!("  H   = (L + V)/‖L + V‖ = {}", vector(half)));
        let (cosine, lobe) = (digits(term.cos_theta_h), digits(term.lobe));
        line(text, format_args!("  cosθ_h = max(0, N·H) = {cosine},  cosθ_h^n = {cosine}^{n} = {lobe}"));
        if !convention.has_cosine_in_highlight() {
            explain_irradiance_across(text, scene, index, term);
        }
        let specular = match convention {
            Convention::CoursePi => format!("E k_s/π (N·H)^n = {irradiance} × {k_s}/π × {lobe}"),
            Convention::Radiance => {
                let constant = digits(lobe_constant(n));
                line(text, format_args!("  c(n) = (n+2)(n+4)/(8π(n + 2^(−n/2))) = {constant}   (3.6)"));
                format!("E k_s c(n) (N·H)^n = {irradiance} × {k_s} × {constant} × {lobe}")
            }
            Convention::BlinnPhong => format!("E⊥ k_s (N·H)^n = {} × {k_s} × {lobe}", digits(term.lobe_irradiance)),
            Convention::BlinnPhongPi => {
                format!("E⊥ k_s/π (N·H)^n = {} × {k_s}/π × {lobe}", digits(term.lobe_irradiance))
            }
            _ => format!("E k_s (N·H)^n = {irradiance} × {k_s} × {lobe}"),
        };
        let value = digits(term.specular(formula, &self.hit.point));
        say(text, &message!("  specular = {specular} = {value} {end}", specular, value, end));
    }

    fn explain_diffuse(&self, text: &mut Page, scene: &PreparedScene, irradiance: f64) {
        let convention = scene.scene().convention();
        let Some(material) = scene.scene().material_of(self.hit.primitive) else { return };
        if !convention.uses_material() {
            return;
        }
        let k_d = scene.scene().materials()[material].reflectance.diffuse;
        let end = format!("{}   ({})", convention.unit(scene.scene().unit_system()), convention.formula_number());
        if self.hit.point.cos_theta_o <= 0.0 {
            say(text, &message!("  diffuse = specular = 0 {end}, since θ_o ≥ 90°", end));
            return;
        }
        let value = digits(irradiance * scene.formula(self.hit.primitive).diffuse_factor(self.hit.point.cos_theta_o));
        let irradiance = digits(irradiance);
        let diffuse = match convention {
            Convention::Irradiance | Convention::Lambert | Convention::Course | Convention::BlinnPhong => {
                format!("E k_d = {irradiance} × {k_d}")
            }
            Convention::Lab => {
                format!("E k_d cosθ_o = {irradiance} × {k_d} × {}", digits(self.hit.point.cos_theta_o))
            }
            Convention::CoursePi | Convention::Radiance | Convention::BlinnPhongPi => {
                format!("E k_d/π = {irradiance} × {k_d}/π")
            }
        };
        say(text, &message!("  diffuse  = {diffuse} = {value} {end}", diffuse, value, end));
    }

    fn explain_sum(&self, text: &mut Page, scene: &PreparedScene) {
        let description = scene.scene();
        let convention = description.convention();
        let unit = convention.unit(description.unit_system());
        line(text, format_args!(""));
        let count = self.terms.len();
        let sum = match (count, description.ambient()) {
            (1, None) => message!("Sum over {count} light", count),
            (1, Some(_)) => message!("Sum over {count} light and the ambient light", count),
            (_, None) => message!("Sum over {count} lights", count),
            (_, Some(_)) => message!("Sum over {count} lights and the ambient light", count),
        };
        say(text, &sum);
        let irradiance = description.unit_system().irradiance_unit();
        line(text, format_args!("  E = {} {irradiance}   (3.1)", full(self.shading.irradiance)));
        if convention.uses_material() {
            let (diffuse, specular) = (digits(self.shading.diffuse), digits(self.shading.specular));
            say(text, &message!("  B = diffuse + specular = {diffuse} + {specular}", diffuse, specular));
        }
        let number = convention.formula_number();
        line(text, format_args!("  B = {} {unit}   ({number})", full(self.shading.brightness())));
    }
}

/// What the highlight of (3.11) and (3.12) is multiplied by: the irradiance of a surface that faces the light.
fn explain_irradiance_across(text: &mut Page, scene: &PreparedScene, index: usize, term: &LightTerm) {
    let description = scene.scene();
    let (unit, number) = (description.unit_system().irradiance_unit(), description.convention().formula_number());
    let across = digits(term.lobe_irradiance);
    let calculation = match description.lights()[index].kind {
        _ if term.cos_theta_i <= 0.0 => {
            say(text, &message!("  E⊥  = 0 {unit}, since cosθ_i = 0   ({number})", unit, number));
            return;
        }
        LightKind::Point(_) => {
            let (intensity, distance) = (digits(term.intensity), digits(term.distance));
            format!("v I / r² = {} × {intensity} / {distance}²", term.visibility)
        }
        LightKind::Parallel(_) => format!("v E₀ = {} × {}", term.visibility, digits(term.intensity)),
    };
    say(
        text,
        &message!(
            "  E⊥  = {calculation} = {across} {unit}, without cosθ_i   ({number})",
            calculation,
            across,
            unit,
            number
        ),
    );
}

/// The calculation of each component, and the luminance of their results.
fn explain_components(text: &mut Page, components: &Components, readings: &Rgb<ProbeReading>) {
    let space = components.space;
    for component in Component::ALL {
        line(text, format_args!(""));
        say(text, &message!("── {component} ({space}) ──", component = component.label(), space = space.name()));
        readings.of(*component).explain_numbers(text, components.of(*component));
    }
    let scene = components.of(Component::Red).scene();
    let (convention, units) = (scene.convention(), scene.unit_system());
    let weights = space.luminance_weights();
    line(text, format_args!(""));
    let formula = space.luminance_text();
    say(text, &message!("Luminance Y = {formula}   (3.10), {space}", formula, space = space.name()));
    let mut sum = |symbol: &str, values: Rgb, unit: &str| {
        let terms = Rgb::from_fn(|one| format!("{} × {}", digits(*weights.of(one)), digits(*values.of(one))));
        let sum = full(values.weighted_by(weights));
        line(text, format_args!("  {symbol}_Y = {} = {sum} {unit}", terms.into_array().join(" + ")));
    };
    sum("E", readings.map(|reading| reading.shading.irradiance), units.irradiance_unit());
    sum("B", readings.map(|reading| reading.shading.brightness()), convention.unit(units));
}

fn explain_emission(text: &mut Page, light: &PointLight, term: &LightTerm, unit: &str) {
    let (on_axis, intensity) = (digits(light.intensity), digits(term.intensity));
    let axis = match light.emission {
        Emission::Isotropic => {
            say(text, &message!("  I   = {intensity} {unit}, isotropic", intensity, unit));
            return;
        }
        Emission::Lambertian { axis } => axis,
        Emission::Spot(spot) => spot.cone.axis,
    };
    let cosine = axis.dot(-term.direction);
    say(text, &message!("  A   = {vector}   axis of the light", vector = vector(axis)));
    line(text, format_args!("  cosγ = A·(−L) = {}", digits(cosine)));
    let Emission::Spot(spot) = light.emission else {
        let cosine = digits(cosine);
        line(text, format_args!("  I   = I₀ max(0, cosγ) = {on_axis} × max(0, {cosine}) = {intensity} {unit}"));
        return;
    };
    let [inner, outer] = [spot.inner_angle(), spot.outer_angle()];
    let [inner_cosine, outer_cosine] = [inner, outer].map(libm::cos);
    let [inner, outer] = [inner, outer].map(|angle| digits(angle.to_degrees()));
    say(text, &message!("  α   = {inner}°, β = {outer}°   half angles of its cones", inner, outer));
    let x = ((cosine - outer_cosine) / (inner_cosine - outer_cosine)).clamp(0.0, 1.0);
    say(text, &message!("  x   = (cosγ − cosβ)/(cosα − cosβ), from 0 to 1: {x}", x = digits(x)));
    line(
        text,
        format_args!(
            "  I   = I₀ x²(3 − 2x) = {on_axis} × {} = {intensity} {unit}   (3.7)",
            digits(x * x * (3.0 - 2.0 * x))
        ),
    );
}

/// The lines so far.
struct Page {
    text: String,
    language: Language,
}

/// A line without words.
fn line(page: &mut Page, content: std::fmt::Arguments<'_>) {
    // Writing to a `String` cannot fail.
    let _ = page.text.write_fmt(content);
    page.text.push('\n');
}

/// A line with words.
fn say(page: &mut Page, line: &Message) {
    page.text.push_str(&line.in_language(page.language));
    page.text.push('\n');
}

fn vector_in(vector: Vector, length: LengthUnit) -> String {
    let components = vector.to_array().map(|component| digits(length.from_metres(component)));
    format!("({})", components.join(", "))
}

fn vector(vector: Vector) -> String {
    vector_in(vector, LengthUnit::Metre)
}

/// 12 significant digits, without trailing zeros.
fn digits(value: f64) -> String {
    significant(value, 12)
}

/// 15 significant digits.
fn full(value: f64) -> String {
    significant(value, 15)
}
