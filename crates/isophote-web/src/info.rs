//! What there is to know of a valid scene.

use isophote::camera::Projection;
use isophote::light::{Emission, LightKind};
use isophote::map::{Quantity, Region};
use isophote::prepare::PreparedScene;
use isophote::scene::{Scene, SceneSource};
use isophote::units::Keyword;
use isophote::vector::Vector;
use serde::Serialize;

use crate::request::{Edges, in_unit};

/// Lights that the page is told of one by one; a list of more would be no help, and would take it long.
pub const MOST_LIGHTS: usize = 60;

#[derive(Serialize)]
#[serde(rename_all = "camelCase")]
pub struct SceneInfo {
    title: String,
    length: &'static str,
    screen_unit: &'static str,
    convention: ConventionInfo,
    units: Units,
    resolution: [u32; 2],
    window: Edges,
    camera: CameraInfo,
    shapes: Vec<ShapeInfo>,
    /// The first [`MOST_LIGHTS`].
    lights: Vec<LightInfo>,
    materials: Vec<String>,
    probes: Vec<String>,
    areas: Vec<String>,
    grids: Vec<String>,
    shadows: bool,
    has_ambient: bool,
    has_colors: bool,
    channels: Vec<String>,
}

#[derive(Serialize)]
struct ConventionInfo {
    name: &'static str,
    label: String,
    formula: &'static str,
}

#[derive(Serialize)]
struct Units {
    brightness: &'static str,
    irradiance: &'static str,
    intensity: &'static str,
    power: &'static str,
    radiance: &'static str,
}

#[derive(Serialize)]
struct CameraInfo {
    projection: &'static str,
    eye: [f64; 3],
    right: [f64; 3],
    up: [f64; 3],
    forward: [f64; 3],
    /// Lower left, lower right, upper right, upper left.
    corners: Option<[[f64; 3]; 4]>,
}

#[derive(Serialize)]
#[serde(rename_all = "camelCase")]
struct ShapeInfo {
    name: String,
    kind: &'static str,
    path: String,
    material: Option<String>,
    center: [f64; 3],
    bounds: Option<BoundsInfo>,
    on_screen: Option<[f64; 2]>,
}

#[derive(Serialize)]
struct BoundsInfo {
    low: [f64; 3],
    high: [f64; 3],
}

#[derive(Serialize)]
#[serde(rename_all = "camelCase")]
struct LightInfo {
    name: String,
    kind: &'static str,
    on: bool,
    position: Option<[f64; 3]>,
    axis: Option<[f64; 3]>,
    on_screen: Option<[f64; 2]>,
}

impl SceneInfo {
    pub fn new(prepared: &PreparedScene) -> Self {
        let scene = prepared.scene();
        let (length, convention, units) = (scene.length(), scene.convention(), scene.unit_system());
        let camera = scene.camera();
        let window = camera.window(Region::all(camera.resolution), length);
        Self {
            title: scene.title().to_owned(),
            length: length.name(),
            screen_unit: scene.screen_unit().name(),
            convention: ConventionInfo {
                name: convention.name(),
                label: convention.label(),
                formula: convention.formula(),
            },
            units: Units {
                brightness: convention.unit(units),
                irradiance: units.irradiance_unit(),
                intensity: units.intensity_unit(),
                power: units.power_unit(),
                radiance: units.radiance_unit(),
            },
            resolution: [camera.resolution.width, camera.resolution.height],
            window: Edges { x: window.x, y: window.y },
            camera: camera_info(prepared),
            shapes: shapes(prepared),
            lights: lights(prepared),
            materials: scene.materials().iter().map(|material| material.name.clone()).collect(),
            probes: scene.probes().iter().map(|probe| probe.name.clone()).collect(),
            areas: scene.areas().iter().map(|area| area.name.clone()).collect(),
            grids: scene.grids().iter().map(|grid| grid.name.clone()).collect(),
            shadows: scene.shadows(),
            has_ambient: scene.ambient().is_some(),
            has_colors: scene.color().is_some(),
            channels: channels(scene),
        }
    }
}

