//! Maps of scenes with colours: visibility is computed once, and shading once for each component of the light.
//!
//! A layer is the map of one component. A scene without colours has one layer, which is its map.

use super::provenance::provenance;
use crate::color::Rgb;
use crate::map::{Channel, Map, Quantity, Scalars, Values};
use crate::prepare::PreparedScene;

/// The quantities that a layer's map must hold for the requested ones: whatever does not depend on the light is in the first
/// layer.
pub fn quantities_of_layer(scene: &PreparedScene, quantities: &[Quantity], layer: usize) -> Vec<Quantity> {
    if scene.components().is_none() {
        return quantities.to_vec();
    }
    let is_wanted = |quantity: &&Quantity| layer == 0 || depends_on_light(quantity);
    let in_layer = |quantity: &Quantity| match quantity {
        Quantity::Color => Quantity::Brightness,
        other => other.clone(),
    };
    quantities.iter().filter(is_wanted).map(in_layer).collect()
}

/// Combines a scene's layers into its map.
///
/// Each scalar channel is the luminance (3.10) of the layers' channels; `color` holds their brightness.
pub fn combined(scene: &PreparedScene, quantities: &[Quantity], mut layers: Vec<Map>) -> Map {
    let Some(components) = scene.components() else { return layers.swap_remove(0) };
    let Ok([red, green, blue]) = <[Map; 3]>::try_from(layers) else { unreachable!("colours have three components") };
    let (weights, layers) = (components.space.luminance_weights(), Rgb { red, green, blue });
    let mut channels: Vec<Channel> = Vec::new();
    for quantity in quantities {
        if channels.iter().any(|channel| channel.quantity == *quantity) {
            continue;
        }
        let made_of = if *quantity == Quantity::Color { &Quantity::Brightness } else { quantity };
        let first = layers.red.channel(made_of).expect("it was asked for");
        let values = match quantity {
            Quantity::Color => color(&layers),
            // Errors of components add up, even where one has a negative weight.
            Quantity::SamplingError => luminances(&layers, quantity, weights.map(|weight| weight.abs())),
            quantity if depends_on_light(quantity) => luminances(&layers, quantity, weights),
            _ => first.values.clone(),
        };
        channels.push(Channel { quantity: quantity.clone(), unit: first.unit.clone(), values });
    }
    let provenance = provenance(scene, layers.red.provenance.renderer.clone());
    Map { provenance, channels, ..layers.red }
}

fn depends_on_light(quantity: &Quantity) -> bool {
    match quantity {
        Quantity::Brightness
        | Quantity::Irradiance
        | Quantity::Ambient
        | Quantity::Diffuse
        | Quantity::Specular
        | Quantity::AmbientError
        | Quantity::SamplingError
        | Quantity::Color
        | Quantity::LightBrightness(_)
        | Quantity::Light(_) => true,
        Quantity::Depth
        | Quantity::Position
        | Quantity::Normal
        | Quantity::Shape
        | Quantity::ZDepth
        | Quantity::CosThetaO
        | Quantity::CameraNormal
        | Quantity::Material
        | Quantity::Samples
        | Quantity::Coverage => false,
    }
}

/// The values of a channel that every layer has.
fn scalars<'m>(layers: &'m Rgb<Map>, quantity: &Quantity) -> Rgb<Scalars<'m>> {
    layers.map(|map| map.scalar(quantity).expect("it was asked for and is one number"))
}

fn luminances(layers: &Rgb<Map>, quantity: &Quantity, weights: Rgb) -> Values {
    match scalars(layers, quantity) {
        Rgb { red: Scalars::Single(red), green: Scalars::Single(green), blue: Scalars::Single(blue) } => {
            let one = |((red, green), blue): ((&f32, &f32), &f32)| {
                let sum = Rgb { red: *red, green: *green, blue: *blue }.map(|value| f64::from(*value));
                // A mean of values that fit single precision, so it fits too.
                #[expect(clippy::cast_possible_truncation, reason = "rounded once, at the end")]
                let rounded = sum.weighted_by(weights) as f32;
                rounded
            };
            Values::Single(red.iter().zip(green).zip(blue).map(one).collect())
        }
        values => {
            let one = |index: usize| values.map(|values| values.at(index)).weighted_by(weights);
            Values::Scalar((0..values.red.len()).map(one).collect())
        }
    }
}

fn color(layers: &Rgb<Map>) -> Values {
    let values = scalars(layers, &Quantity::Brightness);
    let one = |index: usize| values.map(|values| values.at(index)).into_array();
    Values::Vector((0..values.red.len()).map(one).collect())
}
