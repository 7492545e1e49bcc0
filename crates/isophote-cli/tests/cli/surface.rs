//! The map over a shape's own surface.

use serde_json::Value;

use crate::common::{COURSE, Folder, assert_close, npy};

const SURFACE: &str = include_str!("../../../../scenes/surface.toml");

fn number(value: &Value) -> f64 {
    value.as_f64().unwrap_or_else(|| panic!("{value} is no number"))
}

/// (5.1) and (5.3) by the scene that says so in its comment.
#[test]
fn the_flux_of_the_lamp_is_that_of_the_closed_form() {
    let folder = Folder::with("ball.toml", SURFACE);
    let json = folder.ok("surface ball.toml --channel light.lamp --towards lamp --json").json();
    assert_close(number(&json["flux"]), 7.717_297_641_8, 1e-4);
    assert_close(number(&json["area"]), std::f64::consts::PI * 0.25, 1e-12);
    assert_close(number(&json["mean"]), 7.717_297_641_8 / (std::f64::consts::PI * 0.25), 1e-4);
    let found =
        ["shape", "kind", "side", "coordinates", "unit", "flux_unit", "area_unit", "length"].map(|key| &json[key]);
    assert_eq!(found, ["ball", "sphere", "front", "longitude-latitude", "W/m²", "W", "m²", "m"]);
    assert_eq!(json["size"], serde_json::json!([360, 180]));
    assert_close(number(&json["axis"][2]), 0.8, 1e-15);
    // The first row is half a degree from the pole; (5.1) there, with cosβ = sin 89.5°.
    let cosine = 89.5_f64.to_radians().sin();
    let square: f64 = 0.0625 + 2.56 - 0.8 * cosine;
    assert_close(number(&json["max"]["value"]), 100.0 * (1.6 * cosine - 0.25) / square.powf(1.5), 1e-12);
    assert_eq!((&json["max"]["cell"][1], &json["max"]["coordinates"][1]), (&0.into(), &89.5.into()));
}

#[test]
fn the_numbers_have_their_units_and_places() {
    let folder = Folder::with("ball.toml", SURFACE);
    let text = folder.ok("surface ball.toml").stdout;
    for part in [
        "A sphere under two lights, all around\n",
        "  surface     ball (sphere), front, 0.785398163397 m²\n",
        "  cells       360 × 180, longitude × latitude; 90° latitude towards (0, 1, 0)\n",
        "  channel     irradiance, W/m²\n",
        " W = ∫ E dA\n",
        "  minimum     0 W/m² at longitude ",
    ] {
        assert!(text.contains(part), "{part:?} is not in\n{text}");
    }
    let seen = folder.ok("surface ball.toml --channel brightness").stdout;
    for part in ["  convention  lambert (3.2): B = k_d Σ E_j\n", "  turned to   the eye: 0.3"] {
        assert!(seen.contains(part), "{part:?} is not in\n{seen}");
    }
    assert!(!seen.contains("flux"), "{seen}");
}

#[test]
fn files_hold_the_cells_and_say_what_their_coordinates_are() {
    let folder = Folder::with("ball.toml", SURFACE);
    let files = "-o map.csv -o map.npy -o map.npz -o map.png -o map.exr";
    let outcome = folder.ok(&format!("surface ball.toml --size 24x12 --projection equal-area {files}"));
    assert!(outcome.stderr.contains("wrote map.csv\n"), "{}", outcome.stderr);
    let csv = folder.csv("map.csv");
    assert!(csv.names.join(",").starts_with("column,row,longitude,sin_latitude,shape,irradiance,position.x"));
    assert_eq!(
        (csv.rows.len(), csv.column_at("longitude", 0), csv.column_at("sin_latitude", 0)),
        (288, -172.5, 11.0 / 12.0)
    );
    let (_, shape, values) = npy(&folder.read("map.npy"));
    assert_eq!((shape, values), (vec![12, 24], csv.column("irradiance")));
    // Longitude 0 is the side of z, 90° that of x, as with y up.
    for row in 0..288 {
        let [x, y, z] = ["x", "y", "z"].map(|axis| csv.column_at(&format!("position.{axis}"), row) / 0.25);
        assert!((x.atan2(z).to_degrees() - csv.column_at("longitude", row)).abs() < 1e-9);
        assert!((y - csv.column_at("sin_latitude", row)).abs() < 1e-12);
    }
    for file in ["map.csv", "map.npy", "map.npz", "map.png", "map.exr"] {
        let shown = folder.ok(&format!("show {file}")).stdout;
        assert!(shown.contains("surface of ball, front, equal-area, axis (0, 1, 0), double"), "{shown}");
        assert!(shown.contains("longitude -180 to 180 °, sine of the latitude -1 to 1 no unit"), "{shown}");
        assert_eq!(folder.ok(&format!("surface {file} --json")).json(), folder.ok("surface ball.toml --json").json());
    }
}

