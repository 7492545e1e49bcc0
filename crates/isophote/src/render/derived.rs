//! Channels that follow from what a pixel sees, whichever way that was found, and maps of single lights.

use std::ops::ControlFlow;

use super::{Observer, RenderError, RenderSettings};
use crate::map::{Channel, Map, Quantity, Values};
use crate::prepare::PreparedScene;
use crate::shape::Primitive;
use crate::vector::Vector;

/// Renders the channels that are computed, and derives the others from them and from maps of single lights.
pub fn render(
    scene: &PreparedScene,
    settings: &RenderSettings<'_>,
    mut render: impl FnMut(&PreparedScene, &RenderSettings<'_>) -> Result<Map, RenderError>,
) -> Result<Map, RenderError> {
    let derived: Vec<&Quantity> = settings.quantities.iter().filter(|quantity| quantity.is_derived()).collect();
    if derived.is_empty() {
        return render(scene, settings);
    }
    let lights = lights(scene, &derived)?;
    let computed = settings.quantities.iter().filter(|quantity| !quantity.is_derived()).cloned();
    let needs_geometry = derived.iter().any(|quantity| Quantity::OF_CAMERA.contains(quantity));
    let geometry = [Quantity::Position, Quantity::Normal].into_iter().filter(|_| needs_geometry);
    let quantities = computed.chain(geometry).collect();
    let mut map = render(scene, &RenderSettings { quantities, ..settings.clone() })?;
    for quantity in derived {
        let channel = match quantity {
            Quantity::Material => channel(scene, quantity, Values::Index(materials(scene, &map))),
            Quantity::LightBrightness(_) => continue,
            _ => channel(scene, quantity, of_camera(scene, &map, quantity)),
        };
        map.channels.push(channel);
    }
    let observer = settings.observer.map(Uncounted);
    for (name, light) in lights {
        let alone = scene.scene().with_one_light(light).expect("a part of a valid scene is valid");
        // The source does not know of another resolution.
        let alone = PreparedScene::reusing(scene, &alone).at_resolution(scene.scene().camera().resolution);
        let observer = observer.as_ref().map(|observer| -> &dyn Observer { observer });
        let of_light = RenderSettings { region: settings.region, quantities: vec![Quantity::Brightness], observer };
        let values = render(&alone, &of_light)?.channels.swap_remove(0).values;
        map.channels.push(channel(scene, &Quantity::LightBrightness(name), values));
    }
    map.channels = in_order(map.channels, &settings.quantities);
    Ok(map)
}

/// The names and indices of the lights whose own brightness is requested.
fn lights(scene: &PreparedScene, quantities: &[&Quantity]) -> Result<Vec<(String, usize)>, RenderError> {
    let names = quantities.iter().filter_map(|quantity| match quantity {
        Quantity::LightBrightness(name) => Some(name.clone()),
        _ => None,
    });
    let found = names.map(|name| match scene.scene().light_named(&name) {
        Some(light) => Ok((name, light)),
        None => Err(RenderError::NoSuchLight { name }),
    });
    found.collect()
}

/// Stops a render of one light with all of it; its pixels have been counted already.
struct Uncounted<'o>(&'o dyn Observer);

impl Observer for Uncounted<'_> {
    fn advance(&self, _: u64) -> ControlFlow<()> {
        self.0.advance(0)
    }
}

/// The channels that were requested, in that order, without duplicates.
fn in_order(mut channels: Vec<Channel>, quantities: &[Quantity]) -> Vec<Channel> {
    let mut ordered = Vec::new();
    for quantity in quantities {
        if let Some(index) = channels.iter().position(|channel| channel.quantity == *quantity) {
            ordered.push(channels.swap_remove(index));
            channels.retain(|channel| channel.quantity != *quantity);
        }
    }
    ordered
}

fn channel(scene: &PreparedScene, quantity: &Quantity, values: Values) -> Channel {
    let scene = scene.scene();
    let unit = quantity.unit(scene.convention(), scene.unit_system(), scene.length()).into();
    Channel { quantity: quantity.clone(), unit, values }
}

