//! Many spheres, and shadows between them: drawn tile by tile, and found in the tree, against brute force and 32 digits.

mod random;

use isophote::conformance::conforms;
use isophote::lanes::{Instructions, Precision};
use isophote::map::{Map, Pixel, Quantity, Region, Resolution, Scalars};
use isophote::prepare::PreparedScene;
use isophote::render::{ReferenceRenderer, RenderSettings, Renderer, SimdRenderer};
use isophote::scene::Scene;
use isophote::scene::source::{
    ConeSource, CuboidSource, CylinderSource, DiskSource, EllipsoidSource, PlaneSource, RectangleSource,
    RotationSource, SceneSource, SphereSource,
};
use isophote::tolerance::{DOUBLE, SINGLE};
use proptest::prelude::*;

fn prepared(source: SceneSource) -> PreparedScene {
    PreparedScene::new(&Scene::try_from(source).unwrap_or_else(|error| panic!("{error}")))
}

/// The random scenes of other tests with more spheres, of all sizes, many of which cross or hide each other; with
/// shadows or without.
fn clouds(most: usize) -> impl Strategy<Value = SceneSource> {
    let sphere = (prop::array::uniform3(-1.2..1.2_f64), -2.5..0.0_f64, 0_usize..2);
    (random::scenes(), prop::collection::vec(sphere, 65..most), any::<bool>()).prop_map(
        |(mut source, spheres, shadows)| {
            source.sphere = spheres
                .into_iter()
                .map(|(center, size, material)| SphereSource {
                    center: Some(center),
                    radius: Some(0.6 * 10.0_f64.powf(size)),
                    material: Some(format!("m{material}")),
                    ..SphereSource::default()
                })
                .collect();
            source.shadows = Some(shadows);
            source
        },
    )
}

/// Few spheres with shadows, as tiles see them.
fn shadows() -> impl Strategy<Value = SceneSource> {
    random::scenes().prop_map(|source| SceneSource { shadows: Some(true), ..source })
}

fn settings() -> RenderSettings<'static> {
    RenderSettings { quantities: Quantity::COMMON.to_vec(), ..RenderSettings::default() }
}

fn brightness(map: &Map) -> Scalars<'_> {
    map.scalar(&Quantity::Brightness).expect("it was asked for")
}

fn is_valid(source: &SceneSource) -> bool {
    Scene::try_from(source.clone()).is_ok()
}

proptest! {
    #![proptest_config(random::config(48))]

    #[test]
    fn random_clouds_are_rendered_within_tolerance(source in clouds(200)) {
        prop_assume!(is_valid(&source));
        let scene = prepared(source).by_brute_force();
        let result = conforms(&SimdRenderer::new(Precision::Double, None), &scene, &DOUBLE);
        prop_assert!(result.is_ok(), "{}", result.unwrap_err());
        let result = conforms(&SimdRenderer::new(Precision::Single, None), &scene, &SINGLE);
        prop_assert!(result.is_ok(), "single: {}", result.unwrap_err());
    }

    #[test]
    fn random_shadows_are_rendered_within_tolerance(source in shadows()) {
        let scene = prepared(source).by_brute_force();
        for instructions in Instructions::all() {
            let lanes = |precision| SimdRenderer::new(precision, None).with_instructions(instructions);
            let result = conforms(&lanes(Precision::Double), &scene, &DOUBLE);
            prop_assert!(result.is_ok(), "{}: {}", instructions.name(), result.unwrap_err());
            let result = conforms(&lanes(Precision::Single), &scene, &SINGLE);
            prop_assert!(result.is_ok(), "single, {}: {}", instructions.name(), result.unwrap_err());
        }
    }

    /// Bytes do not depend on the number of threads, and a region is a part of the whole.
    #[test]
    fn threads_and_regions_change_nothing(
        source in clouds(120),
        threads in 1_usize..5,
        corner in (0_u32..160, 0_u32..120),
        size in (1_u32..160, 1_u32..120),
        is_single in any::<bool>(),
    ) {
        prop_assume!(is_valid(&source));
        let mut source = source;
        source.camera.get_or_insert_default().resolution = Some([160, 120]);
        let scene = prepared(source);
        let precision = if is_single { Precision::Single } else { Precision::Double };
        let renderer = |threads: usize| SimdRenderer::new(precision, threads.try_into().ok());
        let whole = renderer(1).render(&scene, &settings()).expect("it renders");
        let region = Region {
            corner: Pixel { column: corner.0, row: corner.1 },
            size: Resolution { width: size.0.min(160 - corner.0), height: size.1.min(120 - corner.1) },
        };
        let settings = RenderSettings { region: Some(region), ..settings() };
        let part = renderer(threads).render(&scene, &settings).expect("it renders");
        let (shapes, shapes_of_whole) = (part.mask().shapes(), whole.mask().shapes());
        for (index, shape) in shapes.into_iter().enumerate() {
            let Pixel { column, row } = part.pixel(index);
            let in_whole = row as usize * 160 + column as usize;
            prop_assert_eq!(shape, shapes_of_whole[in_whole]);
            let [found, expected] = [brightness(&part).at(index), brightness(&whole).at(in_whole)];
            prop_assert_eq!(found.to_bits(), expected.to_bits(), "column {}, row {}", column, row);
        }
    }

    /// The same hits and the same shadows, bit by bit, over scenes of every kind of shape.
    #[test]
    fn the_tree_finds_what_brute_force_finds(
        source in clouds(66),
        places in prop::collection::vec((prop::array::uniform3(-2.0..2.0_f64), prop::array::uniform3(-1.0..1.0_f64)), 9),
        sizes in prop::array::uniform3(0.05..0.6_f64),
    ) {
        let source = with_every_shape(source, &places, sizes);
        prop_assume!(is_valid(&source));
        let scene = prepared(source);
        let found = ReferenceRenderer.render(&scene, &settings()).expect("it renders");
        let expected = ReferenceRenderer.render(&scene.by_brute_force(), &settings()).expect("it renders");
        prop_assert!(found == expected);
    }
}

