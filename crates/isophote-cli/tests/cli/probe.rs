//! Exact values at points.

use crate::common::{COURSE, Folder, LAB, PHOTOMETRIC, ROOM, TWO_LIGHTS, assert_close};

const P2: f64 = 0.137_736_208_646_845;
const P4: f64 = 0.260_714_199_906_064;

fn brightness(probe: &serde_json::Value) -> f64 {
    probe["channels"]["brightness"]["value"].as_f64().unwrap()
}

#[test]
fn without_a_place_the_probes_of_the_scene_are_read() {
    let folder = Folder::new();
    let outcome = folder.ok("probe");
    let row = outcome.row("P4");
    assert_eq!(row[1..], ["(0.353553,", "0.353553,", "4.13397)", "0.410002735970075", "0.260714199906064", "0.66"]);
    assert_eq!(outcome.stderr, "");
    let folder = Folder::with("two.toml", TWO_LIGHTS);
    folder.run("probe two.toml").failed(2, &["the scene has no probes", "--at", "--pixel", "--angles"]);
}

#[test]
fn angles_from_the_direction_to_the_viewer_find_the_labs_points() {
    let folder = Folder::new();
    let json = folder.ok("probe --angles 45,0 --angles 45,90 --angles 30,45 --angles 0,0 --json").json();
    let probes = json["probes"].as_array().unwrap();
    for (probe, expected) in probes.iter().zip([P2, P2, P4, 0.316_677_297_547_093]) {
        assert_close(brightness(probe), expected, 1e-14);
    }
    assert_eq!(probes[0]["name"], "θ 45°, φ 0°");
    assert_close(probes[0]["point"][0].as_f64().unwrap(), 0.5_f64.sqrt(), 1e-15);
    assert_close(probes[2]["point"][2].as_f64().unwrap(), 5.0 - 0.75_f64.sqrt(), 1e-15);
}

#[test]
fn angles_need_the_name_of_a_sphere_where_there_are_several() {
    let folder = Folder::with("two.toml", TWO_LIGHTS);
    folder.run("probe two.toml --angles 0,0").failed(2, &["--shape", "large, small"]);
    folder.run("probe two.toml --angles 0,0 --shape medium").failed(2, &["large, small"]);
    let json = folder.ok("probe two.toml --angles 0,0 --shape small --json").json();
    assert_eq!(json["probes"][0]["shape"], "small");
}

#[test]
fn a_pixels_value_is_the_maps_but_for_rounding() {
    let folder = Folder::with("two.toml", TWO_LIGHTS);
    folder.ok("render two.toml --channel brightness --channel light.right -o map.csv");
    let table = folder.csv("map.csv");
    let json = folder.ok("probe two.toml --pixel 250,300 --pixel 520,330 --json").json();
    for (probe, index) in json["probes"].as_array().unwrap().iter().zip([300 * 800 + 250, 330 * 800 + 520]) {
        // Both are within 1e-12 of the formula; a map's pixels are computed several at a time, by other roundings.
        assert_close(brightness(probe), table.column_at("brightness", index), 1e-12);
        let light = probe["lights"][1]["irradiance"].as_f64().unwrap();
        assert_close(light, table.column_at("light.right", index), 1e-12);
        assert!(brightness(probe) > 0.1);
    }
    folder.run("probe two.toml --pixel 0,0").failed(2, &["no surface is seen at column 0, row 0"]);
    folder.run("probe two.toml --pixel 800,0").failed(2, &["there is no pixel at column 800, row 0"]);
}

#[test]
fn several_places_of_all_kinds_are_read_in_one_run() {
    let folder = Folder::new();
    let outcome = folder.ok("probe --at 0,0,4 --at 1,0,5 --pixel 400,300 --angles 30,45");
    let first_words: Vec<&str> = outcome.stdout.lines().filter_map(|line| line.split_whitespace().next()).collect();
    assert_eq!(first_words, ["probe", "(0,", "(1,", "pixel", "θ", "(1,"], "{}", outcome.stdout);
    let note = "(1, 0, 5) is not seen from the eye: the surface faces away there (θ_o ≥ 90°)";
    assert!(outcome.stdout.contains(note), "{}", outcome.stdout);
    let seen: Vec<&str> = outcome.stdout.lines().take(5).filter_map(|line| line.split_whitespace().last()).collect();
    assert_eq!(seen, ["seen", "yes", "NO", "yes", "yes"], "{}", outcome.stdout);
    assert!(!outcome.stdout.contains("published"), "a column for nothing");
}

