//! Channels as the user names them.

use anyhow::Result;
use isophote::map::Quantity;
use isophote::message;
use isophote::render::RenderError;
use isophote::scene::Scene;

use crate::failure::Usage;

/// The channels named by the user, with a clear error for those that do not exist.
pub fn named(names: &[String], scene: &Scene) -> Result<Vec<Quantity>> {
    let lights: Vec<Quantity> = scene.lights().iter().map(|light| Quantity::Light(light.name.clone())).collect();
    let known = |quantity: &Quantity| !matches!(quantity, Quantity::Light(_)) || lights.contains(quantity);
    let color = scene.color().map(|_| Quantity::Color);
    let channel = |name: &String| {
        if color.is_none() && *name == Quantity::Color.name() {
            return Err(Usage(RenderError::NoColor.message()).into());
        }
        if scene.sampling().tolerance.is_none() && *name == Quantity::SamplingError.name() {
            return Err(Usage(RenderError::NoTolerance.message()).into());
        }
        Quantity::from_name(name).filter(known).ok_or_else(|| {
            let known = Quantity::COMMON
                .iter()
                .chain(&Quantity::OF_SAMPLING)
                .chain(&Quantity::OF_CAMERA)
                .chain(&[Quantity::Material])
                .chain(&color)
                .chain(lights.iter().take(20));
            let names: Vec<String> = known.map(Quantity::name).collect();
            Usage(message!("there is no channel `{name}`; allowed: {names}", name, names = names.join(", "))).into()
        })
    };
    names.iter().map(channel).collect()
}

/// The unit of a quantity in a scene.
pub fn unit(quantity: &Quantity, scene: &Scene) -> String {
    quantity.unit(scene.convention(), scene.unit_system(), scene.length()).to_owned()
}