#[test]
fn a_figure_names_its_axes_with_units_and_hatches_what_is_turned_away() {
    let folder = Folder::with("ball.toml", SURFACE);
    folder.ok("surface ball.toml --size 72x36 --figure ball.svg --figure ball.png");
    let svg = folder.text("ball.svg");
    for text in [">longitude, °<", ">latitude, °<", ">irradiance, W/m²<", ">−180<", ">90<", "surface of ball, front"]
    {
        assert!(svg.contains(text), "{text}");
    }
    assert!(!svg.contains("turned away"));
    folder.ok("surface ball.toml --size 72x36 --projection equal-area --channel brightness --figure seen.svg");
    let svg = folder.text("seen.svg");
    for text in [">sine of the latitude<", ">brightness, lambert (3.2),<", ">turned away<"] {
        assert!(svg.contains(text), "{text}");
    }
}

#[test]
fn other_shapes_have_coordinates_of_their_own() {
    let shapes = "shadows = true\n[[cylinder]]\nname = \"post\"\nfrom = [0, 0, 0]\nto = [0, 200, 0]\nradius = 20\nmaterial = \"gray\"\n\
        [[rectangle]]\nname = \"wall\"\ncenter = [0, 0, 600]\nwidth = 400\nheight = 200\nnormal = [0, 0, -1]\nmaterial = \"gray\"\n\
        [[disk]]\nname = \"table\"\ncenter = [900, 0, 0]\nradius = 50\nnormal = [0, 1, 0]\nmaterial = \"gray\"\n";
    let (head, rest) = COURSE.split_once("[camera]").unwrap();
    let material = COURSE.split_once("[material.").unwrap().1.split_once(']').unwrap().0;
    let (flag, shapes) = shapes.split_once('\n').unwrap();
    let text = format!("{head}{flag}\n[camera]{rest}\n{}", shapes.replace("gray", material));
    let folder = Folder::with("room.toml", text);
    for (name, axes, area, left_out) in [
        ("post", ["angle", "height"], 0.080 * std::f64::consts::PI * 0.1, true),
        ("wall", ["x", "y"], 0.08, false),
        ("table", ["angle", "radius"], std::f64::consts::PI * 0.0025, false),
    ] {
        let json = folder.ok(&format!("surface room.toml --shape {name} --size 30x20 --json")).json();
        assert_eq!([&json["axes"][0]["name"], &json["axes"][1]["name"]], axes);
        assert_close(number(&json["area"]), area, 1e-12);
        assert_eq!(json["left_out"] == "its two ends", left_out);
        folder.ok(&format!("surface room.toml --shape {name} --size 30x20 --side back --figure {name}.svg"));
    }
    assert!(folder.text("post.svg").contains(">height, mm<"));
}

#[test]
fn what_makes_no_sense_is_refused_before_anything_is_written() {
    let folder = Folder::with("ball.toml", SURFACE);
    for (arguments, messages) in [
        ("surface ball.toml --shape bull -o a.csv", vec!["--shape and the name of a shape; there are: ball"]),
        ("surface ball.toml --part 1 -o a.csv", vec!["there is no part 1: the shape has 1"]),
        ("surface ball.toml --size 0x4 -o a.csv", vec!["0×4 cells", "allowed"]),
        ("surface ball.toml --axis 0,0,0 -o a.csv", vec!["any direction with a length"]),
        ("surface ball.toml --axis 0,1 -o a.csv", vec!["X,Y,Z"]),
        ("surface ball.toml --towards sun -o a.csv", vec!["no light \"sun\"", "lamp, lantern"]),
        ("surface ball.toml --projection mercator -o a.csv", vec!["equirectangular, equal-area"]),
        ("surface ball.toml --side left -o a.csv", vec!["front, back"]),
        ("surface ball.toml --channel depth -o a.csv", vec!["no channel `depth`"]),
        ("surface ball.toml --channel normal --figure a.svg", vec!["`normal` cannot be a picture"]),
        ("surface ball.toml -o a.csv -o a.csv", vec!["a.csv would be written twice"]),
        ("surface ball.toml --figure a.csv", vec!["allowed for figures: .svg, .png"]),
    ] {
        folder.run(arguments).failed(2, &messages);
    }
    assert_eq!(folder.names(), ["ball.toml"]);
}
