//! Every mistake that a scene file can have is reported with its place, the line, what is allowed; and all at once.

use isophote::map::{Quantity, Resolution, Values};
use isophote::prepare::PreparedScene;
use isophote::render::{ReferenceRenderer, RenderSettings, Renderer};
use isophote::scene::{ProblemKind, Scene, SceneError, Syntax};
use proptest::prelude::*;

const LAB: &str = include_str!("../../../scenes/lab.toml");

/// What is said about the lab's scene after `from` became `to` in it.
fn mistake(from: &str, to: &str) -> SceneError {
    refused("lab.toml", &changed(LAB, from, to), Syntax::Toml)
}

/// A scene in which `from` became `to`.
fn changed(scene: &str, from: &str, to: &str) -> String {
    assert!(scene.contains(from), "the scene has no {from:?}");
    scene.replacen(from, to, 1)
}

fn refused(name: &str, text: &str, syntax: Syntax) -> SceneError {
    Scene::from_text(name, text, syntax).expect_err("a mistake is refused")
}

/// Each test: its name, what is changed in the scene that the function in front has, and how many problems that makes. The
/// messages are golden.
macro_rules! mistakes {
    (in $mistake:ident: $($name:ident: $from:expr => $to:expr, $count:expr;)*) => {
        $(
            #[test]
            fn $name() {
                let error = $mistake($from, $to);
                insta::assert_snapshot!(stringify!($name), error.report(false));
                assert_eq!(error.problems.len(), $count);
            }
        )*
    };
}

