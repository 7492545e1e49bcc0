//! Values along a line of the picture.

use crate::common::{COURSE, Csv, Folder, LAB, TWO_LIGHTS, assert_close};

/// The cells of a column of a map for the pixels that one of its indices selects; NaN where nothing is seen.
fn of_map(map: &Csv, name: &str, select: impl Fn(&[f64]) -> bool) -> Vec<f64> {
    let shapes = map.column("shape");
    let cells = map.column(name).into_iter().zip(shapes).zip(&map.rows).filter(|(_, row)| select(row));
    cells.map(|((value, shape), _)| if shape < 0.0 { f64::NAN } else { value }).collect()
}

/// The same gaps, and the same numbers but for the rounding of two ways to compute them.
fn assert_same(found: &[f64], expected: &[f64], case: &str) {
    let peak = expected.iter().copied().filter(|value| !value.is_nan()).fold(0.0, f64::max);
    assert_eq!(found.len(), expected.len(), "{case}");
    for (found, expected) in found.iter().zip(expected) {
        let is_close = (found - expected).abs() <= 2e-12 * peak;
        assert!(is_close || found.is_nan() && expected.is_nan(), "{case}: {found} {expected}");
    }
}

#[test]
#[expect(clippy::float_cmp, reason = "whole numbers")]
fn a_row_and_a_column_hold_the_numbers_of_the_map() {
    let scene = TWO_LIGHTS.replace("[800, 600]", "[120, 90]");
    let folder = Folder::with("two.toml", scene);
    folder.ok("render two.toml -o map.csv -q");
    let map = folder.csv("map.csv");
    let channels = "--channel brightness --channel irradiance --channel diffuse --channel specular";
    folder.ok(&format!("section two.toml --row 40 {channels} -o row.csv"));
    folder.ok(&format!("section two.toml --column 77 {channels} -o column.csv"));
    let [row, column] = ["row.csv", "column.csv"].map(|name| folder.csv(name));
    assert_eq!(row.names.join(","), "x,y,brightness,irradiance,diffuse,specular");
    assert_eq!((row.rows.len(), column.rows.len()), (120, 90));
    for name in ["brightness", "irradiance", "diffuse", "specular"] {
        let expected = of_map(&map, name, |pixel| pixel[1] == 40.0);
        assert!(expected.iter().any(|value| *value > 0.0) && expected.iter().any(|value| value.is_nan()), "{name}");
        assert_same(&row.column(name), &expected, &format!("{name} in row 40"));
        let expected = of_map(&map, name, |pixel| pixel[0] == 77.0);
        assert_same(&column.column(name), &expected, &format!("{name} in column 77"));
    }
    let x: Vec<f64> = map.rows.iter().filter(|pixel| pixel[1] == 40.0).map(|pixel| pixel[2]).collect();
    for (section, pixel) in row.column("x").iter().zip(x) {
        assert!((section - pixel).abs() <= 1e-15 * 2.4, "{section} {pixel}");
    }
}

#[test]
fn a_line_has_as_many_points_as_asked_for_in_the_unit_of_the_scene() {
    let folder = Folder::with("course.toml", COURSE);
    let json = folder.ok("section course.toml --line -300,-100,300,100 --samples 7 --json").json();
    assert_eq!((&json["length"], &json["convention"]), (&"mm".into(), &"course".into()));
    let screen = json["screen"].as_array().unwrap();
    assert_eq!(
        (screen.len(), &screen[0], &screen[6]),
        (7, &serde_json::json!([-300, -100]), &serde_json::json!([300, 100]))
    );
    let channel = &json["channels"][0];
    assert_eq!((&channel["name"], &channel["unit"]), (&"brightness".into(), &"W/(m²·sr)".into()));
    let front = folder.ok("probe course.toml --at 0,0,-300 --json").json();
    let expected = front["probes"][0]["channels"]["brightness"]["value"].as_f64().unwrap();
    assert_close(channel["values"][3].as_f64().unwrap(), expected, 1e-14);
    assert_eq!(
        folder.ok("section course.toml --line -300,-100,300,100 --json").json()["screen"].as_array().unwrap().len(),
        513
    );
}

