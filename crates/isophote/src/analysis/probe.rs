//! Exact values at a point.

use crate::camera::ScreenPosition;
use crate::color::Rgb;
use crate::map::Pixel;
use crate::message;
use crate::prepare::{Hit, PreparedScene};
use crate::scene::Scene;
use crate::shade::{LightTerm, Shading};
use crate::shape::{Located, Miss, Primitive};
use crate::text::Message;
use crate::units::LengthUnit;
use crate::vector::Vector;

/// Where to take a value.
#[derive(Clone, Debug, PartialEq)]
pub enum ProbePosition {
    /// A point in space, in metres.
    Point(Vector),
    /// The point on the nearest surface, in metres.
    NearestTo(Vector),
    /// The surface point visible at the centre of a pixel.
    Pixel(Pixel),
    /// The surface point visible at a point of the screen, which may lie outside the window; in metres or degrees.
    Screen {
        /// To the right.
        x: f64,
        /// Upwards.
        y: f64,
    },
    /// A point of a sphere given by angles relative to the camera's axes, in radians: θ from the direction towards the
    /// viewer (opposite to the direction of view), φ from +x of the screen towards +y.
    Angles {
        /// Index of the shape.
        shape: usize,
        /// θ.
        theta: f64,
        /// φ.
        phi: f64,
    },
}

/// Values at a point of a surface, in double precision: within 1e-12 relative where cosθ_i and cosθ_o exceed 1e-3.
///
/// For a scene with colours they are luminances (3.10), and the components have readings of their own.
#[derive(Clone, Debug)]
pub struct ProbeReading {
    /// The point, its primitive, and its directions.
    pub hit: Hit,
    /// Irradiance and brightness.
    pub shading: Shading,
    /// Each light's term, in the order of the scene.
    pub terms: Vec<LightTerm>,
    /// The primitive that blocks each light from the point, if any.
    pub blockers: Vec<Option<Primitive>>,
    /// Whether the eye sees the point.
    pub seen: SeenFromEye,
    /// The readings of the components of a scene with colours.
    pub components: Option<Box<Rgb<Self>>>,
}

/// Whether the eye would see a point if it looked there, whether that is in the picture or not.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SeenFromEye {
    /// It would.
    Seen,
    /// The surface faces away from the eye there: θ_o ≥ 90°.
    FacesAway,
    /// It lies behind the plane on which parallel rays start.
    Behind,
    /// This primitive is in front of it.
    HiddenBy(Primitive),
}

impl ProbeReading {
    /// The point, in the scene's unit.
    #[must_use]
    pub fn position(&self, length: LengthUnit) -> [f64; 3] {
        self.hit.point.position().to_array().map(|metres| length.from_metres(metres))
    }

    /// The luminances of the readings of a scene with colours.
    fn of_components(readings: Rgb<Self>, weights: Rgb) -> Self {
        let shading = Shading::luminance(&readings.map(|reading| reading.shading), weights);
        let term = |(index, term): (usize, &LightTerm)| {
            let of = |number: fn(&LightTerm) -> f64| readings.map(|reading| number(&reading.terms[index]));
            LightTerm {
                intensity: of(|term| term.intensity).weighted_by(weights),
                irradiance: of(|term| term.irradiance).weighted_by(weights),
                lobe_irradiance: of(|term| term.lobe_irradiance).weighted_by(weights),
                // The same in all components that have a highlight.
                lobe: of(|term| term.lobe).into_array().into_iter().fold(0.0, f64::max),
                ..*term
            }
        };
        let terms = readings.red.terms.iter().enumerate().map(term).collect();
        let Self { hit, seen, ref blockers, .. } = readings.red;
        Self { hit, shading, terms, blockers: blockers.clone(), seen, components: Some(Box::new(readings)) }
    }

    /// A light's share of the diffuse and of the specular part of B; the light is given by its index.
    #[must_use]
    pub fn light_shares(&self, scene: &PreparedScene, light: usize) -> [f64; 2] {
        if let (Some(components), Some(readings)) = (scene.components(), self.components.as_deref()) {
            let weights = components.space.luminance_weights();
            let shares = Rgb::from_fn(|one| readings.of(one).light_shares(components.of(one), light));
            [0, 1].map(|part| shares.map(|shares| shares[part]).weighted_by(weights))
        } else {
            let (term, formula) = (&self.terms[light], scene.formula(self.hit.primitive));
            [term.diffuse(formula, &self.hit.point), term.specular(formula, &self.hit.point)]
        }
    }