mistakes! {
    in mistake:
    an_unknown_key: "radius = 1" => "radius = 1\ncolour = 3", 1;
    a_misspelt_key: "radius = 1" => "raduis = 1", 1;
    a_misspelt_table: "[[light]]" => "[[lights]]", 1;
    a_missing_key: "radius = 1" => "", 1;
    a_missing_version: "version = 1" => "", 1;
    a_missing_length_unit: "length = \"m\"" => "", 1;
    a_wrong_version: "version = 1" => "version = 2", 1;
    a_text_for_a_number: "radius = 1" => "radius = \"one\"", 1;
    a_number_for_a_text: "title = \"Lab 4: one sphere, one light\"" => "title = 4", 1;
    a_vector_of_two: "center = [0, 0, 5]" => "center = [0, 5]", 1;
    a_text_in_a_vector: "center = [0, 0, 5]" => "center = [0, \"five\", 5]", 1;
    a_table_for_a_list: "[[sphere]]" => "[sphere]", 1;
    nan: "radius = 1" => "radius = nan", 1;
    infinity: "position = [5, 5, -10]" => "position = [5, inf, -10]", 1;
    a_number_too_large_for_a_double: "intensity = 100" => "intensity = 1e999", 1;
    a_radius_of_zero: "radius = 1" => "radius = 0", 1;
    a_negative_radius: "radius = 1" => "radius = -1", 1;
    a_direction_without_length: "forward = [0, 0, 1]" => "forward = [0, 0, 0]", 1;
    up_parallel_to_forward: "up = [0, 1, 0]" => "up = [0, 0, -2]", 1;
    a_view_by_angles_and_a_direction: "up = [0, 1, 0]" => "tilt = 30", 1;
    a_tilt_without_azimuth: "forward = [0, 0, 1]" => "tilt = 30", 1;
    an_azimuth_without_tilt: "forward = [0, 0, 1]" => "azimuth = 30", 1;
    angles_out_of_bounds: "forward = [0, 0, 1]" => "tilt = -1\nazimuth = 361", 2;
    a_tilt_of_an_isotropic_light: "emission = \"isotropic\"" => "tilt = 0", 1;
    a_decimal_comma: "diffuse = 0.7" => "diffuse = 0,7", 1;
    a_negative_number_with_a_decimal_comma: "screen = { distance = 5" => "screen = { distance = -5,25", 1;
    a_point_with_decimal_commas: "center = [0, 0, 5]" => "center = [0,5, 0, 5]", 1;
    a_light_that_is_neither_on_nor_off: "intensity = 100" => "on = \"no\"\nintensity = 100", 1;
    forward_and_target: "up = [0, 1, 0]" => "target = [0, 0, 5]", 1;
    neither_forward_nor_target: "forward = [0, 0, 1]" => "", 1;
    a_target_at_the_eye: "forward = [0, 0, 1]" => "target = [0, 0, 0]", 1;
    a_reversed_x_range: "x = [-4, 4]" => "x = [4, -4]", 1;
    an_empty_y_range: "y = [-3, 3]" => "y = [3, 3]", 1;
    a_screen_behind_the_eye: "distance = 5" => "distance = -5", 1;
    an_unknown_material: "material = \"clay\"" => "material = \"caly\"", 1;
    no_material: "material = \"clay\"" => "", 1;
    two_spheres_of_one_name: "[[sphere]]" => "[[sphere]]\nname = \"ball\"\ncenter = [3, 0, 5]\nradius = 1\nmaterial = \"clay\"\n\n[[sphere]]", 1;
    a_light_on_a_surface: "position = [5, 5, -10]" => "position = [0, 1, 5]", 1;
    a_light_inside_a_sphere: "position = [5, 5, -10]" => "position = [0, 0.5, 5]", 1;
    an_eye_on_a_surface: "eye = [0, 0, 0]" => "eye = [0, 0, 4]", 1;
    a_coefficient_beyond_bounds: "diffuse = 0.7" => "diffuse = 1.7e6", 1;
    a_negative_coefficient: "specular = 0.3" => "specular = -0.3", 1;
    a_shininess_of_zero: "shininess = 20" => "shininess = 0", 1;
    a_negative_shininess: "shininess = 20" => "shininess = -5", 1;
    a_missing_shininess: "shininess = 20" => "", 1;
    a_resolution_of_zero: "resolution = [800, 600]" => "resolution = [800, 0]", 1;
    an_absurd_resolution: "resolution = [800, 600]" => "resolution = [2000000, 60000]", 1;
    a_negative_resolution: "resolution = [800, 600]" => "resolution = [-800, 600]", 1;
    a_fractional_resolution: "resolution = [800, 600]" => "resolution = [800.5, 600]", 1;
    an_unknown_convention: "convention = \"lab\"" => "convention = \"labb\"", 1;
    an_unknown_unit: "length = \"m\"" => "length = \"inch\"", 1;
    an_unknown_emission: "emission = \"isotropic\"" => "emission = \"laser\"", 1;
    an_axis_of_an_isotropic_light: "emission = \"isotropic\"" => "axis = [0, 0, 1]", 1;
    a_lambertian_light_without_axis: "emission = \"isotropic\"" => "emission = \"lambertian\"", 1;
    intensity_and_power: "intensity = 100" => "power = 3\nintensity = 100", 1;
    neither_intensity_nor_power: "intensity = 100" => "", 1;
    a_negative_intensity: "intensity = 100" => "intensity = -100", 1;
    a_place_too_far_away: "position = [5, 5, -10]" => "position = [5, 5, -1e16]", 1;
    a_probe_off_the_surface: "at = [0, 0, 4]" => "at = [0.353, 0.353, 4.830]", 1;
    an_unclosed_list: "eye = [0, 0, 0]" => "eye = [0, 0, 0", 1;
    a_spot_without_cones: "emission = \"isotropic\"" => "emission = \"spot\"\ntarget = [0, 0, 5]", 2;
    a_spot_with_a_hard_edge: "emission = \"isotropic\"" => "emission = \"spot\"\ntarget = [0, 0, 5]\ninner_angle = 20\nouter_angle = 20.1", 1;
    a_spot_by_its_full_angle: "emission = \"isotropic\"" => "emission = \"spot\"\ntarget = [0, 0, 5]\ninner_angle = 20\nouter_angle = 120", 1;
    cones_of_an_isotropic_light: "emission = \"isotropic\"" => "inner_angle = 20\nouter_angle = 30", 2;
    a_parallel_light_with_a_place: "emission = \"isotropic\"" => "emission = \"parallel\"", 4;
    a_parallel_light_without_length: "position = [5, 5, -10]\nintensity = 100           # W/sr; or power = …, in W\nemission = \"isotropic\"" => "emission = \"parallel\"\ndirection = [0, 0, 0]\nirradiance = -1", 2;
    ambient_light_without_radiance: "[material.clay]" => "[ambient]\n\n[material.clay]", 1;
    negative_ambient_light: "[material.clay]" => "[ambient]\nradiance = -1\n\n[material.clay]", 1;
    an_unknown_projection: "eye = [0, 0, 0]" => "eye = [0, 0, 0]\nprojection = \"fisheye\"", 1;
    a_screen_and_a_field_of_view: "up = [0, 1, 0]" => "field_of_view = 40", 1;
    neither_screen_nor_field_of_view: "screen = { distance = 5, x = [-4, 4], y = [-3, 3] }" => "", 1;
    a_perspective_of_half_a_turn: "screen = { distance = 5, x = [-4, 4], y = [-3, 3] }" => "field_of_view = 180", 1;
    a_screen_of_an_orthographic_camera: "up = [0, 1, 0]" => "projection = \"orthographic\"", 2;
    a_window_that_is_reversed: "screen = { distance = 5, x = [-4, 4], y = [-3, 3] }" => "projection = \"orthographic\"\nwindow = { x = [4, -4], y = [-3, 3] }", 1;
    a_fisheye_without_field_of_view: "screen = { distance = 5, x = [-4, 4], y = [-3, 3] }" => "projection = \"fisheye-equal-area\"", 1;
    a_fisheye_of_more_than_a_turn: "screen = { distance = 5, x = [-4, 4], y = [-3, 3] }" => "projection = \"fisheye-equidistant\"\nfield_of_view = 400", 1;
    a_panorama_of_more_than_a_turn: "screen = { distance = 5, x = [-4, 4], y = [-3, 3] }" => "projection = \"panorama\"\nlongitude = [-200, 200]\nlatitude = [0, 100]", 2;
    a_field_of_view_of_a_panorama: "screen = { distance = 5, x = [-4, 4], y = [-3, 3] }" => "projection = \"panorama\"\nfield_of_view = 90", 1;
    a_color_of_two: "diffuse = 0.7" => "diffuse = [0.7, 0.2]", 1;
    a_text_in_a_color: "diffuse = 0.7" => "diffuse = [0.7, \"green\", 0.2]", 1;
    a_color_that_is_a_text: "diffuse = 0.7" => "diffuse = \"red\"", 1;
    a_color_with_nan: "intensity = 100" => "intensity = [100, nan, 30]", 1;
    a_color_out_of_bounds_twice: "diffuse = 0.7" => "diffuse = [1.7e6, 0.2, -0.1]", 2;
    a_negative_light_of_one_color: "intensity = 100" => "intensity = [100, -1, 30]", 1;
    a_shininess_of_three_numbers: "shininess = 20" => "shininess = [20, 30, 40]", 1;
    a_color_space_without_color: "version = 1" => "version = 1\ncolor_space = \"rec2020\"", 1;
    an_unknown_color_space: "version = 1" => "version = 1\ncolor_space = \"srgb\"", 1;
    a_key_given_twice: "radius = 1" => "radius = 1\nradius = 2", 1;
}

