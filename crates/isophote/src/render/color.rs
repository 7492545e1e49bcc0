//! Maps of scenes with colours: three maps of single numbers, put together.

use super::share::Share;
use super::{Observer, RenderError, RenderSettings, band};
use crate::color::{Component, Rgb};
use crate::map::{Channel, Map, Mask, Quantity, Scalars, Values};
use crate::prepare::PreparedScene;
use crate::units::Keyword;

/// The map of a scene whose components `compute` makes maps of; of a scene without colours its only map.
///
/// Each channel of one number is the luminance (3.10) of the components' channels, `color` holds their brightness.
/// What does not depend on the component is that of the first one, if they see the same; else, where pixels are refined
/// by their brightness, that of the one with the most rays through the pixel.
pub fn map_of_components<E>(
    scene: &PreparedScene,
    quantities: &[Quantity],
    sees_the_same: bool,
    mut compute: impl FnMut(&PreparedScene, &[Quantity]) -> Result<Map, E>,
) -> Result<Map, E> {
    let Some(components) = scene.components() else { return compute(scene, quantities) };
    let weights = components.space.luminance_weights();
    let mut compute = |component| compute(components.of(component), &wanted(quantities, component, sees_the_same));
    let (red, green, blue) = (compute(Component::Red)?, compute(Component::Green)?, compute(Component::Blue)?);
    let mut map = combined(Rgb { red, green, blue }, quantities, weights, sees_the_same);
    map.provenance = band::provenance(scene, map.provenance.renderer);
    Ok(map)
}

/// Renders a scene, component by component if it has colours.
pub fn render(
    scene: &PreparedScene,
    settings: &RenderSettings<'_>,
    render: impl Fn(&PreparedScene, &RenderSettings<'_>) -> Result<Map, RenderError>,
) -> Result<Map, RenderError> {
    if scene.components().is_none() {
        return render(scene, settings);
    }
    let share = settings.observer.map(|whole| Share::new(whole, 3));
    let observer = share.as_ref().map(|share| share as &dyn Observer);
    let sees_the_same = scene.scene().sampling().tolerance.is_none();
    map_of_components(scene, &settings.quantities, sees_the_same, |scene, quantities| {
        render(scene, &RenderSettings { region: settings.region, quantities: quantities.to_vec(), observer })
    })
}

/// What a component's map has to hold for these quantities.
fn wanted(quantities: &[Quantity], component: Component, sees_the_same: bool) -> Vec<Quantity> {
    let has_geometry = component == Component::Red || !sees_the_same;
    let is_wanted = |quantity: &&Quantity| has_geometry || depends_on_component(quantity);
    let in_component = |quantity: &Quantity| match quantity {
        Quantity::Color => Quantity::Brightness,
        other => other.clone(),
    };
    let sampled = (!sees_the_same).then_some(Quantity::Samples);
    quantities.iter().filter(is_wanted).map(in_component).chain(sampled).collect()
}

fn depends_on_component(quantity: &Quantity) -> bool {
    match quantity {
        Quantity::Brightness
        | Quantity::Irradiance
        | Quantity::Ambient
        | Quantity::Diffuse
        | Quantity::Specular
        | Quantity::AmbientError
        | Quantity::Color
        | Quantity::Light(_) => true,
        Quantity::Depth
        | Quantity::Position
        | Quantity::Normal
        | Quantity::Shape
        | Quantity::Samples
        | Quantity::Coverage => false,
    }
}

fn combined(mut maps: Rgb<Map>, quantities: &[Quantity], weights: Rgb, sees_the_same: bool) -> Map {
    let seen_by = (!sees_the_same).then(|| seen_by(&maps));
    let mut channels: Vec<Channel> = Vec::new();
    for quantity in quantities {
        if channels.iter().any(|channel| channel.quantity == *quantity) {
            continue;
        }
        let made_of = if *quantity == Quantity::Color { &Quantity::Brightness } else { quantity };
        let unit = maps.red.channel(made_of).expect("it was asked for").unit.clone();
        let values = match (quantity, &seen_by) {
            (Quantity::Color, _) => color(&maps),
            (quantity, _) if depends_on_component(quantity) => luminances(&maps, quantity, weights),
            (quantity, Some(seen_by)) => picked(&maps, quantity, seen_by),
            (quantity, None) => maps.red.channel(quantity).expect("it was asked for").values.clone(),
        };
        channels.push(Channel { quantity: quantity.clone(), unit, values });
    }
    if let Some(seen_by) = seen_by {
        let shapes = maps.map(|map| map.mask.shapes());
        let shapes: Vec<i32> = pick(&seen_by, &shapes.map(Vec::as_slice));
        maps.red.mask = Mask::of_shapes(maps.red.region.size, &shapes);
    }
    Map { channels, ..maps.red }
}

/// Which component sent the most rays through each pixel, the first of several; or is the only one that sees anything
/// there, by a filter that reaches beyond the pixel.
fn seen_by(maps: &Rgb<Map>) -> Vec<Component> {
    let samples = scalars(maps, &Quantity::Samples);
    let shapes = maps.map(|map| map.mask.shapes());
    let most = |index: usize| {
        let score = |component| (samples.of(component).at(index), shapes.of(component)[index] >= 0);
        let larger = |best, next| if score(next) > score(best) { next } else { best };
        Component::ALL.iter().copied().fold(Component::Red, larger)
    };
    (0..samples.red.len()).map(most).collect()
}

/// The values of a channel that every component's map has.
fn scalars<'m>(maps: &'m Rgb<Map>, quantity: &Quantity) -> Rgb<Scalars<'m>> {
    maps.map(|map| map.scalar(quantity).expect("it was asked for and is one number"))
}

fn luminances(maps: &Rgb<Map>, quantity: &Quantity, weights: Rgb) -> Values {
    match scalars(maps, quantity) {
        Rgb { red: Scalars::Single(red), green: Scalars::Single(green), blue: Scalars::Single(blue) } => {
            let one = |((red, green), blue): ((&f32, &f32), &f32)| {
                let sum = Rgb { red: *red, green: *green, blue: *blue }.map(|value| f64::from(*value));
                // A mean of what single precision holds, which it holds too.
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

fn color(maps: &Rgb<Map>) -> Values {
    let values = scalars(maps, &Quantity::Brightness);
    let one = |index: usize| values.map(|values| values.at(index)).into_array();
    Values::Vector((0..values.red.len()).map(one).collect())
}

/// A channel of geometry or sampling, at each pixel that of one component.
fn picked(maps: &Rgb<Map>, quantity: &Quantity, seen_by: &[Component]) -> Values {
    match maps.map(|map| &map.channel(quantity).expect("it was asked for").values) {
        Rgb { red: Values::Scalar(red), green: Values::Scalar(green), blue: Values::Scalar(blue) } => {
            Values::Scalar(pick(seen_by, &Rgb { red, green, blue }))
        }
        Rgb { red: Values::Vector(red), green: Values::Vector(green), blue: Values::Vector(blue) } => {
            Values::Vector(pick(seen_by, &Rgb { red, green, blue }))
        }
        Rgb { red: Values::Index(red), green: Values::Index(green), blue: Values::Index(blue) } => {
            Values::Index(pick(seen_by, &Rgb { red, green, blue }))
        }
        _ => unreachable!("what is no light is double in every component"),
    }
}

fn pick<T: Copy>(seen_by: &[Component], values: &Rgb<&[T]>) -> Vec<T> {
    seen_by.iter().enumerate().map(|(index, component)| values.of(*component)[index]).collect()
}
