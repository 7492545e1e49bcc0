//! Scenes with colours (docs/physics.md, 3.10): each component is a scene of single numbers.

mod random;

use std::num::NonZeroUsize;

use isophote::analysis::probe::{ProbePosition, ProbeReading};
use isophote::analysis::section::SectionLine;
use isophote::analysis::surface::SurfaceRequest;
use isophote::color::{ColorSpace, Component, Rgb};
use isophote::lanes::Precision;
use isophote::map::{Map, Pixel, Quantity, Region, Resolution, Values};
use isophote::prepare::PreparedScene;
use isophote::render::{ReferenceRenderer, RenderError, RenderSettings, Renderer, SimdRenderer};
use isophote::scene::source::{Amount, SamplingSource};
use isophote::scene::{Scene, SceneSource, Syntax};
use isophote::shape::{Primitive, Side};
use isophote::units::Keyword;
use isophote::vector::Vector;
use proptest::prelude::*;

/// A ball between two lights over a table, in front of the eye.
const SCENE: &str = r#"
version = 1
length = "m"
convention = "radiance"
shadows = true
camera = { eye = [0, 0, -6], forward = [0, 0, 1], screen = { distance = 6, x = [-2, 2], y = [-1.5, 1.5] }, resolution = [40, 30] }
ambient = { radiance = 0.25, obstructed = true, samples = 16 }

[material.ball]
diffuse = 0.5
specular = 0.25
shininess = 20

[material.table]
diffuse = 0.75

[[sphere]]
name = "ball"
center = [0, 0, 0]
radius = 1
material = "ball"

[[box]]
center = [0, -1.5, 0]
size = [6, 1, 6]
material = "table"

[[light]]
name = "lamp"
position = [3, 4, -5]
intensity = 100

[[light]]
name = "sun"
emission = "parallel"
direction = [1, -2, 1]
irradiance = 2
"#;

fn source() -> SceneSource {
    Scene::from_text("test", SCENE, Syntax::Toml).unwrap_or_else(|error| panic!("{error}")).source().clone()
}

/// The scene with other amounts.
fn with_amounts(mut source: SceneSource, change: impl Fn(Amount) -> Amount) -> SceneSource {
    for material in source.material.values_mut() {
        material.diffuse = material.diffuse.map(&change);
        material.specular = material.specular.map(&change);
    }
    for light in &mut source.light {
        for amount in [&mut light.intensity, &mut light.power, &mut light.irradiance] {
            *amount = amount.map(&change);
        }
    }
    if let Some(ambient) = &mut source.ambient {
        ambient.radiance = ambient.radiance.map(&change);
    }
    source
}

/// Every number as three of it.
fn tripled(amount: Amount) -> Amount {
    Amount::Rgb(Component::ALL.iter().map(|component| amount.of(*component)).collect::<Vec<_>>().try_into().unwrap())
}

/// Some colour of each number: where it was even, it is not any more.
fn dyed(amount: Amount) -> Amount {
    let number = amount.of(Component::Red);
    Amount::Rgb([number, 0.3 * number, number * number / (1.0 + number)])
}

fn prepared(source: SceneSource) -> PreparedScene {
    PreparedScene::new(&Scene::try_from(source).unwrap_or_else(|error| panic!("{error}")))
}

/// The scene of single numbers that a component is.
fn of_component(source: &SceneSource, component: Component) -> SceneSource {
    with_amounts(SceneSource { color_space: None, ..source.clone() }, |amount| Amount::Number(amount.of(component)))
}

fn light_quantities() -> Vec<Quantity> {
    let light = |name: &str| Quantity::Light(name.into());
    let parts = [Quantity::Diffuse, Quantity::Specular, Quantity::Ambient, Quantity::AmbientError];
    [Quantity::Brightness, Quantity::Irradiance].into_iter().chain(parts).chain([light("lamp"), light("sun")]).collect()
}

fn render(renderer: &dyn Renderer, scene: &PreparedScene, quantities: &[Quantity]) -> Map {
    let settings = RenderSettings { quantities: quantities.to_vec(), ..RenderSettings::default() };
    renderer.render(scene, &settings).expect("it renders")
}