/// A shape of every other kind.
const WORLD: &str = r#"version = 1
length = "mm"
convention = "irradiance"
camera = { eye = [0, 0, 50], target = [0, 0, 0], screen = { distance = 5, x = [-4, 4], y = [-3, 3] } }
light = [{ position = [0, 0, 40], intensity = 1 }]

[[ellipsoid]]
center = [0, 0, 0]
radii = [1, 2, 3]
rotation = { axis = [1, 1, 0], degrees = 30 }

[[box]]
center = [9, 0, 0]
size = [3, 2, 1]

[[cylinder]]
from = [0, 9, 0]
to = [0, 9, 5]
radius = 0.5

[[cone]]
base = [0, -9, 0]
apex = [0, -9, 4]
radius = 2
apex_radius = 1

[[plane]]
point = [0, 0, -9]
normal = [0, 0, 1]

[[rectangle]]
center = [-9, 0, 0]
normal = [0, 0, 2]
up = [1, 1, 0]
width = 4
height = 3

[[disk]]
center = [-9, 9, 0]
normal = [1, 0, 2]
radius = 1.5
"#;

fn mistake_in_world(from: &str, to: &str) -> SceneError {
    refused("world.toml", &changed(WORLD, from, to), Syntax::Toml)
}

mistakes! {
    in mistake_in_world:
    two_radii_of_an_ellipsoid_are_wrong: "radii = [1, 2, 3]" => "radii = [1, 0, -3]", 2;
    an_ellipsoid_with_one_radius: "radii = [1, 2, 3]" => "radius = 1", 1;
    a_rotation_about_no_axis: "axis = [1, 1, 0]" => "axis = [0, 0, 0]", 1;
    a_rotation_by_nothing: ", degrees = 30" => "", 1;
    a_rotation_in_radians: "degrees = 30" => "radians = 0.5", 2;
    a_rotation_that_is_a_list: "{ axis = [1, 1, 0], degrees = 30 }" => "[0, 30, 0]", 1;
    a_box_of_no_height: "size = [3, 2, 1]" => "size = [3, 0, 1]", 1;
    a_cylinder_of_no_length: "to = [0, 9, 5]" => "to = [0, 9, 0]", 1;
    a_cone_whose_apex_is_its_base: "apex = [0, -9, 4]" => "apex = [0, -9, 0]", 1;
    a_cone_that_is_all_point: "radius = 2" => "radius = 0", 1;
    a_negative_apex_radius: "apex_radius = 1" => "apex_radius = -1", 1;
    a_plane_without_direction: "normal = [0, 0, 1]" => "normal = [0, 0, 0]", 1;
    a_plane_without_normal: "normal = [0, 0, 1]" => "", 1;
    a_rectangle_of_no_area: "width = 4" => "width = 0", 1;
    a_rectangle_whose_up_is_its_normal: "up = [1, 1, 0]" => "up = [0, 0, -1]", 1;
    a_lying_rectangle_without_up: "normal = [0, 0, 2]\nup = [1, 1, 0]" => "normal = [0, 2, 0]", 1;
    a_disk_of_negative_radius: "radius = 1.5" => "radius = -1.5", 1;
    a_light_on_a_plane: "position = [0, 0, 40]" => "position = [3, 4, -9]", 1;
    a_light_inside_a_box: "position = [0, 0, 40]" => "position = [9, 0.5, 0]", 1;
    an_eye_on_a_disk: "eye = [0, 0, 50]" => "eye = [-9, 9, 0]", 1;
    a_probe_beside_a_cone: "[[plane]]" => "[[probe]]\nat = [0, -12, 1]\n\n[[plane]]", 1;
    two_shapes_of_different_kinds_with_one_name: "[[box]]" => "[[box]]\nname = \"ellipsoid[0]\"", 1;
}

