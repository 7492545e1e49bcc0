//! Random scenes for property tests.

use isophote::camera::Handedness;
use isophote::reflectance::Convention;
use isophote::scene::source::{
    AmbientSource, CameraSource, ConeSource, CuboidSource, CylinderSource, DiskSource, EllipsoidSource, EmissionName,
    LightSource, MaterialSource, PlaneSource, RectangleSource, RotationSource, SceneSource, ScreenSource, SphereSource,
};
use isophote::units::{Keyword, LengthUnit};
use proptest::prelude::*;

/// So many cases, or as many as `PROPTEST_CASES` says. Failures print their scene; no file keeps them.
pub fn config(cases: u32) -> ProptestConfig {
    let default = ProptestConfig::default();
    let cases = if std::env::var_os("PROPTEST_CASES").is_some() { default.cases } else { cases };
    // In a browser's WebAssembly, the system has no random numbers either.
    #[cfg(target_os = "unknown")]
    let default = ProptestConfig { rng_seed: proptest::test_runner::RngSeed::Fixed(super::seed()), ..default };
    ProptestConfig { cases, failure_persistence: None, ..default }
}

/// Scenes of one to four spheres around the origin, seen from outside all of them, lit by one to five lights that stand
/// outside too; in every convention, unit and handedness.
pub fn scenes() -> impl Strategy<Value = SceneSource> {
    let look = (
        direction(),
        5.0..40.0_f64,
        direction(),
        prop::sample::select(Convention::ALL),
        prop::sample::select(LengthUnit::ALL),
        prop::sample::select(Handedness::ALL),
    );
    let spheres = prop::collection::vec((point(1.0), 0.1..1.2_f64, 0_usize..2), 1..=4);
    let lights = prop::collection::vec((direction(), 3.0..12.0_f64, 0.0..100.0_f64, emission(), point(2.0)), 1..=5);
    let materials = [material(), material()];
    (look, spheres, lights, materials)
        .prop_map(|((from, distance, up, convention, length, handedness), spheres, lights, materials)| SceneSource {
            version: Some(1),
            length: Some(length),
            convention: Some(convention),
            handedness: Some(handedness),
            camera: Some(CameraSource {
                eye: Some(from.map(|component| component * distance)),
                target: Some([0.1, -0.2, 0.05]),
                up: Some(up),
                screen: Some(ScreenSource { distance: Some(distance), x: Some([-2.0, 2.0]), y: Some([-1.5, 1.5]) }),
                resolution: Some([32, 24]),
                ..CameraSource::default()
            }),
            material: materials
                .into_iter()
                .enumerate()
                .map(|(index, material)| (format!("m{index}"), material))
                .collect(),
            sphere: spheres
                .into_iter()
                .map(|(center, radius, material)| SphereSource {
                    center: Some(center),
                    radius: Some(radius),
                    material: Some(format!("m{material}")),
                    ..SphereSource::default()
                })
                .collect(),
            light: lights.into_iter().map(light).collect(),
            ..SceneSource::default()
        })
        .prop_filter("up is not along the view", |source| isophote::scene::Scene::try_from(source.clone()).is_ok())
}

/// The numbers from which any shape is made.
type Seed = ([f64; 3], [f64; 3], [f64; 3], [f64; 3], f64, usize);

/// Scenes of two to eight shapes of every kind with shadows, otherwise as [`worlds`]; some have the eye inside a shape.
#[allow(dead_code, reason = "not every file of tests asks for it")]
pub fn solids() -> impl Strategy<Value = SceneSource> {
    let seed =
        (point(1.0), prop::array::uniform3(0.1..1.2_f64), direction(), direction(), -180.0..180.0_f64, 0_usize..2);
    let shapes = prop::collection::vec((seed, 0_usize..8), 2..=8);
    let shadow_less = (0_usize..8, any::<bool>());
    (worlds(), shapes, shadow_less, 0.0..=1.0_f64).prop_filter_map(
        "no light is shut in, or stands on a surface",
        |(mut source, shapes, (without, casts), nearness)| {
            source.shadows = Some(true);
            source.sphere.clear();
            for (seed, kind) in shapes {
                add(&mut source, &seed, kind);
            }
            if let Some(shape) = source.sphere.get_mut(without) {
                shape.shadow.casts_shadow = Some(casts);
                shape.shadow.receives_shadow = Some(!casts);
            }
            let camera = source.camera.get_or_insert_default();
            camera.resolution = Some([20, 15]);
            if nearness < 0.3 {
                camera.eye = camera.eye.map(|eye| eye.map(|coordinate| coordinate * (nearness + 0.01)));
            }
            isophote::scene::Scene::try_from(source.clone()).is_ok().then_some(source)
        },
    )
}