fn colors(map: &Map) -> &[[f64; 3]] {
    let Values::Vector(colors) = &map.channel(&Quantity::Color).expect("asked for").values else {
        panic!("three numbers a pixel")
    };
    colors
}

fn renderers() -> [Box<dyn Renderer>; 3] {
    let two = NonZeroUsize::new(2);
    [
        Box::new(ReferenceRenderer),
        Box::new(SimdRenderer::new(Precision::Double, two)),
        Box::new(SimdRenderer::new(Precision::Single, two)),
    ]
}

#[test]
fn equal_components_are_the_scene_of_single_numbers() {
    let plain = prepared(source());
    let coloured = prepared(with_amounts(source(), tripled));
    for renderer in renderers() {
        let expected = render(&*renderer, &plain, &light_quantities());
        let mut quantities = light_quantities();
        quantities.push(Quantity::Color);
        let map = render(&*renderer, &coloured, &quantities);
        assert_eq!(map.mask(), expected.mask());
        let brightness = expected.scalar(&Quantity::Brightness).unwrap();
        for (index, color) in colors(&map).iter().enumerate() {
            assert_eq!(*color, [brightness.at(index); 3]);
        }
        let bound = if matches!(map.channels()[0].values, Values::Single(_)) { f64::from(f32::EPSILON) } else { 1e-15 };
        for quantity in light_quantities() {
            let [found, expected] = [&map, &expected].map(|map| map.scalar(&quantity).unwrap());
            for (found, expected) in found.iter().zip(expected.iter()) {
                assert!((found - expected).abs() <= bound * expected, "{}: {found} {expected}", quantity.name());
            }
        }
    }
}

#[test]
fn a_component_with_twice_the_light_is_twice_as_bright() {
    let mut source = source();
    source.ambient.as_mut().unwrap().radiance = Some(Amount::Rgb([0.5, 0.25, 0.0]));
    source.light[0].intensity = Some(Amount::Rgb([200.0, 100.0, 0.0]));
    source.light[1].irradiance = Some(Amount::Rgb([4.0, 2.0, 0.0]));
    let scene = prepared(source);
    for renderer in renderers() {
        for [red, green, blue] in colors(&render(&*renderer, &scene, &[Quantity::Color])) {
            assert_eq!((*red, *blue), (2.0 * green, 0.0));
        }
    }
}

#[test]
fn a_red_ball_sends_no_green_and_no_blue_of_white_light() {
    let mut source = source();
    let ball = source.material.get_mut("ball").unwrap();
    (ball.diffuse, ball.specular) = (Some(Amount::Rgb([0.5, 0.0, 0.0])), Some(Amount::Rgb([0.25, 0.0, 0.0])));
    let scene = prepared(source);
    let map = render(&ReferenceRenderer, &scene, &[Quantity::Color, Quantity::Brightness]);
    let seen = |index| map.mask().shape_at(index);
    let (mut balls, mut tables) = (0, 0);
    for (index, [red, green, blue]) in colors(&map).iter().copied().enumerate() {
        match seen(index) {
            Some(0) => {
                balls += usize::from(red > 0.0);
                assert_eq!([green, blue], [0.0; 2]);
                let luminance = map.scalar(&Quantity::Brightness).unwrap().at(index);
                assert!((luminance - 0.212_639_005_871_510_36 * red).abs() <= 1e-15 * red, "{luminance} {red}");
            }
            Some(_) => {
                tables += usize::from(red > 0.0);
                assert_eq!([green, blue], [red; 2]);
            }
            None => assert_eq!([red, green, blue], [0.0; 3]),
        }
    }
    assert!(balls > 50 && tables > 50, "{balls} {tables}");
}