#[test]
fn a_scene_of_every_shape_is_valid_and_lists_them_by_kind() {
    let scene = Scene::from_text("world.toml", WORLD, Syntax::Toml).unwrap_or_else(|error| panic!("{error}"));
    let names: Vec<&str> = scene.shapes().iter().map(|shape| shape.name.as_str()).collect();
    assert_eq!(
        names,
        ["ellipsoid[0]", "box[0]", "cylinder[0]", "cone[0]", "plane[0]", "rectangle[0]", "disk[0]"],
        "whatever their order in the file"
    );
    let kinds: Vec<&str> = scene.shapes().iter().map(|shape| shape.geometry.kind()).collect();
    assert_eq!(kinds, ["ellipsoid", "box", "cylinder", "cone", "plane", "rectangle", "disk"]);
    let messages: Vec<String> = scene.warnings().iter().map(|warning| warning.message.to_string()).collect();
    assert_eq!(messages, ["the shapes cast no shadows on each other: each is lit as if it were alone"]);
    let again = Scene::from_text("again", &scene.source().to_toml(), Syntax::Toml).expect("it was valid");
    assert_eq!(again.source(), scene.source());
}

#[test]
fn too_many_shapes_of_all_kinds_together_are_refused() {
    let mut text = WORLD.to_owned();
    text.extend(std::iter::repeat_n("[[disk]]\ncenter = [0, 0, 1]\nnormal = [0, 0, 1]\nradius = 1\n", 99_994));
    let error = refused("world.toml", &text, Syntax::Toml);
    assert_eq!(error.problems.len(), 1);
    assert_eq!(error.problems[0].message.to_string(), "the scene has 100001 shapes");
}

/// Shapes that come from files, here from `tests/files`.
const IMPORTS: &str = r#"version = 1
length = "m"
convention = "radiance"
shadows = true
camera = { eye = [0, 0, -10], target = [0, 0, 0], screen = { distance = 5, x = [-4, 4], y = [-3, 3] } }
light = [{ position = [0, 0, -40], intensity = 1 }]
material = { clay = { diffuse = 0.5 } }

[[mesh]]
file = "square.obj"
scale = [1, 2, 3]
position = [0, 0, 5]

[[spheres]]
file = "points.csv"
"#;