#[test]
fn the_labs_printed_point_is_refused_with_its_distance_and_the_nearest_point() {
    let folder = Folder::new();
    let refusal = folder
        .run("probe --at 0.353,0.353,4.830")
        .failed(2, &["it is 0.472631 m inside the surface of \"ball\"", "--snap"]);
    // C + (P − C)/‖P − C‖.
    let offset = [0.353, 0.353, 4.830 - 5.0];
    let length = offset.iter().map(|component: &f64| component * component).sum::<f64>().sqrt();
    let list = refusal.stderr.split(['[', ']']).nth(1).unwrap();
    let nearest: Vec<f64> = list.split(", ").map(|number| number.parse().unwrap()).collect();
    for (coordinate, (component, center)) in nearest.iter().zip(offset.iter().zip([0.0, 0.0, 5.0])) {
        assert_close(*coordinate, center + component / length, 1e-14);
    }
    // With another, good point in the same run nothing is printed either.
    folder.run("probe --at 0,0,4 --at 0.353,0.353,4.830").failed(2, &["0.472631 m"]);
    // All refusals come in one run.
    folder.run("probe --at 0,0,3 --at 0,0,2 --pixel 0,0").failed(2, &["(0, 0, 3)", "(0, 0, 2)", "no surface is seen"]);
    folder.run("probe --at 1e300,0,0").failed(2, &["too far away; allowed: up to 1e15 m"]);
    // The point that was meant is refused too, and says by how little it misses.
    folder.run("probe --at 0.354,0.354,4.134").failed(2, &["0.000293957 m outside"]);
}

#[test]
fn snap_moves_a_point_to_the_nearest_surface_and_keeps_one_that_is_there() {
    let folder = Folder::new();
    let result = folder.ok("probe --snap --at 0.353,0.353,4.830 --at 0,0,4 --json");
    assert_eq!(result.stderr.matches("was moved by").count(), 1, "the second point stays where it is");
    assert!(result.stderr.starts_with("(0.353, 0.353, 4.83) was moved by 0.472631 m to [0.669"), "{}", result.stderr);
    let json = result.json();
    assert_close(json["probes"][0]["point"][2].as_f64().unwrap(), 4.677_645_028_437_401, 1e-15);
    assert_eq!(json["probes"][1]["point"], serde_json::json!([0, 0, 4]));
    folder.run("probe --snap").failed(2, &["--at"]);
}

#[test]
fn points_and_distances_are_in_the_unit_of_the_scene_and_values_per_square_metre() {
    let folder = Folder::with("course.toml", COURSE);
    let json = folder.ok("probe course.toml --at 0,0,-300 --json").json();
    assert_eq!(json["length"], "mm");
    let probe = &json["probes"][0];
    assert_eq!(probe["point"], serde_json::json!([0, 0, -300]));
    // By hand, in metres: the key light at (0.9, 1.2, −1.5), aimed at the origin; r² = 3.69.
    let r = 3.69_f64.sqrt();
    let [intensity, cosine] = [1000.0 * 4.05 / (4.5_f64.sqrt() * r), 1.2 / r];
    let key = &probe["lights"][0];
    assert_close(key["distance"].as_f64().unwrap(), 1000.0 * r, 1e-15);
    assert_close(key["intensity"].as_f64().unwrap(), intensity, 1e-15);
    assert_close(key["cos_theta_i"].as_f64().unwrap(), cosine, 1e-15);
    assert_close(key["irradiance"].as_f64().unwrap(), intensity * cosine / 3.69, 1e-14);
    // The fill light: 600 W over a Lambertian lamp, axis (1, 0, 0.5); r² = 2.5.
    let fill = 600.0 / std::f64::consts::PI * 1.75 / (1.25_f64 * 2.5).sqrt() * 0.5 / 2.5_f64.sqrt() / 2.5;
    assert_close(probe["lights"][1]["irradiance"].as_f64().unwrap(), fill, 1e-14);
    assert_eq!(probe["channels"]["brightness"]["unit"], "W/(m²·sr)");
    let table = folder.ok("probe course.toml").stdout;
    assert!(table.contains("point, mm") && table.contains("(0, 0, -300)"), "{table}");
    folder.run("probe course.toml --at 0,0,-301").failed(2, &["it is 1 mm outside the surface of \"ball\""]);
}

#[test]
fn a_photometric_scene_gives_lux_and_candela_per_square_metre() {
    let folder = Folder::with("photometric.toml", PHOTOMETRIC);
    let json = folder.ok("probe photometric.toml --json").json();
    let channels = &json["probes"][0]["channels"];
    assert_eq!((&channels["irradiance"]["unit"], &channels["brightness"]["unit"]), (&"lx".into(), &"cd/m²".into()));
    // E = (800 lm/π)/(1.5 m)², B = 0.85 E/π.
    let illuminance = 800.0 / std::f64::consts::PI / 2.25;
    assert_close(channels["irradiance"]["value"].as_f64().unwrap(), illuminance, 1e-15);
    assert_close(channels["brightness"]["value"].as_f64().unwrap(), 0.85 * illuminance / std::f64::consts::PI, 1e-15);
}