/// E = I/r² straight below a lamp, B = k_d E/π (3.6) in each component, Y = Σ w B (3.10).
#[test]
fn below_a_lamp_each_component_has_its_closed_form() {
    let text = r#"
        version = 1
        length = "m"
        color_space = "rec2020"
        camera = { eye = [0, 5, -5], target = [0, 0, 0], screen = { distance = 5, x = [-1, 1], y = [-1, 1] } }
        material.floor.diffuse = [0.5, 0.25, 0.125]
        plane = [{ point = [0, 0, 0], normal = [0, 1, 0], material = "floor" }]
        light = [{ position = [0, 2, 0], intensity = [4, 8, 16] }]
    "#;
    let scene = PreparedScene::new(&Scene::from_text("test", text, Syntax::Toml).unwrap());
    let reading = scene.probe(&ProbePosition::Point(Vector::default())).unwrap();
    let readings = reading.components.as_deref().expect("it has colours");
    assert_eq!(readings.map(|reading| reading.shading.irradiance).into_array(), [1.0, 2.0, 4.0]);
    let expected = 0.5 / std::f64::consts::PI;
    let close = |found: f64, expected: f64| assert!((found / expected - 1.0).abs() < 1e-15, "{found} {expected}");
    for brightness in readings.map(|reading| reading.shading.brightness()).into_array() {
        close(brightness, expected);
    }
    close(reading.shading.brightness(), expected);
    let Rgb { red, green, blue } = ColorSpace::Rec2020.luminance_weights();
    close(reading.shading.irradiance, red + 2.0 * green + 4.0 * blue);
    close(reading.terms[0].intensity, 4.0 * (red + 2.0 * green + 4.0 * blue));
    let [diffuse, specular] = reading.light_shares(&scene, 0);
    close(diffuse, expected);
    assert_eq!(specular, 0.0);
}

fn assert_components(source: &SceneSource, renderer: &dyn Renderer) {
    let quantities = [Quantity::Color, Quantity::Shape, Quantity::Depth];
    let map = render(renderer, &prepared(source.clone()), &quantities);
    for component in Component::ALL {
        let wanted = [Quantity::Brightness, Quantity::Shape, Quantity::Depth];
        let expected = render(renderer, &prepared(of_component(source, *component)), &wanted);
        let brightness = expected.scalar(&Quantity::Brightness).unwrap();
        for (index, color) in colors(&map).iter().enumerate() {
            let found = *Rgb::from(*color).of(*component);
            assert_eq!(found.to_bits(), brightness.at(index).to_bits(), "{} at {index}", component.name());
        }
        assert_eq!(map.mask(), expected.mask());
        assert_eq!(map.channel(&Quantity::Shape), expected.channel(&Quantity::Shape));
    }
}

proptest! {
    #![proptest_config(random::config(8))]

    #[test]
    fn a_component_is_the_scene_of_its_numbers_among_spheres(source in random::scenes()) {
        for renderer in renderers() {
            assert_components(&with_amounts(source.clone(), dyed), &*renderer);
        }
    }

    #[test]
    fn a_component_is_the_scene_of_its_numbers_among_solids(source in random::solids()) {
        for renderer in renderers() {
            assert_components(&with_amounts(source.clone(), dyed), &*renderer);
        }
    }
}

/// A pixel gets the samples that its most demanding component needs. Where that is as many as a component gets alone, its
/// value is that of its own scene; elsewhere both are within the tolerance.
#[test]
fn refined_components_are_those_of_their_own_scenes_within_the_tolerance() {
    const TOLERANCE: f64 = 0.01;
    let mut source = with_amounts(source(), dyed);
    source.sampling = Some(SamplingSource { tolerance: Some(TOLERANCE), ..SamplingSource::default() });
    let renderer = SimdRenderer::new(Precision::Double, NonZeroUsize::new(2));
    let quantities = [Quantity::Color, Quantity::Samples, Quantity::Coverage, Quantity::Position, Quantity::Shape];
    let map = render(&renderer, &prepared(source.clone()), &quantities);
    let samples: Vec<f64> = map.scalar(&Quantity::Samples).unwrap().iter().collect();
    let (mut same, mut more) = (0, 0);
    for component in Component::ALL {
        let wanted = [Quantity::Brightness, Quantity::Samples];
        let expected = render(&renderer, &prepared(of_component(&source, *component)), &wanted);
        let brightness = expected.scalar(&Quantity::Brightness).unwrap();
        let peak = brightness.iter().fold(0.0, f64::max);
        for (index, samples) in samples.iter().enumerate() {
            let (found, alone) = (*Rgb::from(colors(&map)[index]).of(*component), brightness.at(index));
            if *samples == expected.scalar(&Quantity::Samples).unwrap().at(index) {
                assert_eq!(found, alone, "{index}");
                same += u32::from(*samples > 1.0);
            } else {
                assert!((found - alone).abs() <= TOLERANCE * peak, "{index}: {found} {alone}");
                more += 1;
            }
        }
    }
    assert!(same > 10 && more > 10, "{same} {more}");
}