fn with_files(text: &str) -> Result<Scene, SceneError> {
    Scene::from_text_in(std::path::Path::new("tests/files"), "imports.toml", text, Syntax::Toml)
}

fn mistake_in_imports(from: &str, to: &str) -> SceneError {
    with_files(&changed(IMPORTS, from, to)).expect_err("a mistake is refused")
}

mistakes! {
    in mistake_in_imports:
    a_mesh_without_file: "file = \"square.obj\"\n" => "", 1;
    a_mesh_that_is_not_there: "square.obj" => "circle.obj", 1;
    a_mesh_that_is_a_directory: "square.obj" => "../files", 1;
    a_mesh_in_a_format_of_points: "square.obj" => "points.csv", 1;
    a_mesh_that_is_a_picture: "square.obj" => "picture.glb", 1;
    a_mesh_with_a_corner_too_many: "square.obj" => "index.obj", 1;
    a_mesh_with_nan: "square.obj" => "nan.obj", 1;
    a_mesh_without_area: "square.obj" => "flat.obj", 1;
    a_mesh_whose_header_lies: "square.obj" => "lying.ply", 1;
    a_mesh_that_ends_too_early: "square.obj" => "truncated.stl", 1;
    a_mesh_flattened_by_its_scale: "scale = [1, 2, 3]" => "scale = [1, 0, -3]", 2;
    a_mesh_with_two_scales: "scale = [1, 2, 3]" => "scale = [1, 2]", 1;
    files_whose_material_is_not_in_the_scene: "clay = " => "chalk = ", 2;
    spheres_without_file: "file = \"points.csv\"" => "", 1;
    spheres_of_negative_radius: "points.csv" => "negative.csv", 1;
    spheres_without_radius: "points.csv" => "short.csv", 1;
    spheres_from_a_mesh: "points.csv" => "square.obj", 1;
}

#[test]
fn triangles_without_area_are_counted_in_a_warning() {
    let scene = with_files(IMPORTS).unwrap_or_else(|error| panic!("{error}"));
    let warnings: Vec<String> = scene.warnings().iter().map(|warning| warning.message.to_string()).collect();
    assert_eq!(warnings, ["1 triangles of `mesh[0]` have no area and were left out"]);
}

#[test]
fn all_mistakes_of_a_file_are_reported_in_one_run() {
    let text = LAB
        .replace("radius = 1", "radius = -1")
        .replace("diffuse = 0.7", "difuse = 0.7")
        .replace("up = [0, 1, 0]", "up = [0, 0, 1]")
        .replace("intensity = 100", "intensity = \"bright\"")
        .replace("convention = \"lab\"", "convention = \"phong\"")
        .replace("resolution = [800, 600]", "resolution = [0, 600]");
    let error = refused("lab.toml", &text, Syntax::Toml);
    insta::assert_snapshot!(error.report(false));
    let lines: Vec<usize> = error.problems.iter().filter_map(|problem| Some(problem.place.as_ref()?.line)).collect();
    assert_eq!(lines.len(), 6, "each has its place");
    assert!(lines.is_sorted(), "in the order of the file");
}

/// Each grid of this scene has a mistake of its own, but for the first.
#[test]
fn a_grid_is_a_rectangle_with_a_place_and_points() {
    let rest = [
        "center = [0, 0, 0]\nu = [1, 0, 0]\nv = [0, 0, 1]\npoints = [3, 4]\nside = \"back\"",
        "center = [0, 0, 0]\ncorner = [0, 0, 0]\nu = [1, 0, 0]\nv = [0, 0, 1]\npoints = [3, 4]",
        "u = [1, 0, 0]\nv = [0, 0, 1]\npoints = [3, 4]",
        "corner = [0, 0, 0]\nu = [1, 0, 0]\nv = [1, 0, 1]\npoints = [3, 4]",
        "corner = [0, 0, 0]\nu = [0, 0, 0]\npoints = [3]",
        "corner = [0, 0, 0]\nu = [1, 0, 0]\nv = [0, 0, 1]\npoints = [0, 4]",
        "corner = [0, 0, 0]\nu = [1, 0, 0]\nv = [0, 0, 1]\npoints = [60000, 60000]",
        "corner = [0, 0, 0]\nu = [1, 0, 0]\nv = [0, 0, 1]\nside = \"left\"\npoints = [1, 1]\nname = \"grid[0]\"",
    ];
    let text = rest.iter().fold(LAB.to_owned(), |text, grid| text + "\n[[grid]]\n" + grid + "\n");
    insta::assert_snapshot!(refused("lab.toml", &text, Syntax::Toml).report(false));
}