    /// Whether the eye sees the point.
    #[must_use]
    pub fn is_seen(&self) -> bool {
        self.seen == SeenFromEye::Seen
    }

    /// Why the eye does not see the point, in words; `None` if it does.
    #[must_use]
    pub fn why_unseen(&self, scene: &Scene) -> Option<Message> {
        match self.seen {
            SeenFromEye::Seen => None,
            SeenFromEye::Behind => Some(message!("it is behind the plane of the eye")),
            SeenFromEye::FacesAway => Some(message!("the surface faces away there (θ_o ≥ 90°)")),
            SeenFromEye::HiddenBy(other) => {
                Some(message!("\"{other}\" stands before it", other = scene.name_of(other)))
            }
        }
    }
}

/// Why there is no value.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("{}", self.message())]
pub enum ProbeError {
    /// The point is on no surface.
    OffSurface(Box<Miss>),
    /// The scene has no shapes.
    NoShapes,
    /// Only spheres have points given by angles.
    NoAngles {
        /// The kind of the shape.
        kind: &'static str,
    },
    /// The pixel is outside the image.
    NoSuchPixel {
        /// The requested pixel.
        pixel: Pixel,
    },
    /// The pixel sees no surface.
    NothingSeen {
        /// The requested pixel.
        pixel: Pixel,
    },
    /// A point of the screen sees no surface.
    NothingThere,
}

impl ProbeError {
    /// What is wrong, in either language.
    #[must_use]
    pub fn message(&self) -> Message {
        match self {
            Self::OffSurface(_) => message!("the point is on no surface"),
            Self::NoShapes => message!("the scene has no shapes"),
            Self::NoAngles { kind } => message!("points are given by angles on a sphere only, not on a {kind}", kind),
            Self::NoSuchPixel { pixel: Pixel { column, row } } => {
                message!("there is no pixel at column {column}, row {row}", column, row)
            }
            Self::NothingSeen { pixel: Pixel { column, row } } => {
                message!("no surface is seen at column {column}, row {row}", column, row)
            }
            Self::NothingThere => message!("no surface is seen there on the screen"),
        }
    }
}

impl PreparedScene {
    /// The values at a position, by the convention of the scene (3.1) to (3.12).
    ///
    /// # Errors
    /// A position that is on no surface.
    pub fn probe(&self, place: &ProbePosition) -> Result<ProbeReading, ProbeError> {
        match self.components() {
            None => self.probe_numbers(place),
            Some(components) => {
                let Rgb { red, green, blue } = components.scenes();
                let red = red.probe_numbers(place)?;
                let readings = Rgb { red, green: green.probe_numbers(place)?, blue: blue.probe_numbers(place)? };
                Ok(ProbeReading::of_components(readings, components.space.luminance_weights()))
            }
        }
    }

    fn probe_numbers(&self, place: &ProbePosition) -> Result<ProbeReading, ProbeError> {
        match *place {
            ProbePosition::Point(point) => match self.surface_at(point) {
                Ok(located) => Ok(self.reading_at(&located)),
                Err(Some(miss)) => Err(ProbeError::OffSurface(miss)),
                Err(None) => Err(ProbeError::NoShapes),
            },
            ProbePosition::NearestTo(point) => match self.surface_at(point) {
                Ok(located) => Ok(self.reading_at(&located)),
                Err(Some(miss)) => {
                    let Miss { shape, nearest, .. } = *miss;
                    Ok(self.reading_at(&Located { shape, nearest }))
                }
                Err(None) => Err(ProbeError::NoShapes),
            },
            ProbePosition::Pixel(pixel) => self.probe_pixel(pixel),
            ProbePosition::Screen { x, y } => {
                let position = ScreenPosition::Point { x, y };
                let hit = self.trace(position).ok_or(ProbeError::NothingThere)?;
                Ok(self.reading(hit, Some(position), SeenFromEye::Seen))
            }
            ProbePosition::Angles { shape, theta, phi } => {
                let frame = self.frame();
                let ring = frame.right * libm::cos(phi) + frame.up * libm::sin(phi);
                let direction = ring * libm::sin(theta) - frame.forward * libm::cos(theta);
                let geometry = &self.scene().shapes().get(shape).ok_or(ProbeError::NoShapes)?.geometry;
                let nearest = geometry.in_direction(direction).ok_or(ProbeError::NoAngles { kind: geometry.kind() })?;
                Ok(self.reading_at(&Located { shape, nearest }))
            }
        }
    }