#[test]
fn a_part_of_an_image_and_any_number_of_threads_give_the_same_bytes() {
    let scene = prepared(with_amounts(source(), dyed));
    let quantities = vec![Quantity::Color, Quantity::Brightness, Quantity::Normal];
    let whole = render(&SimdRenderer::new(Precision::Double, NonZeroUsize::new(1)), &scene, &quantities);
    assert_eq!(whole, render(&SimdRenderer::new(Precision::Double, NonZeroUsize::new(3)), &scene, &quantities));
    let region = Region { corner: Pixel { column: 7, row: 5 }, size: Resolution { width: 20, height: 9 } };
    let settings = RenderSettings { region: Some(region), quantities, ..RenderSettings::default() };
    let part = SimdRenderer::new(Precision::Double, None).render(&scene, &settings).unwrap();
    for index in 0..region.size.pixels() {
        let Pixel { column, row } = part.pixel(index);
        assert_eq!(colors(&part)[index], colors(&whole)[row as usize * 40 + column as usize]);
    }
}

#[test]
fn probes_sections_and_surfaces_have_the_luminance_of_the_map() {
    let scene = prepared(with_amounts(source(), dyed));
    let map = render(&ReferenceRenderer, &scene, &[Quantity::Brightness, Quantity::Color]);
    let section = scene.section(SectionLine::Row(12)).unwrap();
    let brightness = map.scalar(&Quantity::Brightness).unwrap();
    for (column, sample) in (0..40_u32).zip(section) {
        let index = 12 * 40 + column as usize;
        let expected = brightness.at(index);
        let found = sample.seen.map_or(0.0, |(_, shading)| shading.brightness());
        assert!((found - expected).abs() <= 4e-16 * expected, "{found} {expected}");
        let Ok(reading) = scene.probe(&ProbePosition::Pixel(Pixel { column, row: 12 })) else { continue };
        let ProbeReading { components: Some(readings), .. } = &reading else { panic!("it has colours") };
        assert_eq!(readings.map(|reading| reading.shading.brightness()).into_array(), colors(&map)[index]);
        assert!((reading.shading.brightness() - expected).abs() <= 4e-16 * expected);
    }
    let request = SurfaceRequest {
        primitive: Primitive { shape: 0, part: 0 },
        projection: isophote::analysis::surface::SurfaceProjection::EqualArea,
        axis: None,
        side: Side::Front,
        size: Some(Resolution { width: 12, height: 6 }),
    };
    let surface = scene.surface(&request).unwrap();
    let map = surface.map(&[Quantity::Color, Quantity::Brightness]).unwrap();
    let weights = ColorSpace::Rec709.luminance_weights();
    for (color, luminance) in colors(&map).iter().zip(map.scalar(&Quantity::Brightness).unwrap().iter()) {
        assert_eq!(Rgb::from(*color).weighted_by(weights), luminance);
    }
    assert_eq!(map.provenance.color_space.as_deref(), Some("rec709"));
}

#[test]
fn a_scene_without_colours_has_no_channel_of_them() {
    let scene = prepared(source());
    let settings = RenderSettings { quantities: vec![Quantity::Color], ..RenderSettings::default() };
    assert_eq!(ReferenceRenderer.render(&scene, &settings).unwrap_err(), RenderError::NoColor);
    assert_eq!(render(&ReferenceRenderer, &scene, &[Quantity::Brightness]).provenance.color_space, None);
}

#[test]
fn the_source_of_a_map_is_the_scene_with_its_colours() {
    let source = SceneSource { color_space: Some(ColorSpace::AcesCg), ..with_amounts(source(), dyed) };
    let map = render(&ReferenceRenderer, &prepared(source.clone()), &[Quantity::Color]);
    let again = Scene::from_text("again", &map.provenance.scene, Syntax::Toml).unwrap();
    assert_eq!(*again.source(), source);
    assert_eq!(map.provenance.color_space.as_deref(), Some("aces-cg"));
}