#[test]
fn json_has_the_same_keys_and_the_same_messages() {
    let text = "{\n  \"version\": 1,\n  \"length\": \"m\",\n  \"sphere\": [\n    { \"center\": [0, 0, 5], \"radius\": -1, \"radius\": 2, \"colour\": null }\n  ]\n}\n";
    insta::assert_snapshot!(refused("scene.json", text, Syntax::Json).report(false));
    let scene = Scene::from_text("lab", LAB, Syntax::Toml).expect("it is valid");
    let json = serde_json::to_string_pretty(scene.source()).expect("it is plain data");
    let twin = Scene::from_text("lab.json", &json, Syntax::Json).expect("the twin is valid");
    assert_eq!(twin.source(), scene.source());
}

#[test]
fn broken_json_is_reported_with_its_place() {
    insta::assert_snapshot!(
        refused("scene.json", "{\n  \"version\": 1,\n  \"length\" \"m\"\n}", Syntax::Json).report(false)
    );
    insta::assert_snapshot!(refused("scene.json", "[1, 2]", Syntax::Json).report(false));
}

#[test]
fn an_empty_scene_says_how_to_get_one() {
    for text in ["", " \n\t\n", "\u{feff}"] {
        insta::assert_snapshot!("an_empty_scene", refused("empty.toml", text, Syntax::Toml).report(false));
    }
}

#[test]
fn a_million_lights_are_too_many() {
    let mut text = LAB.to_owned();
    text.extend(std::iter::repeat_n("[[light]]\nposition = [5, 5, -10]\nintensity = 1\n", 1_000_000));
    let error = refused("lab.toml", &text, Syntax::Toml);
    insta::assert_snapshot!(error.report(false));
}

#[test]
fn thousands_of_mistakes_are_counted_and_the_first_are_shown() {
    let mut text = LAB.to_owned();
    text.extend(std::iter::repeat_n("[[light]]\nposition = [5, 5]\nintensity = 1\n", 20_000));
    let report = refused("lab.toml", &text, Syntax::Toml).report(false);
    assert!(report.ends_with("… and 19970 more"), "{}", &report[report.len() - 100..]);
}

#[test]
fn lines_of_any_length_and_ending_can_be_shown() {
    let long = format!("{}{}", " ".repeat(1_000_000), "radius = -1");
    let report = mistake("radius = 1", &long).report(false);
    assert!(report.contains("radius = -1") && report.len() < 2000, "{report}");
    let windows = LAB.replace("radius = 1", "radius = -1").replace('\n', "\r\n");
    let report = refused("lab.toml", &windows, Syntax::Toml).report(false);
    assert!(report.contains("lab.toml:27:") && !report.contains('\r'), "{report}");
}

#[test]
fn deep_nesting_is_refused_and_not_followed_to_the_end_of_the_stack() {
    for (syntax, open) in [(Syntax::Toml, "a = "), (Syntax::Json, "{\"a\": ")] {
        let text = format!("{open}{}", "[".repeat(1_000_000));
        let error = refused("deep", &text, syntax);
        assert!(error.problems.iter().any(|problem| problem.kind == ProblemKind::Syntax), "{error}");
    }
}

proptest! {
    /// Bytes are changed, dropped and doubled in valid scenes: whatever comes out is accepted or refused with words.
    #[test]
    fn no_text_makes_the_reader_panic(
        edits in prop::collection::vec((0.0..1.0_f64, 0_usize..6, "[\\x00-\\x7f]{0,12}|[-0-9.e\\[\\]{}\"=#,\n]{1,8}|é|∞|\u{feff}"), 1..12),
        json in any::<bool>(),
    ) {
        let syntax = if json { Syntax::Json } else { Syntax::Toml };
        let mut text = if json {
            let scene = Scene::from_text("lab", LAB, Syntax::Toml).expect("it is valid");
            serde_json::to_string_pretty(scene.source()).expect("it is plain data")
        } else {
            LAB.to_owned()
        };
        for (place, removed, inserted) in edits {
            #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, clippy::cast_precision_loss)]
            let start = text.floor_char_boundary((place * text.len() as f64) as usize);
            let end = text.ceil_char_boundary((start + removed).min(text.len()));
            text.replace_range(start..end, &inserted);
        }
        match Scene::from_text("mutated", &text, syntax) {
            Err(error) => {
                prop_assert!(!error.problems.is_empty());
                prop_assert!(!error.report(true).is_empty());
            }
            Ok(scene) => {
                let small = scene.with_resolution(Resolution { width: 8, height: 6 }).expect("it was valid");
                let settings = RenderSettings { quantities: Quantity::COMMON.to_vec(), ..RenderSettings::default() };
                let map = ReferenceRenderer.render(&PreparedScene::new(&small), &settings).expect("a valid scene renders");
                for channel in map.channels() {
                    if let Values::Scalar(values) = &channel.values {
                        prop_assert!(values.iter().all(|value| value.is_finite()), "{}", channel.quantity.name());
                    }
                }
            }
        }
    }
}

