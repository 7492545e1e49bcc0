//! Validates each light by itself.

use super::leave_out_or_write;
use super::names::{Kind, Names};
use super::numbers::Aim;
use super::{Checked, Validator};
use crate::light::{Ambient, Emission, Light, LightKind, ParallelLight, PointLight, Spot};
use crate::message;
use crate::scene::document::Path;
use crate::scene::limits;
use crate::scene::source::{EmissionName, LightSource, SceneSource};
use crate::text::Message;
use crate::units::Keyword;
use crate::vector::Vector;

impl Validator<'_> {
    pub(super) fn lights(&mut self, source: &SceneSource) -> Checked<Light> {
        if !self.few_enough("light", source.light.len(), limits::LIGHTS) {
            return Vec::new();
        }
        let mut names = Names::new(Kind::Light);
        let check = |(index, light): (usize, &LightSource)| {
            let path = Path::root().key("light").index(index);
            let name = names.check(self, &path, light.name.as_deref());
            if self.problems.has(&path.key("emission")) {
                // It is unknown which keys it needs.
                return None;
            }
            let emission = light.emission.unwrap_or(EmissionName::Isotropic);
            self.refuse_keys_without_meaning(&path, light, emission);
            let kind = match emission {
                EmissionName::Parallel => self.parallel_light(&path, light).map(LightKind::Parallel),
                _ => self.point_light(&path, light, emission).map(LightKind::Point),
            };
            let casts_shadows = light.casts_shadows.unwrap_or(true);
            let written = Light { name: name?, kind: kind?, casts_shadows, is_on: true };
            Some(written.switched(light.on.unwrap_or(true)))
        };
        source.light.iter().enumerate().map(check).collect()
    }

    pub(super) fn ambient(&mut self, source: &SceneSource) -> Option<Ambient> {
        let ambient = source.ambient.as_ref()?;
        let path = Path::root().key("ambient");
        let Some(radiance) = ambient.radiance else {
            self.problems.missing(&path, "radiance", message!("write `radiance = …`, in W/(m²·sr) or cd/m²"));
            return None;
        };
        let radiance = self.strength(&path.key("radiance"), radiance);
        let samples = match ambient.samples {
            Some(samples) => self.samples(&path, samples),
            None => Some(Ambient::SAMPLES),
        };
        let is_obstructed = ambient.obstructed.unwrap_or(false);
        if !is_obstructed && ambient.samples.is_some() {
            let message = message!("`ambient.samples` means nothing where ambient light is not obstructed");
            self.wrong(&path.key("samples"), message, message!("leave it out, or write `obstructed = true`"));
        }
        Some(Ambient { radiance: radiance?, obstruction: samples.filter(|_| is_obstructed) })
    }

    fn point_light(&mut self, path: &Path, light: &LightSource, emission: EmissionName) -> Option<PointLight> {
        let position = self.required_point(path, "position", light.position);
        let emission = match emission {
            EmissionName::Isotropic | EmissionName::Parallel => Some(Emission::Isotropic),
            EmissionName::Lambertian => self.axis(path, light, position).map(|axis| Emission::Lambertian { axis }),
            EmissionName::Spot => {
                let axis = self.axis(path, light, position);
                let angles = self.cones(path, light);
                axis.zip(angles).map(|(axis, [inner, outer])| Emission::Spot(Spot::new(axis, inner, outer)))
            }
        };
        let intensity = self.intensity(path, light, emission);
        Some(PointLight { position: position?, intensity: intensity?, emission: emission? })
    }

    fn axis(&mut self, path: &Path, light: &LightSource, position: Option<Vector>) -> Option<Vector> {
        let axis = self.aim(
            path,
            position,
            &Aim { direction: ("axis", light.axis), target: light.target, tilt: light.tilt, azimuth: light.azimuth },
        )?;
        Some(axis.normalized())
    }

    /// The half angles of a spot's cones, in radians.
    fn cones(&mut self, path: &Path, light: &LightSource) -> Option<[f64; 2]> {
        let mut angle = |key: &'static str, angle: Option<f64>, what: fn() -> Message| {
            let Some(angle) = angle else {
                self.problems.missing(
                    path,
                    key,
                    message!("write `{key} = …`, in degrees from the axis: {what}", key, what = what()),
                );
                return None;
            };
            if (0.0..=limits::CONE).contains(&angle) {
                return Some(angle);
            }
            let message = message!("`{path}.{key}` is {angle}", path, key, angle);
            let help =
                message!("allowed: 0 to {cone} degrees, from the axis to the edge of the cone", cone = limits::CONE);
            self.wrong(&path.key(key), message, help);
            None
        };
        let inner = angle("inner_angle", light.inner_angle, || message!("inside, the spot has its full intensity"));
        let outer = angle("outer_angle", light.outer_angle, || message!("outside, the spot sends nothing"));
        let [inner, outer] = [inner?, outer?];
        // So that a difference written as half a degree counts as one.
        if outer - inner < limits::CONE_STEP * (1.0 - 1e-9) {
            let message = message!("`{path}` has cones from {inner} to {outer} degrees", path, inner, outer);
            let help = message!(
                "allowed: `outer_angle` at least {cone_step} degrees more than `inner_angle`",
                cone_step = limits::CONE_STEP
            );
            self.wrong(&path.key("outer_angle"), message, help);
            return None;
        }
        Some([inner.to_radians(), outer.to_radians()])
    }

    fn intensity(&mut self, path: &Path, light: &LightSource, emission: Option<Emission>) -> Option<f64> {
        let (key, value) = match (light.intensity, light.power) {
            (Some(intensity), None) => ("intensity", intensity),
            (None, Some(power)) => ("power", power),
            (Some(_), Some(_)) => {
                let message = message!("`{path}` has both `intensity` and `power`", path);
                self.wrong(&path.key("power"), message, message!("allowed: one of the two"));
                return None;
            }
            (None, None) => {
                let help = message!("write `intensity` (W/sr or cd), or `power` (W or lm) instead");
                self.problems.missing(path, "intensity", help);
                return None;
            }
        };
        let value = self.strength(&path.key(key), value)?;
        if key == "power" { Some(value / emission?.solid_angle()) } else { Some(value) }
    }

    fn parallel_light(&mut self, path: &Path, light: &LightSource) -> Option<ParallelLight> {
        let direction = if light.direction.is_none() && light.tilt.is_none() && light.azimuth.is_none() {
            let help = message!(
                "write `direction = [x, y, z]`, the way that the light travels, or its angles, `tilt` and `azimuth`"
            );
            self.problems.missing(path, "direction", help);
            None
        } else {
            let (direction, target) = (("direction", light.direction), None);
            self.aim(path, None, &Aim { direction, target, tilt: light.tilt, azimuth: light.azimuth })
        };
        let irradiance = if let Some(irradiance) = light.irradiance {
            self.strength(&path.key("irradiance"), irradiance)
        } else {
            let help = message!("write `irradiance = …`, in W/m² or lx on a plane at right angles to the light");
            self.problems.missing(path, "irradiance", help);
            None
        };
        Some(ParallelLight { direction: direction?.normalized(), irradiance: irradiance? })
    }

    /// Rejects keys that belong to lights with another emission.
    fn refuse_keys_without_meaning(&mut self, path: &Path, light: &LightSource, emission: EmissionName) {
        use EmissionName::{Isotropic, Lambertian, Parallel, Spot};
        const POINT: &[EmissionName] = &[Isotropic, Lambertian, Spot];
        const AIMED: &[EmissionName] = &[Lambertian, Spot];
        const ALONG: &[EmissionName] = &[Lambertian, Spot, Parallel];
        let keys = [
            ("position", light.position.is_some(), POINT),
            ("intensity", light.intensity.is_some(), POINT),
            ("power", light.power.is_some(), POINT),
            ("axis", light.axis.is_some(), AIMED),
            ("target", light.target.is_some(), AIMED),
            ("tilt", light.tilt.is_some(), ALONG),
            ("azimuth", light.azimuth.is_some(), ALONG),
            ("inner_angle", light.inner_angle.is_some(), &[Spot]),
            ("outer_angle", light.outer_angle.is_some(), &[Spot]),
            ("direction", light.direction.is_some(), &[Parallel]),
            ("irradiance", light.irradiance.is_some(), &[Parallel]),
        ];
        for (key, is_written, emissions) in keys {
            if is_written && !emissions.contains(&emission) {
                let emission = emission.name();
                let message = if emission == Isotropic.name() {
                    message!("`{path}.{key}` means nothing for an {emission} light", path, key, emission)
                } else {
                    message!("`{path}.{key}` means nothing for a {emission} light", path, key, emission)
                };
                let help = leave_out_or_write("emission", emissions);
                self.wrong(&path.key(key), message, help);
            }
        }
    }
}
