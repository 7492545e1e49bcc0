//! Scenes that together have every key, and every limit within reach.

use isophote::import::MemoryFiles;
use isophote::scene::{Scene, SceneError, Syntax};
use serde_json::Value;

/// All but the camera. Amounts stand as one number and as three; a spot's cones leave room for each other's limits.
const WORLD: &str = r#"
version = 1
title = "Every key"
length = "m"
handedness = "left"
convention = "radiance"
shadows = true
quantities = "radiometric"
color_space = "rec709"
sampling = { samples = 4, tolerance = 0.5, filter = "box" }
ambient = { radiance = [1, 2, 3], obstructed = true, samples = 16 }

[material]
clay = { diffuse = [0.1, 0.2, 0.3], specular = 0.1, shininess = 10 }
chalk = { diffuse = 0.5, specular = [0.1, 0.2, 0.3], shininess = 10 }

[[sphere]]
name = "a sphere"
center = [0, 0, 5]
radius = 1
material = "clay"
casts_shadow = true
receives_shadow = true

[[ellipsoid]]
name = "an ellipsoid"
center = [5, 0, 5]
radii = [1, 1, 1]
rotation = { axis = [0, 0, 1], degrees = 90 }
material = "chalk"
casts_shadow = true
receives_shadow = true

[[box]]
name = "a box"
center = [10, 0, 5]
size = [1, 1, 1]
rotation = { axis = [0, 0, 1], degrees = 90 }
material = "clay"
casts_shadow = true
receives_shadow = true

[[cylinder]]
name = "a cylinder"
from = [15, 0, 5]
to = [16, 0, 5]
radius = 1
material = "clay"
casts_shadow = true
receives_shadow = true

[[cone]]
name = "a cone"
base = [20, 0, 5]
apex = [21, 0, 5]
radius = 1
apex_radius = 0.5
material = "clay"
casts_shadow = true
receives_shadow = true

[[plane]]
name = "a plane"
point = [0, -10, 0]
normal = [0, 1, 0]
material = "clay"
casts_shadow = true
receives_shadow = true

[[rectangle]]
name = "a rectangle"
center = [25, 0, 5]
normal = [0, 0, 1]
up = [0, 1, 0]
width = 1
height = 1
material = "clay"
casts_shadow = true
receives_shadow = true

[[disk]]
name = "a disk"
center = [30, 0, 5]
normal = [0, 0, 1]
radius = 1
material = "clay"
casts_shadow = true
receives_shadow = true

[[mesh]]
name = "a mesh"
file = "corner.obj"
scale = [1, 1, 1]
rotation = { axis = [0, 0, 1], degrees = 90 }
position = [40, 0, 5]
smooth = true
material = "clay"
casts_shadow = true
receives_shadow = true

[[spheres]]
name = "many spheres"
file = "points.csv"
material = "clay"
casts_shadow = true
receives_shadow = true

[[light]]
name = "a point"
position = [0, 50, 0]
intensity = 1
emission = "isotropic"
casts_shadows = true

[[light]]
position = [0, 51, 0]
power = [1, 2, 3]

[[light]]
emission = "lambertian"
position = [0, 52, 0]
intensity = [1, 2, 3]
target = [0, 0, 0]

[[light]]
emission = "spot"
position = [0, 53, 0]
power = 1
axis = [0, -1, 0]
inner_angle = 0
outer_angle = 90

[[light]]
emission = "parallel"
direction = [0, -1, 0]
irradiance = 1

[[light]]
emission = "parallel"
direction = [0, -1, 0]
irradiance = [1, 2, 3]

[[probe]]
name = "a probe"
at = [0, -10, 0]
published = 1

[[grid]]
name = "a grid"
corner = [0, 0, 0]
u = [1, 0, 0]
v = [0, 0, 1]
points = [3, 4]
side = "front"

[[grid]]
center = [0, 0, 0]
u = [1, 0, 0]
v = [0, 0, 1]
points = [3, 4]
"#;

const CAMERAS: [&str; 5] = [
    "forward = [0, 0, 1]\nup = [0, 1, 0]\nscreen = { distance = 5, x = [-4, 4], y = [-3, 3] }",
    "target = [0, 0, 1]\nprojection = \"fisheye-equidistant\"\nfield_of_view = 180",
    "target = [0, 0, 1]\nprojection = \"orthographic\"\nwindow = { x = [-4, 4], y = [-3, 3] }",
    "target = [0, 0, 1]\nprojection = \"panorama\"\nlongitude = [-90, -10]\nlatitude = [-10, 0]",
    "target = [0, 0, 1]\nprojection = \"panorama\"\nlongitude = [10, 90]\nlatitude = [0, 10]",
];

/// One number of ambient light, where there are three in the others.
const DARKER: (&str, &str) = ("radiance = [1, 2, 3]", "radiance = 1");

/// The scenes, as JSON.
pub fn all() -> impl Iterator<Item = Value> {
    let text = |camera: &str| format!("{WORLD}\n[camera]\neye = [0, 0, -10]\nresolution = [8, 6]\n{camera}\n");
    let scenes = CAMERAS.into_iter().map(text).chain([text(CAMERAS[0]).replace(DARKER.0, DARKER.1)]);
    scenes.map(|text| serde_json::to_value(text.parse::<toml::Table>().expect("it is TOML")).expect("it is plain data"))
}

/// The scene that a JSON value is, with its files.
pub fn read(scene: &Value) -> Result<Scene, SceneError> {
    let files = MemoryFiles::from_iter([
        ("corner.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 2 3\nf 1 3 4\nf 1 4 2\nf 2 4 3\n"),
        ("points.csv", "x,y,z,radius\n45,0,5,1\n"),
    ]);
    Scene::from_text_with(&files, None, "the scene", &scene.to_string(), Syntax::Json)
}