#[test]
fn a_point_where_nothing_is_seen_has_no_value() {
    let folder = Folder::new();
    let json = folder.ok("section --line -4,0,0,0 --samples 2 --json").json();
    assert!(json["channels"][0]["values"][0].is_null());
    assert_close(json["channels"][0]["values"][1].as_f64().unwrap(), 0.316_677_297_547_093, 1e-14);
    folder.ok("section --line -4,0,0,0 --samples 2 -o line.csv");
    assert!(folder.text("line.csv").lines().any(|line| line == "-4,0,"), "{}", folder.text("line.csv"));
    let table = folder.ok("section --line -4,0,0,0 --samples 2").stdout;
    assert_eq!(
        table,
        "  x, m  y, m  brightness, W/m²\n    -4     0                 –\n     0     0    0.316677297547\n"
    );
}

#[test]
fn a_csv_section_says_what_it_is() {
    let folder = Folder::with("course.toml", COURSE);
    let outcome = folder.ok("section course.toml --row 300 --channel depth -o row.csv");
    let note = "row 300 runs at y = -0.666667 mm, half a pixel below the middle of the image; --horizontal 0 runs through it\n";
    assert_eq!((outcome.stdout.as_str(), outcome.stderr.as_str()), ("", format!("{note}wrote row.csv\n").as_str()));
    let text = folder.text("row.csv");
    for line in [
        "# Course: a sphere under two Lambertian lamps",
        "# section along row 300, y = -0.666667 mm",
        "# units: x, y in mm",
        "# units: depth in mm",
    ] {
        assert!(text.lines().any(|known| known == line), "{line}");
    }
    assert!(text.starts_with("# isophote ") && text.lines().next().unwrap().ends_with("convention course (3.4)"));
    assert_eq!(folder.ok("section course.toml --row 300 -o again.csv --quiet").stderr, "");
}

#[test]
fn a_plot_has_its_title_axes_and_units() {
    let folder = Folder::new();
    folder.ok("section --row 300 -o row.svg -o row.png -o row.csv");
    let svg = folder.text("row.svg");
    for text in [
        ">Lab 4: one sphere, one light: section along row 300, y = -0.005 m<",
        ">x, m<",
        ">brightness, W/m²<",
        "lab (3.3)",
    ] {
        assert!(svg.contains(text), "{text}");
    }
    let picture = folder.picture("row.png");
    assert!(picture.width > 800 && picture.height > 400);
    folder.ok("section --column 400 --channel diffuse --channel specular -o column.svg");
    let svg = folder.text("column.svg");
    for text in [">y, m<", ">values, W/m²<", ">diffuse<", ">specular<", "section along column 400, x = 0.005 m"] {
        assert!(svg.contains(text), "{text}");
    }
    folder.ok("section --line -1,-1,1,1 -o line.svg");
    assert!(folder.text("line.svg").contains(">distance along the line, m<"));
}

#[test]
fn several_channels_stand_side_by_side_in_the_table() {
    let folder = Folder::new();
    let table = folder.ok("section --line 0,0,0.5,0 --samples 2 --channel depth --channel irradiance").stdout;
    assert_eq!(table.lines().next().unwrap(), "  x, m  y, m       depth, m  irradiance, W/m²");
    assert_eq!(table.lines().nth(1).unwrap(), "     0     0              4     0.36284853589");
}

#[test]
fn lines_that_the_picture_does_not_have_are_refused() {
    let folder = Folder::new();
    folder.run("section --row 600").failed(2, &["there is no row 600: the image has rows 0 to 599"]);
    folder.run("section --column 800").failed(2, &["there is no column 800: the image has columns 0 to 799"]);
    folder.run("section --row -1").failed(2, &["-1"]);
    folder.run("section").failed(2, &["--through", "--horizontal", "--vertical", "--line", "--row", "--column"]);
    folder.run("section --row 1 --samples 5").failed(2, &["--samples does not go with --row and --column"]);
    folder.run("section --horizontal nan").failed(2, &["NaN is not a finite number"]);
    folder.run("section --through moon").failed(2, &["--through moon: there is no such shape; there are: ball"]);
    folder.run("section --line 0,0,1").failed(2, &["X0,Y0,X1,Y1"]);
    folder.run("section --line 0,0,1,nan").failed(2, &["NaN is not a finite number"]);
    folder.run("section --line 0,0,1,1 --samples 1").failed(2, &["2..=1000000"]);
    folder
        .run("section --row 1 --channel normal")
        .failed(2, &["a section cannot show `normal`", "brightness, irradiance"]);
    folder.run("section --row 1 -o row.exr").failed(2, &["allowed: .csv, .png, .svg"]);
    assert!(folder.names().is_empty());
}