fn add(source: &mut SceneSource, seed: &Seed, kind: usize) {
    let (center, [first, second, third], axis, other, degrees, material) = *seed;
    let material = Some(format!("m{material}"));
    let end = Some([0, 1, 2].map(|index| center[index] + axis[index] * third));
    let rotation = (degrees > 0.0).then_some(RotationSource { axis: Some(axis), degrees: Some(degrees) });
    let (place, sizes, radius) = (Some(center), Some([first, second, third]), Some(first));
    match kind {
        0 => source.sphere.push(SphereSource { center: place, radius, material, ..SphereSource::default() }),
        1 => {
            let shape =
                EllipsoidSource { center: place, radii: sizes, rotation, material, ..EllipsoidSource::default() };
            source.ellipsoid.push(shape);
        }
        2 => {
            let shape = CuboidSource { center: place, size: sizes, rotation, material, ..CuboidSource::default() };
            source.cuboid.push(shape);
        }
        3 => {
            source.cylinder.push(CylinderSource {
                from: place,
                to: end,
                radius,
                material,
                ..CylinderSource::default()
            });
        }
        4 => {
            let apex_radius = (degrees > 0.0).then_some(second);
            let shape = ConeSource { base: place, apex: end, radius, apex_radius, material, ..ConeSource::default() };
            source.cone.push(shape);
        }
        5 => source.plane.push(PlaneSource { point: place, normal: Some(axis), material, ..PlaneSource::default() }),
        6 => source.rectangle.push(RectangleSource {
            center: place,
            normal: Some(axis),
            up: Some(other),
            width: radius,
            height: Some(third),
            material,
            ..RectangleSource::default()
        }),
        _ => source.disk.push(DiskSource {
            center: place,
            normal: Some(axis),
            radius,
            material,
            ..DiskSource::default()
        }),
    }
}

/// The same with parallel lights and ambient light, for what does not ask how a scene behaves when it is made larger.
pub fn worlds() -> impl Strategy<Value = SceneSource> {
    let suns = prop::collection::vec((direction(), 0.0..10.0_f64), 0..=2);
    (scenes(), suns, prop::option::of(0.0..2.0_f64)).prop_map(|(mut source, suns, radiance)| {
        source.light.extend(suns.into_iter().map(|(direction, irradiance)| LightSource {
            emission: Some(EmissionName::Parallel),
            direction: Some(direction),
            irradiance: Some(irradiance.into()),
            ..LightSource::default()
        }));
        source.ambient =
            radiance.map(|radiance| AmbientSource { radiance: Some(radiance.into()), ..AmbientSource::default() });
        source
    })
}

/// Of point lights, with the half angles of a spot.
fn emission() -> impl Strategy<Value = (EmissionName, Option<[f64; 2]>)> {
    prop_oneof![
        Just((EmissionName::Isotropic, None)),
        Just((EmissionName::Lambertian, None)),
        (0.0..60.0_f64, 0.5..30.0_f64).prop_map(|(inner, more)| (EmissionName::Spot, Some([inner, inner + more]))),
    ]
}

type RandomLight = ([f64; 3], f64, f64, (EmissionName, Option<[f64; 2]>), [f64; 3]);

fn light((from, distance, intensity, (emission, angles), target): RandomLight) -> LightSource {
    LightSource {
        position: Some(from.map(|component| component * distance)),
        intensity: Some(intensity.into()),
        emission: Some(emission),
        target: (emission != EmissionName::Isotropic).then_some(target),
        inner_angle: angles.map(|[inner, _]| inner),
        outer_angle: angles.map(|[_, outer]| outer),
        ..LightSource::default()
    }
}

fn material() -> impl Strategy<Value = MaterialSource> {
    (0.0..=1.0_f64, 0.0..=1.0_f64, prop_oneof![(1_u8..100).prop_map(f64::from), 0.1..300.0_f64]).prop_map(
        |(diffuse, specular, shininess)| MaterialSource {
            diffuse: Some(diffuse.into()),
            specular: Some(specular.into()),
            shininess: Some(shininess),
        },
    )
}

fn point(size: f64) -> impl Strategy<Value = [f64; 3]> {
    [-size..size, -size..size, -size..size]
}

/// Unit vectors.
fn direction() -> impl Strategy<Value = [f64; 3]> {
    point(1.0).prop_filter_map("not too short", |vector| {
        let length = vector.iter().map(|component| component * component).sum::<f64>().sqrt();
        (length > 0.1).then(|| vector.map(|component| component / length))
    })
}