/// Adds a shape of each kind; a pair of places for each.
fn with_every_shape(source: SceneSource, places: &[([f64; 3], [f64; 3])], sizes: [f64; 3]) -> SceneSource {
    let material = Some("m0".to_owned());
    let place = |index: usize| Some(places[index].0);
    let direction = |index: usize| Some(places[index].1);
    let end = |index: usize| Some([0, 1, 2].map(|axis| places[index].0[axis] + places[index].1[axis]));
    let rotation = |index: usize| Some(RotationSource { axis: direction(index), degrees: Some(50.0) });
    let [first, second, _] = sizes.map(Some);
    let ellipsoid = EllipsoidSource {
        center: place(0),
        radii: Some(sizes),
        rotation: rotation(0),
        material: material.clone(),
        ..EllipsoidSource::default()
    };
    let cuboid = CuboidSource {
        center: place(1),
        size: Some(sizes),
        rotation: rotation(1),
        material: material.clone(),
        ..CuboidSource::default()
    };
    let cylinder = CylinderSource {
        from: place(2),
        to: end(2),
        radius: first,
        material: material.clone(),
        ..CylinderSource::default()
    };
    let cone =
        ConeSource { base: place(3), apex: end(3), radius: first, material: material.clone(), ..ConeSource::default() };
    let plane =
        PlaneSource { point: place(4), normal: direction(4), material: material.clone(), ..PlaneSource::default() };
    let rectangle = RectangleSource {
        center: place(5),
        normal: direction(5),
        up: Some([0.3, 0.5, 0.7]),
        width: first,
        height: second,
        material: material.clone(),
        ..RectangleSource::default()
    };
    let disk = DiskSource { center: place(6), normal: direction(6), radius: first, material, ..DiskSource::default() };
    SceneSource {
        ellipsoid: vec![ellipsoid],
        cuboid: vec![cuboid],
        cylinder: vec![cylinder],
        cone: vec![cone],
        plane: vec![plane],
        rectangle: vec![rectangle],
        disk: vec![disk],
        ..source
    }
}

/// A wall of spheres near the eye, some beside it and behind it: their outlines are no ellipses.
#[test]
fn spheres_beside_the_eye_are_seen_as_by_rays() {
    let mut text = String::from(
        "version = 1\nlength = \"m\"\nconvention = \"lab\"\nshadows = true
        camera = { eye = [0, 0, 0], forward = [0, 0, 1], resolution = [70, 50], screen = { distance = 1, x = [-3, 3], y = [-2, 2] } }
        material.clay = { diffuse = 0.7, specular = 0.3, shininess = 20 }
        light = [{ position = [0.1, 0.2, 0.05], intensity = 3 }, { position = [0, 9, 0], intensity = 50 }]\n",
    );
    for index in 0..100 {
        let (turn, z) = (f64::from(index) * 2.4, f64::from(index) * 0.03 - 0.5);
        let center = format!("[{}, {}, {z}]", turn.cos(), turn.sin());
        text.extend(["[[sphere]]\ncenter = ", &center, "\nradius = 0.4\nmaterial = \"clay\"\n"]);
    }
    let scene =
        Scene::from_text("wall", &text, isophote::scene::Syntax::Toml).unwrap_or_else(|error| panic!("{error}"));
    let scene = PreparedScene::new(&scene).by_brute_force();
    let deviation = conforms(&SimdRenderer::new(Precision::Double, None), &scene, &DOUBLE);
    assert!(deviation.unwrap_or_else(|error| panic!("{error}")).visible > 500);
}