#[test]
fn json_has_the_promised_structure() {
    let folder = Folder::new();
    let json = folder.ok("probe --json").json();
    let keys = |value: &serde_json::Value| {
        value.as_object().unwrap().keys().cloned().collect::<std::collections::BTreeSet<_>>()
    };
    let has = |value: &serde_json::Value, promised: &[&str]| promised.iter().all(|key| keys(value).contains(*key));
    let probes = json["probes"].as_array().unwrap();
    assert_eq!(probes.len(), 4);
    for probe in probes {
        assert!(has(probe, &["name", "point", "normal", "shape", "channels", "lights"]), "{probe}");
        assert_eq!(
            keys(&probe["channels"]),
            ["brightness", "diffuse", "irradiance", "specular"].map(String::from).into()
        );
        for channel in ["brightness", "irradiance", "diffuse", "specular"] {
            assert_eq!(keys(&probe["channels"][channel]), ["unit", "value"].map(String::from).into());
            assert_eq!(probe["channels"][channel]["unit"], "W/m²");
        }
        assert!(has(&probe["lights"][0], &["name", "irradiance", "cos_theta_i", "distance"]), "{probe}");
        assert_eq!((&probe["shape"], &probe["lights"][0]["name"]), (&"ball".into(), &"lamp".into()));
    }
    assert_eq!((&probes[3]["name"], &probes[3]["published"]), (&"P4".into(), &0.66.into()));
}

#[test]
fn json_numbers_have_the_digits_that_tell_every_double_apart() {
    let folder = Folder::new();
    let text = folder.ok("probe --at 0,0,4 --json").stdout;
    // The shortest forms of these doubles are 0.3166772975470928 and 0.97278142413614: always 17 digits, zeros cut.
    assert!(
        text.contains("\"value\": 0.31667729754709278,") && text.contains("\"cos_theta_h\": 0.97278142413613999,"),
        "{text}"
    );
    let scene = isophote::scene::Scene::from_text("lab", LAB, isophote::scene::Syntax::Toml).unwrap();
    let prepared = isophote::prepare::PreparedScene::new(&scene);
    let place = isophote::analysis::probe::ProbePosition::Angles {
        shape: 0,
        theta: 1.1_f64.to_radians(),
        phi: 77.7_f64.to_radians(),
    };
    let exact = prepared.probe(&place).unwrap().shading.brightness();
    let json = folder.ok("probe --angles 1.1,77.7 --json").json();
    assert_eq!(brightness(&json["probes"][0]).to_bits(), exact.to_bits());
}

#[test]
fn a_point_seen_from_inside_has_its_normal_turned_to_the_eye() {
    let folder = Folder::with("room.toml", ROOM);
    let probe = &folder.ok("probe room.toml --at 0,0,-2 --json -q").json()["probes"][0];
    assert_eq!(probe["normal"], serde_json::json!([0, 0, 1]));
    // The bulb at height 1: E = 10 · (2/√5)/5 = 4/√5; the moon behind the wall gives nothing.
    assert_close(probe["channels"]["irradiance"]["value"].as_f64().unwrap(), 4.0 / 5.0_f64.sqrt(), 1e-15);
    assert_eq!((&probe["lights"][1]["visibility"], &probe["lights"][1]["irradiance"]), (&0.into(), &0.into()));
}

#[test]
fn explain_and_json_exclude_each_other() {
    Folder::new().run("probe --explain --json").failed(2, &["--explain", "--json"]);
}

#[test]
fn a_point_behind_the_camera_is_hidden_by_what_stands_before_it() {
    let cover = "[[sphere]]\nname = \"cover\"\ncenter = [0, 0, -3]\nradius = 0.5\nmaterial = \"clay\"\n\n";
    let back = "[[sphere]]\nname = \"back\"\ncenter = [0, 0, -5]\nradius = 1\nmaterial = \"clay\"\n\n";
    let folder = Folder::with("behind.toml", LAB.replacen("[[light]]", &format!("{cover}{back}[[light]]"), 1));
    let table = folder.ok("probe behind.toml --at 0,0,-4 --at 0,0,-2.5").stdout;
    assert!(table.contains("(0, 0, -4) is not seen from the eye: \"cover\" stands before it"), "{table}");
    assert_eq!(table.matches("is not seen").count(), 1, "nothing stands before the cover: {table}");
    let json = folder.ok("probe behind.toml --at 0,0,-4 --at 0,0,-2.5 --json").json();
    let told = |index: usize| [&json["probes"][index]["seen"], &json["probes"][index]["unseen_because"]];
    assert_eq!(told(0), [&serde_json::json!(false), &serde_json::json!("\"cover\" stands before it")]);
    assert_eq!(told(1), [&serde_json::json!(true), &serde_json::Value::Null]);
    let scene = folder.text("behind.toml");
    folder.write("hidden.toml", scene.replace("radius = 0.5", "radius = 0.8"));
    let surface = folder.ok("surface hidden.toml --shape back --channel brightness --json").json();
    assert_eq!(surface["max"]["unseen_because"], "\"cover\" stands before it");
    let surface = folder.ok("surface hidden.toml --shape back --channel brightness").stdout;
    assert!(surface.contains(", which the eye does not see: \"cover\" stands before it"), "{surface}");
}
