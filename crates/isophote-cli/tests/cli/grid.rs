//! Illuminances at the points of a grid.

use serde_json::json;

use crate::common::{Folder, assert_close};

const GRID: &str = include_str!("../../../../scenes/grid.toml");

#[test]
fn the_grids_of_a_scene_stand_in_one_table_with_their_uniformities() {
    let folder = Folder::with("grid.toml", GRID);
    let text = folder.ok("grid grid.toml").stdout;
    let lines: Vec<&str> = text.lines().collect();
    assert_eq!(lines[0], "CIE 171, test 5.2");
    let heading: Vec<&str> = lines[2].split_whitespace().collect();
    assert_eq!(heading.join(" "), "grid points minimum, lx mean, lx maximum, lx min/mean min/max");
    let floor: Vec<&str> = lines[3].split_whitespace().collect();
    assert_eq!((floor[0], floor[2], floor[6]), ("floor", "×", "111.111111"), "{text}");
    // 1000 · 9/13.5² (5.4); CIE 171 prints 49.39.
    assert_close(floor[4].parse().unwrap(), 49.3827, 1e-6);
    let [mean, uniformity]: [f64; 2] = [floor[5], floor[7]].map(|cell| cell.parse().unwrap());
    assert_close(uniformity, 49.3827 / mean, 1e-3);
    assert!(lines[4].trim_start().starts_with("desk"));
    assert_eq!(lines[5], "  floor: minimum at u 0.25 m, v 3.25 m; maximum at u 1.75 m, v 1.75 m");
}

/// (5.4), by the numbers that the file and the JSON hold.
#[test]
fn a_csv_file_and_the_json_hold_every_point() {
    let folder = Folder::with("grid.toml", GRID);
    folder.ok("grid grid.toml --name floor -o floor.csv");
    let csv = folder.csv("floor.csv");
    assert_eq!(csv.names.join(","), "column,row,u,v,irradiance,position.x,position.y,position.z");
    assert_eq!(csv.rows.len(), 49);
    let [x, z, values] = ["position.x", "position.z", "irradiance"].map(|name| csv.column(name));
    for ((x, z), value) in x.iter().zip(&z).zip(&values) {
        assert_close(*value, 9000.0 / (9.0 + x * x + z * z).powi(2), 1e-13);
    }
    assert!(folder.text("floor.csv").contains("# u, v: centre of the cell on the surface, m, m\n"));
    let json = folder.ok("grid grid.toml --name floor --json").json();
    let grid = &json["grids"][0];
    assert_eq!((&json["unit"], &json["channel"]), (&"lx".into(), &"irradiance".into()));
    let flat: Vec<f64> = grid["values"]
        .as_array()
        .unwrap()
        .iter()
        .flat_map(|row| row.as_array().unwrap())
        .map(|value| value.as_f64().unwrap())
        .collect();
    assert_eq!(flat, values);
    assert_close(grid["normal"][1].as_f64().unwrap(), 1.0, 1e-15);
    assert_eq!(grid["points"], json!([7, 7]));
    assert_eq!((&grid["max"]["cell"], &grid["max"]["point"]), (&json!([3, 3]), &json!([0, 0, 0])));
    let (min, mean) = (grid["min"]["value"].as_f64().unwrap(), grid["mean"].as_f64().unwrap());
    assert_close(grid["uniformity"].as_f64().unwrap(), min / mean, 1e-15);
    assert_close(mean, values.iter().sum::<f64>() / 49.0, 1e-14);
}

#[test]
fn a_grid_of_the_command_line_is_the_same_and_travels_with_the_file() {
    let folder = Folder::with("grid.toml", GRID);
    let placed = "--center 0,0,0 --u 3.5,0,0 --v 0,0,-3.5 --points 7x7";
    folder.ok(&format!("grid grid.toml {placed} -o placed.npz -o placed.csv -q"));
    folder.ok("grid grid.toml --name floor -o floor.csv -q");
    assert_eq!(folder.csv("placed.csv"), folder.csv("floor.csv"));
    let corner = "--corner -1.75,0,1.75 --u 3.5,0,0 --v 0,0,-3.5 --points 7x7";
    let [first, second] = [placed, corner].map(|grid| folder.ok(&format!("grid grid.toml {grid} --json")).json());
    assert_eq!(first, second);
    assert_eq!(first["grids"][0]["name"], "grid[0]");
    assert_eq!(folder.ok("grid placed.npz --json").json(), first, "the file carries its grid");
    let back = folder.ok(&format!("grid grid.toml {placed} --side back")).stdout;
    let row: Vec<&str> = back.lines().nth(3).unwrap().split_whitespace().collect();
    assert_eq!(row[4..], ["0", "0", "0", "–", "–"], "nothing comes from below, and 0/0 is no uniformity");
}

#[test]
fn a_figure_has_its_axes_in_the_unit_of_the_scene_and_labelled_lines() {
    let folder = Folder::with("grid.toml", GRID);
    folder.ok("grid grid.toml --name desk --figure desk.svg --figure desk.png");
    let svg = folder.text("desk.svg");
    for text in [">CIE 171, test 5.2: desk<", ">u, m<", ">v, m<", ">illuminance, lx<", "grid desk, double"] {
        assert!(svg.contains(text), "{text}");
    }
    assert!(folder.picture("desk.png").width > 800);
}

#[test]
fn what_makes_no_sense_is_refused_before_anything_is_written() {
    let folder = Folder::with("grid.toml", GRID);
    for (arguments, messages) in [
        ("grid", vec!["the scene has no grid", "--center"]),
        ("grid grid.toml --name flour", vec!["no grid \"flour\"; there are: floor, desk"]),
        ("grid grid.toml -o both.csv", vec!["a file holds one grid", "floor, desk"]),
        ("grid grid.toml --name floor --u 1,0,0", vec!["--name"]),
        ("grid grid.toml --side back", vec!["--side goes with a grid of the command line"]),
        ("grid grid.toml --center 0,0,0", vec!["`u` is missing", "`v` is missing", "`points` is missing"]),
        ("grid grid.toml --center 0,0,0 --corner 0,0,0 --u 1,0,0 --v 0,0,1 --points 2x2", vec!["--corner"]),
        ("grid grid.toml --u 1,0,0 --v 0,0,1 --points 2x2", vec!["the key `corner` is missing"]),
        ("grid grid.toml --center 0,0,0 --u 1,0,0 --v 1,0,1 --points 2x2", vec!["not at right angles", "45°"]),
        ("grid grid.toml --center 0,0,0 --u 0,0,0 --v 1,0,1 --points 2x2", vec!["`grid[0].u` has no length"]),
        ("grid grid.toml --center 0,0,0 --u 1,0,0 --v 0,0,1 --points 0x2", vec!["`grid[0].points` is [0, 2]"]),
        (
            "grid grid.toml --center 0,3,0 --u 1,0,0 --v 0,0,1 --points 3x3",
            vec!["the light \"lamp\" stands at the point"],
        ),
        ("grid grid.toml --name floor --channel brightness", vec!["no channel `brightness`"]),
        ("grid grid.toml --name floor --channel position --figure a.svg", vec!["`position` cannot be a picture"]),
    ] {
        folder.run(arguments).failed(2, &messages);
    }
    assert_eq!(folder.names(), ["grid.toml"]);
}