    fn probe_pixel(&self, pixel: Pixel) -> Result<ProbeReading, ProbeError> {
        let resolution = self.scene().camera().resolution;
        if pixel.column >= resolution.width || pixel.row >= resolution.height {
            return Err(ProbeError::NoSuchPixel { pixel });
        }
        let hit = self.trace_pixel(pixel).ok_or(ProbeError::NothingSeen { pixel })?;
        Ok(self.reading(hit, Some(ScreenPosition::PixelCenter(pixel)), SeenFromEye::Seen))
    }

    fn reading_at(&self, located: &Located) -> ProbeReading {
        let hit = self.surface_point(located);
        self.reading(hit, None, self.seen_from_eye(&hit))
    }

    fn reading(&self, hit: Hit, seen_at: Option<ScreenPosition>, seen: SeenFromEye) -> ProbeReading {
        // One term for each light, however many emitters it has.
        let mut terms: Vec<LightTerm> = Vec::with_capacity(self.scene().lights().len());
        let shading = self.shade(&hit, seen_at, |light, term| match terms.get_mut(light) {
            Some(known) => known.add(term),
            None => terms.push(*term),
        });
        let blocker = |(light, term): (usize, &LightTerm)| {
            let mut emitters = self.emitters().of_light(light);
            if term.visibility > 0.0 { None } else { emitters.find_map(|emitter| self.blocking(&hit, emitter).blocker) }
        };
        let blockers = terms.iter().enumerate().map(blocker).collect();
        ProbeReading { hit, shading, terms, blockers, seen, components: None }
    }

    pub(super) fn seen_from_eye(&self, hit: &Hit) -> SeenFromEye {
        if hit.point.cos_theta_o <= 0.0 {
            return SeenFromEye::FacesAway;
        }
        if hit.distance < 0.0 {
            return SeenFromEye::Behind;
        }
        match self.first_towards(hit.point.position()) {
            Some(first) if first != hit.primitive => SeenFromEye::HiddenBy(first),
            _ => SeenFromEye::Seen,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::map::Quantity;
    use crate::render::{ReferenceRenderer, RenderSettings, Renderer};
    use crate::scene::Syntax;

    /// A light's values are the sums over all of its emitters.
    #[test]
    fn a_light_of_two_emitters_is_told_as_one_light() {
        let text = include_str!("../../../../scenes/shadows.toml");
        let scene = Scene::from_text("shadows", text, Syntax::Toml).unwrap_or_else(|error| panic!("{error}"));
        let whole = PreparedScene::new(&scene).at_resolution(crate::map::Resolution { width: 24, height: 18 });
        let halved = whole.clone().with_emitters_halved();
        let lights = scene.lights().iter().map(|light| Quantity::Light(light.name.clone()));
        let settings =
            RenderSettings { quantities: lights.chain([Quantity::Brightness]).collect(), ..RenderSettings::default() };
        let [one, other] = [&whole, &halved].map(|scene| ReferenceRenderer.render(scene, &settings).unwrap());
        let mut compared = 0;
        for index in one.mask().indices() {
            for quantity in &settings.quantities {
                let [expected, found] = [&one, &other].map(|map| map.scalar(quantity).unwrap().at(index));
                assert!((found - expected).abs() <= 1e-15 * expected.abs(), "{quantity:?}: {found:e} {expected:e}");
            }
            let place = ProbePosition::Pixel(one.pixel(index));
            let [expected, found] = [&whole, &halved].map(|scene| scene.probe(&place).unwrap());
            assert_eq!(expected.blockers, found.blockers);
            for (expected, found) in expected.terms.iter().zip(&found.terms) {
                assert!((found.irradiance - expected.irradiance).abs() <= 1e-15 * expected.irradiance);
                assert_eq!((found.visibility, found.intensity), (expected.visibility, expected.intensity));
                compared += 1;
            }
        }
        assert!(compared > 100, "{compared}");
    }
}
