//! Scenes of shapes of every kind, in each other's light and alone.

mod random;

use isophote::conformance::conforms;
use isophote::map::{Map, Quantity, Values};
use isophote::prepare::PreparedScene;
use isophote::render::{ReferenceRenderer, RenderSettings, Renderer};
use isophote::scene::{Scene, SceneSource, Syntax};
use isophote::tolerance::DOUBLE;
use proptest::prelude::*;

fn prepared(source: SceneSource) -> PreparedScene {
    PreparedScene::new(&Scene::try_from(source).unwrap_or_else(|error| panic!("{error}")))
}

fn bits(map: &Map) -> Vec<u64> {
    let scalars = |values: &Values| match values {
        Values::Scalar(values) => values.iter().map(|value| value.to_bits()).collect(),
        _ => Vec::new(),
    };
    map.channels().iter().flat_map(|channel| scalars(&channel.values)).collect()
}

proptest! {
    #![proptest_config(random::config(48))]

    /// Shapes of every kind, that cross each other and stand in each other's light.
    #[test]
    fn random_worlds_are_rendered_within_tolerance(source in random::solids()) {
        let scene = prepared(source);
        let result = conforms(&ReferenceRenderer, &scene, &DOUBLE);
        prop_assert!(result.is_ok(), "{}", result.unwrap_err());
    }
}

/// One shape of each closed kind, alone: nothing else stands in its light, at whatever scale and place.
#[test]
fn a_convex_shape_alone_casts_no_shadow_on_itself() {
    let shapes = [
        "sphere = [{ center = [0, 0, 0], radius = 1 }]",
        "ellipsoid = [{ center = [0, 0, 0], radii = [1, 0.4, 0.7], rotation = { axis = [1, 2, 3], degrees = 40 } }]",
        "box = [{ center = [0, 0, 0], size = [1, 1.5, 0.8], rotation = { axis = [1, 2, 3], degrees = 40 } }]",
        "cylinder = [{ from = [-0.5, -0.3, 0.1], to = [0.5, 0.6, 0.2], radius = 0.5 }]",
        "cone = [{ base = [-0.5, -0.3, 0.1], apex = [0.5, 0.6, 0.2], radius = 0.7 }]",
        "plane = [{ point = [0, 0, 0], normal = [1, 4, 1] }]",
        "rectangle = [{ center = [0, 0, 0], normal = [1, 4, 1], width = 2, height = 1.5 }]",
        "disk = [{ center = [0, 0, 0], normal = [1, 4, 1], radius = 1 }]",
    ];
    for shape in shapes {
        for (scale, place) in [(1.0, 0.0), (1e-6, 0.0), (1e6, 0.0), (1.0, 1e6)] {
            let text = format!(
                "version = 1\nlength = \"m\"\nconvention = \"irradiance\"\n{shape}\n\
                 light = [{{ position = [3, 4, 1], intensity = 5 }}, {{ position = [-2, 0.7, 1], intensity = 5 }}]\n\
                 [camera]\neye = [1, 2, 5]\ntarget = [0, 0, 0]\nresolution = [61, 47]\n\
                 screen = {{ distance = 1, x = [-0.3, 0.3], y = [-0.23, 0.23] }}\n",
            );
            let scene = Scene::from_text("alone", &text, Syntax::Toml).unwrap_or_else(|error| panic!("{error}"));
            let source = moved(scene.source().clone(), scale, place);
            let maps = [true, false].map(|shadows| {
                let scene = prepared(SceneSource { shadows: Some(shadows), ..source.clone() });
                let settings = RenderSettings { quantities: vec![Quantity::Irradiance], ..RenderSettings::default() };
                ReferenceRenderer.render(&scene, &settings).expect("it renders")
            });
            assert!(bits(&maps[0]) == bits(&maps[1]), "{shape} at scale {scale}, {place} away");
            let seen = maps[0].mask().shapes().iter().filter(|shape| **shape == 0).count();
            assert!(seen > 100, "{shape} at scale {scale}, {place} away: {seen} pixels");
        }
    }
}

/// The same scene in other places and sizes.
fn moved(mut source: SceneSource, scale: f64, place: f64) -> SceneSource {
    let point = |point: &mut Option<[f64; 3]>| {
        *point = point.map(|[x, y, z]| [x * scale + place, y * scale - place, z * scale + 0.5 * place]);
    };
    let length = |length: &mut Option<f64>| *length = length.map(|length| length * scale);
    let lengths =
        |lengths: &mut Option<[f64; 3]>| *lengths = lengths.map(|lengths| lengths.map(|length| length * scale));
    let camera = source.camera.get_or_insert_default();
    point(&mut camera.eye);
    point(&mut camera.target);
    for light in &mut source.light {
        point(&mut light.position);
    }
    for shape in &mut source.sphere {
        point(&mut shape.center);
        length(&mut shape.radius);
    }
    for shape in &mut source.ellipsoid {
        point(&mut shape.center);
        lengths(&mut shape.radii);
    }
    for shape in &mut source.cuboid {
        point(&mut shape.center);
        lengths(&mut shape.size);
    }
    for shape in &mut source.cylinder {
        point(&mut shape.from);
        point(&mut shape.to);
        length(&mut shape.radius);
    }
    for shape in &mut source.cone {
        point(&mut shape.base);
        point(&mut shape.apex);
        length(&mut shape.radius);
    }
    for shape in &mut source.plane {
        point(&mut shape.point);
    }
    for shape in &mut source.rectangle {
        point(&mut shape.center);
        length(&mut shape.width);
        length(&mut shape.height);
    }
    for shape in &mut source.disk {
        point(&mut shape.center);
        length(&mut shape.radius);
    }
    source
}