#[test]
fn a_plot_of_different_units_is_refused_before_anything_is_written() {
    let folder = Folder::new();
    let refusal = "section --row 300 --channel depth --channel brightness -o row.csv -o row.svg";
    folder.run(refusal).failed(2, &["one plot cannot show different units: depth, m; brightness, W/m²"]);
    assert!(folder.names().is_empty(), "{:?}", folder.names());
    folder.ok("section --row 300 --channel depth --channel brightness -o row.csv");
}

/// The centre of the ball appears at (0, 0): both lines meet there, in the value of the probe P1.
#[test]
fn lines_run_through_the_centre_of_a_shape_by_its_name() {
    let folder = Folder::new();
    let json = folder.ok("section --through ball --samples 5 --json").json();
    let sections = json["sections"].as_array().unwrap();
    let names: Vec<&str> = sections.iter().map(|section| section["line"].as_str().unwrap()).collect();
    assert_eq!(names, ["y = 0 m, through \"ball\"", "x = 0 m, through \"ball\""]);
    assert_eq!(sections[0]["screen"], serde_json::json!([[-4, 0], [-2, 0], [0, 0], [2, 0], [4, 0]]));
    assert_eq!(sections[1]["screen"], serde_json::json!([[0, -3], [0, -1.5], [0, 0], [0, 1.5], [0, 3]]));
    for section in sections {
        assert_close(section["channels"][0]["values"][2].as_f64().unwrap(), 0.316_677_297_547_093, 1e-14);
    }
    // A centre beside the axis appears at f X/Z.
    let scene = LAB.replace("center = [0, 0, 5]", "center = [1.2, -0.6, 6]").replace("[[probe]]", "[[probes]]");
    let scene = scene.split("[[probes]]").next().unwrap();
    folder.write("aside.toml", scene);
    let json = folder.ok("section aside.toml --through ball --samples 2 --json").json();
    assert_eq!(json["sections"][0]["screen"], serde_json::json!([[-4, -0.5], [4, -0.5]]));
    assert_eq!(json["sections"][1]["screen"], serde_json::json!([[1, -3], [1, 3]]));
    folder.write("outside.toml", scene.replace("center = [1.2, -0.6, 6]", "center = [6, 0, 5]"));
    folder
        .run("section outside.toml --through ball")
        .failed(2, &["--through ball: its centre appears outside the image, at x = 6 m, y = 0 m"]);
}

#[test]
fn several_lines_share_a_table_a_file_and_a_plot() {
    let folder = Folder::new();
    let table = folder.ok("section --horizontal 0 --vertical 0.5 --samples 2").stdout;
    assert!(table.starts_with("y = 0 m\n") && table.contains("\n\nx = 0.5 m\n"), "{table}");
    folder.ok("section --horizontal 0 --horizontal 0.25 --row 0 -o lines.svg -o lines.csv");
    let svg = folder.text("lines.svg");
    for text in [">x, m<", ">y = 0 m<", ">y = 0.25 m<", ">row 0, y = 2.995 m<", "section along several lines"] {
        assert!(svg.contains(text), "{text}");
    }
    let csv = folder.text("lines.csv");
    assert!(csv.contains("\nsection,x,y,brightness\n\"y = 0 m\",-4,0,\n"), "{csv}");
    folder.ok("section --through ball -o both.svg");
    assert!(folder.text("both.svg").contains(">x or y, m<"));
    folder.ok("section --line -1,0.5,1,0.5 -o level.svg");
    let svg = folder.text("level.svg");
    assert!(svg.contains(">x, m<") && svg.contains("the line from (-1, 0.5) to (1, 0.5) m"), "{svg}");
}

#[test]
fn a_row_half_a_pixel_beside_the_middle_says_so() {
    let folder = Folder::new();
    let told = |arguments: &str| folder.ok(arguments).stderr;
    assert_eq!(
        told("section --row 299 --json"),
        "row 299 runs at y = 0.005 m, half a pixel above the middle of the image; --horizontal 0 runs through it\n"
    );
    assert_eq!(
        told("section --column 399 --json"),
        "column 399 runs at x = -0.005 m, half a pixel to the left of the middle of the image; --vertical 0 runs through it\n"
    );
    for silent in ["section --row 298 --json", "section --row 299 --json --quiet", "section --horizontal 0 --json"] {
        assert_eq!(told(silent), "", "{silent}");
    }
}