/// The material that each pixel sees. Where parts of a shape have their own, the pixel is traced again.
fn materials(scene: &PreparedScene, map: &Map) -> Vec<i32> {
    let mut values = vec![-1; map.region.size.pixels()];
    for run in map.mask.runs() {
        let shape = run.shape as usize;
        let of_shape = Primitive { shape, part: 0 };
        let has_own = scene.scene().shapes()[shape].geometry.has_own_materials();
        for (index, value) in (run.start..run.end).zip(&mut values[run.start..run.end]) {
            let primitive = if has_own {
                scene.trace_pixel(map.pixel(index)).map_or(of_shape, |hit| hit.primitive)
            } else {
                of_shape
            };
            let material = scene.scene().material_of(primitive).and_then(|material| i32::try_from(material).ok());
            *value = material.unwrap_or(-1);
        }
    }
    values
}

fn of_camera(scene: &PreparedScene, map: &Map, quantity: &Quantity) -> Values {
    let (frame, length) = (scene.frame(), scene.scene().length());
    let (positions, normals) = (vectors(map, &Quantity::Position), vectors(map, &Quantity::Normal));
    let metres = |index: usize| Vector::from(positions[index].map(|coordinate| length.to_metres(coordinate)));
    let normal = |index: usize| Vector::from(normals[index]);
    let pixels = map.region.size.pixels();
    if *quantity == Quantity::CameraNormal {
        let mut values = vec![[0.0; 3]; pixels];
        for index in map.mask.indices() {
            let normal = normal(index);
            values[index] = [normal.dot(frame.right), -normal.dot(frame.up), normal.dot(frame.forward)];
        }
        return Values::Vector(values);
    }
    let mut values = vec![0.0; pixels];
    for index in map.mask.indices() {
        let point = metres(index);
        values[index] = if *quantity == Quantity::ZDepth {
            length.from_metres((point - frame.eye).dot(frame.forward))
        } else {
            normal(index).dot(frame.sight(point, Vector::default()).view)
        };
    }
    Values::Scalar(values)
}

fn vectors<'m>(map: &'m Map, quantity: &Quantity) -> &'m [[f64; 3]] {
    match map.channel(quantity).map(|channel| &channel.values) {
        Some(Values::Vector(values)) => values,
        _ => unreachable!("it was asked for, and is a vector"),
    }
}

#[cfg(test)]
mod tests {
    use crate::map::{Quantity, Resolution};
    use crate::prepare::PreparedScene;
    use crate::render::{ReferenceRenderer, RenderSettings, Renderer};
    use crate::scene::{Scene, Syntax};

    /// The brightness by single lights adds up to the whole, also with another resolution than the scene says.
    #[test]
    fn single_lights_have_the_resolution_of_the_scene_that_is_rendered() {
        let text = include_str!("../../../../scenes/two-lights.toml");
        let scene = Scene::from_text("two-lights", text, Syntax::Toml).unwrap_or_else(|error| panic!("{error}"));
        let small = PreparedScene::new(&scene).at_resolution(Resolution { width: 24, height: 18 });
        let of_lights: Vec<Quantity> =
            scene.lights().iter().map(|light| Quantity::LightBrightness(light.name.clone())).collect();
        let quantities = of_lights.iter().cloned().chain([Quantity::Brightness]).collect();
        let settings = RenderSettings { quantities, ..RenderSettings::default() };
        let map = ReferenceRenderer.render(&small, &settings).unwrap_or_else(|error| panic!("{error}"));
        let whole = map.scalar(&Quantity::Brightness).expect("it was asked for");
        let lights: Vec<_> = of_lights.iter().map(|light| map.scalar(light).expect("it was asked for")).collect();
        for index in map.mask().indices() {
            let sum: f64 = lights.iter().map(|light| light.at(index)).sum();
            assert!((sum - whole.at(index)).abs() <= 1e-12 * whole.at(index), "{index}: {sum}");
        }
        assert!(map.mask().visible() > 50);
    }
}