/// k_d and k_s are bounded by 1 where the convention makes them albedos, and nowhere else.
#[test]
fn only_albedos_are_bounded_by_one() {
    for (convention, diffuse, specular) in [
        ("irradiance", false, false),
        ("lambert", true, false),
        ("lab", false, false),
        ("course", false, false),
        ("course-pi", true, false),
        ("radiance", true, true),
        ("blinn-phong", false, false),
        ("blinn-phong-pi", true, false),
    ] {
        let scene = changed(LAB, "convention = \"lab\"", &format!("convention = \"{convention}\""));
        for (key, from, is_bounded) in [("diffuse", "diffuse = 0.7", diffuse), ("specular", "specular = 0.3", specular)]
        {
            let text = changed(&scene, from, &format!("{key} = 1.25"));
            let found = Scene::from_text("lab.toml", &text, Syntax::Toml);
            assert_eq!(found.is_err(), is_bounded, "{convention}, {key}");
            if let Err(error) = found {
                let report = error.report(false);
                assert!(report.contains("is 1.25") && report.contains("allowed: 0 to 1:"), "{report}");
            }
        }
    }
}

/// The warning goes by the albedo at normal incidence: (0.7, 0.9, 40) in (3.5) reflects 0.856.
#[test]
fn a_material_that_reflects_more_than_it_receives_is_warned_of_by_its_albedo() {
    let warnings = |convention: &str, [diffuse, specular, shininess]: [f64; 3]| {
        let scene = changed(LAB, "convention = \"lab\"", &format!("convention = \"{convention}\""));
        let scene = changed(&scene, "diffuse = 0.7", &format!("diffuse = {diffuse}"));
        let scene = changed(&scene, "specular = 0.3", &format!("specular = {specular}"));
        let scene = changed(&scene, "shininess = 20", &format!("shininess = {shininess}"));
        let scene = Scene::from_text("lab.toml", &scene, Syntax::Toml).unwrap_or_else(|error| panic!("{error}"));
        scene.warnings().iter().map(|warning| warning.message.to_string()).collect::<Vec<_>>()
    };
    assert_eq!(warnings("course-pi", [0.7, 0.9, 40.0]), Vec::<String>::new());
    assert_eq!(warnings("blinn-phong-pi", [0.7, 0.9, 40.0]), Vec::<String>::new());
    assert_eq!(warnings("lambert", [0.7, 0.9, 40.0]), Vec::<String>::new());
    for (convention, material, albedo) in [
        ("course-pi", [0.7, 3.0, 40.0], "k_d + k_s A(n)/π = 1.21948"),
        ("course", [0.7, 0.9, 40.0], "π k_d + k_s A(n) = 2.68871"),
        ("blinn-phong", [0.7, 0.9, 40.0], "π k_d + k_s A(n) = 2.68871"),
        ("radiance", [0.7, 0.9, 40.0], "k_d + k_s = 1.6"),
        ("lab", [0.7, 0.9, 40.0], "k_d + k_s = 1.6"),
    ] {
        let found = warnings(convention, material);
        assert!(matches!(&found[..], [one] if one.ends_with(albedo)), "{convention}: {found:?}");
    }
}

#[test]
fn a_decimal_comma_in_json_is_told_too() {
    let error =
        refused("lab.json", "{\"version\": 1, \"length\": \"m\", \"camera\": {\"field_of_view\": 0,5}}", Syntax::Json);
    let report = error.report(false);
    assert!(report.contains("a number has a decimal point, not a comma: write 0.5"), "{report}");
}