fn camera_info(prepared: &PreparedScene) -> CameraInfo {
    let (scene, frame) = (prepared.scene(), prepared.frame());
    let length = scene.length();
    let camera = scene.camera();
    let extent = camera.projection.extent(camera.resolution);
    let ahead = match camera.projection {
        Projection::Perspective(screen) => Some(screen.distance),
        Projection::Orthographic(_) => Some(0.0),
        Projection::Fisheye(_) | Projection::Panorama(_) => None,
    };
    let corners = ahead.map(|ahead| {
        let ([left, right], [bottom, top]) = (extent.x, extent.y);
        [[left, bottom], [right, bottom], [right, top], [left, top]]
            .map(|[x, y]| in_unit(frame.eye + frame.forward * ahead + frame.right * x + frame.up * y, length))
    });
    CameraInfo {
        projection: match camera.projection {
            Projection::Perspective(_) => "perspective",
            Projection::Orthographic(_) => "orthographic",
            Projection::Fisheye(_) => "fisheye",
            Projection::Panorama(_) => "panorama",
        },
        eye: in_unit(frame.eye, length),
        right: frame.right.to_array(),
        up: frame.up.to_array(),
        forward: frame.forward.to_array(),
        corners,
    }
}

/// Where a point appears, in the unit of the screen.
pub fn on_screen(prepared: &PreparedScene, point: Vector) -> Option<[f64; 2]> {
    let unit = prepared.scene().screen_unit();
    prepared.frame().project(point).map(|place| place.map(|coordinate| unit.from_internal(coordinate)))
}

fn shapes(prepared: &PreparedScene) -> Vec<ShapeInfo> {
    let scene = prepared.scene();
    let length = scene.length();
    let of_shape = |(shape, path): (&isophote::scene::Shape, String)| ShapeInfo {
        name: shape.name.clone(),
        kind: shape.geometry.kind(),
        path,
        material: shape.material.map(|material| scene.materials()[material].name.clone()),
        center: in_unit(shape.geometry.center(), length),
        bounds: shape
            .geometry
            .bounds_of_all()
            .map(|bounds| BoundsInfo { low: in_unit(bounds.least, length), high: in_unit(bounds.greatest, length) }),
        on_screen: on_screen(prepared, shape.geometry.center()),
    };
    scene.shapes().iter().zip(paths(scene.source())).map(of_shape).collect()
}

/// Where each shape is written: a scene has them by kind, in this order.
fn paths(source: &SceneSource) -> impl Iterator<Item = String> {
    let counts = [
        ("sphere", source.sphere.len()),
        ("ellipsoid", source.ellipsoid.len()),
        ("box", source.cuboid.len()),
        ("cylinder", source.cylinder.len()),
        ("cone", source.cone.len()),
        ("plane", source.plane.len()),
        ("rectangle", source.rectangle.len()),
        ("disk", source.disk.len()),
        ("mesh", source.mesh.len()),
        ("spheres", source.spheres.len()),
    ];
    counts.into_iter().flat_map(|(kind, count)| (0..count).map(move |index| format!("{kind}[{index}]")))
}

fn lights(prepared: &PreparedScene) -> Vec<LightInfo> {
    let scene = prepared.scene();
    let of_light = |light: &isophote::light::Light| {
        let (kind, axis) = match &light.kind {
            LightKind::Parallel(parallel) => ("parallel", Some(parallel.direction)),
            LightKind::Point(point) => match point.emission {
                Emission::Isotropic => ("isotropic", None),
                Emission::Lambertian { axis } => ("lambertian", Some(axis)),
                Emission::Spot(spot) => ("spot", Some(spot.cone.axis)),
            },
        };
        LightInfo {
            name: light.name.clone(),
            kind,
            on: light.is_on,
            position: light.position().map(|position| in_unit(position, scene.length())),
            axis: axis.map(Vector::to_array),
            on_screen: light.position().and_then(|position| on_screen(prepared, position)),
        }
    };
    scene.lights().iter().take(MOST_LIGHTS).map(of_light).collect()
}

/// The channels that are one number per pixel; of single lights, those of the first [`MOST_LIGHTS`].
fn channels(scene: &Scene) -> Vec<String> {
    let mut channels = vec![Quantity::Brightness, Quantity::Irradiance];
    if scene.convention().uses_material() {
        channels.extend([Quantity::Diffuse, Quantity::Specular]);
    }
    if scene.ambient().is_some() {
        channels.push(Quantity::Ambient);
    }
    channels.extend([Quantity::Depth, Quantity::CosThetaO]);
    if scene.sampling().is_multisampled() {
        channels.extend([Quantity::Samples, Quantity::Coverage]);
    }
    if scene.lights().len() > 1 {
        let names = || scene.lights().iter().take(MOST_LIGHTS).map(|light| light.name.clone());
        channels.extend(names().map(Quantity::LightBrightness));
        channels.extend(names().map(Quantity::Light));
    }
    channels.iter().map(Quantity::name).collect()
}
