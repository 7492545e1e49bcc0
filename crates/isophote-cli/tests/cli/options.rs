//! What the options of `render` choose.

use png::{BitDepth, ColorType};

use crate::common::{COURSE, Csv, Folder, LAB, TWO_LIGHTS, bits};

#[test]
fn channel_chooses_what_is_summarised_and_written() {
    let folder = Folder::new();
    let outcome = folder.ok("render --size 40x30 --channel depth --channel light.lamp -o map.csv");
    assert_eq!(folder.csv("map.csv").names.join(","), "column,row,x,y,shape,depth,light.lamp");
    assert_eq!(outcome.row("channel")[1..], ["depth,", "m"]);
    let depths: Vec<f64> = folder.csv("map.csv").column("depth").into_iter().filter(|&depth| depth > 0.0).collect();
    let nearest = depths.iter().copied().fold(f64::INFINITY, f64::min);
    assert_eq!(outcome.row("minimum")[1], isophote::text::significant(nearest, 12));
}

#[test]
fn the_irradiances_of_the_lights_add_up_to_the_irradiance() {
    let folder = Folder::with("two.toml", TWO_LIGHTS);
    folder.ok("render two.toml --size 60x45 --lights -o map.csv");
    let table = folder.csv("map.csv");
    let [left, right, sum] = ["light.left", "light.right", "irradiance"].map(|name| table.column(name));
    assert!(left.iter().zip(&right).any(|(left, right)| *left > 0.0 && *right == 0.0), "some see only one light");
    for ((left, right), sum) in left.iter().zip(&right).zip(&sum) {
        assert!((left + right - sum).abs() <= 1e-15 * sum);
    }
}

#[test]
fn size_replaces_the_resolution_of_the_scene() {
    let folder = Folder::with("lab.toml", LAB);
    let outcome = folder.ok("render lab.toml --size 80×60 -o map.png");
    assert_eq!(outcome.row("image")[1..], ["80", "×", "60", "pixels"]);
    let picture = folder.picture("map.png");
    assert_eq!((picture.width, picture.height, picture.color), (80, 60, ColorType::Grayscale));
    assert_eq!(folder.names(), ["lab.toml", "map.png"], "with a scene nothing is written unasked");
}

#[test]
fn a_region_holds_the_very_numbers_of_the_whole() {
    let folder = Folder::with("course.toml", COURSE);
    folder.ok("render course.toml --size 70x70 -o whole.csv");
    let outcome = folder.ok("render course.toml --size 70x70 --region 11,23,37,19 -o part.csv -o part.png");
    let whole = folder.csv("whole.csv");
    let inside = |row: &&Vec<f64>| (11.0..48.0).contains(&row[0]) && (23.0..42.0).contains(&row[1]);
    let cropped: Vec<&Vec<f64>> = whole.rows.iter().filter(inside).collect();
    let part = folder.csv("part.csv").rows;
    assert_eq!((part.len(), cropped.len()), (37 * 19, 37 * 19));
    for (row, whole) in part.iter().zip(cropped) {
        assert_eq!(row[..2], whole[..2], "the pixel, counted in the whole image");
        assert_eq!(bits(&row[2..]), bits(&whole[2..]), "the place and every value agree to the last bit");
    }
    assert!(outcome.stdout.contains("of these 37 × 19 from column 11, row 23"), "{}", outcome.stdout);
    let picture = folder.picture("part.png");
    assert_eq!((picture.width, picture.height, picture.color), (37, 19, ColorType::Grayscale));
}

#[test]
fn a_regions_exr_file_lies_in_the_whole_image_by_its_data_window() {
    use exr::prelude::{ReadChannels, ReadLayers, Vec2};
    let folder = Folder::new();
    folder.ok("render --size 80x60 --region 30,20,16,12 -o part.exr");
    let reader = exr::prelude::read().no_deep_data().largest_resolution_level().all_channels().first_valid_layer();
    let image = reader.all_attributes().from_file(folder.path("part.exr")).unwrap();
    assert_eq!(image.layer_data.attributes.layer_position, Vec2(30, 20));
    assert_eq!(image.layer_data.size, Vec2(16, 12));
    assert_eq!(image.attributes.display_window.size, Vec2(80, 60));
}

#[test]
fn visible_only_leaves_out_the_rows_where_nothing_is_seen() {
    let folder = Folder::new();
    folder.ok("render --size 40x30 -o all.csv");
    folder.ok("render --size 40x30 --visible-only -o visible.csv");
    let all = folder.csv("all.csv");
    let rows: Vec<Vec<f64>> = all.rows.iter().filter(|row| row[4] >= 0.0).cloned().collect();
    assert!(!rows.is_empty() && rows.len() < 1200);
    assert_eq!(folder.csv("visible.csv"), Csv { names: all.names, rows });
}

#[test]
fn any_number_of_threads_gives_the_same_bytes() {
    let folder = Folder::with("two.toml", TWO_LIGHTS);
    let outputs: Vec<String> = (1..=3)
        .map(|threads| {
            let files = format!("-o {threads}.csv -o {threads}.exr -o {threads}.png -o {threads}.npz");
            folder.ok(&format!("render two.toml --size 90x70 --threads {threads} {files}")).stdout
        })
        .collect();
    assert!(outputs[0] == outputs[1] && outputs[0] == outputs[2]);
    for suffix in ["csv", "exr", "png", "npz"] {
        let [first, second, third] = [1, 2, 3].map(|threads| folder.read(&format!("{threads}.{suffix}")));
        assert!(first == second && first == third, "{suffix}");
    }
}

#[test]
fn json_says_what_the_text_says_with_all_digits() {
    let folder = Folder::with("lab.toml", LAB);
    let text = folder.ok("render lab.toml --size 200x150 -o map.csv");
    let json = folder.ok("render lab.toml --size 200x150 --json").json();
    let table = folder.csv("map.csv");
    let brightness = table.column("brightness");
    let maximum = brightness.iter().copied().fold(0.0, f64::max);
    assert_eq!(json["max"]["value"].as_f64().unwrap().to_bits(), maximum.to_bits());
    let significant = |value: &serde_json::Value| isophote::text::significant(value.as_f64().unwrap(), 12);
    let row = text.row("maximum");
    assert_eq!(row[1], significant(&json["max"]["value"]));
    assert_eq!(row[5], format!("{},", json["max"]["pixel"][0]));
    assert_eq!(row[7], format!("{},", json["max"]["pixel"][1]));
    let pixel = json["max"]["pixel"][1].as_u64().unwrap() * 200 + json["max"]["pixel"][0].as_u64().unwrap();
    let index = usize::try_from(pixel).unwrap();
    assert_eq!(brightness[index].to_bits(), maximum.to_bits());
    assert_eq!(json["max"]["point"][2].as_f64().unwrap().to_bits(), table.column("position.z")[index].to_bits());
    assert_eq!(text.row("mean")[1], significant(&json["mean"]));
    assert_eq!(text.row("visible")[1], json["visible_pixels"].to_string());
    assert_eq!(text.row("lit")[1], json["lit_pixels"].to_string());
    assert_eq!(json["resolution"], serde_json::json!([200, 150]));
    assert_eq!((&json["convention"], &json["formula"]), (&"lab".into(), &"3.3".into()));
    assert_eq!((&json["unit"], &json["length"], &json["pixels"]), (&"W/m²".into(), &"m".into(), &30000.into()));
    let names: Vec<&str> =
        json["probes"].as_array().unwrap().iter().map(|probe| probe["name"].as_str().unwrap()).collect();
    assert_eq!(names, ["P1", "P2", "P3", "P4"]);
    assert_eq!(json["probes"][0]["published"], 0.6);
}

#[test]
fn quiet_leaves_standard_error_empty_and_the_results_as_they_are() {
    let folder = Folder::with("room.toml", crate::common::ROOM);
    let loud = folder.ok("render room.toml -o loud.png");
    let quiet = folder.ok("render room.toml -o quiet.png --quiet");
    assert_eq!(quiet.stderr, "");
    assert!(loud.stderr.contains("warning:") && loud.stderr.contains("wrote loud.png"), "{}", loud.stderr);
    assert_eq!(loud.stdout, quiet.stdout);
    assert_eq!(folder.read("loud.png"), folder.read("quiet.png"));
}

#[test]
fn a_scene_without_anything_to_see_says_so_and_makes_a_black_picture() {
    let (head, _) = LAB.split_once("[[sphere]]").unwrap();
    let folder = Folder::with("empty.toml", head);
    let outcome = folder.ok("render empty.toml --size 8x6 -o map.png -o map.csv");
    assert!(outcome.stdout.contains("no surface is seen"), "{}", outcome.stdout);
    assert!(outcome.stderr.contains("the scene has no shapes") && outcome.stderr.contains("the scene has no lights"));
    assert!(folder.picture("map.png").levels(BitDepth::Eight).iter().all(|&level| level == 0.0));
    assert_eq!(folder.csv("map.csv").rows.len(), 48);
    assert!(folder.ok("render empty.toml --size 8x6 --json -q").json()["max"].is_null());
}

#[test]
fn options_that_do_nothing_are_named() {
    let folder = Folder::new();
    let notes = folder.ok("render --size 8x6 --gamma 2 --bits 16 --visible-only -o map.npy").stderr;
    for option in ["--gamma", "--bits", "--visible-only"] {
        assert!(notes.contains(&format!("{option} has no effect")), "{notes}");
    }
    assert!(!folder.ok("render --size 8x6 --gamma 2 --visible-only -o map.png -o map.csv").stderr.contains("effect"));
    folder.run("section --row 3 --samples 5").failed(2, &["--samples does not go with --row"]);
}

/// Two balls and their shadows, in an image that takes no time.
const SHADOWS: &str = include_str!("../../../../scenes/shadows.toml");

#[test]
fn pixels_that_the_rays_do_not_assure_are_counted() {
    let folder = Folder::with("shadows.toml", SHADOWS.replace("[400, 300]", "[60, 45]"));
    let few = folder.ok("render shadows.toml --samples 16 --quiet --json").json();
    let count = few["over_tolerance"].as_u64().expect("it has a tolerance");
    assert!(count > 0 && count < few["refined"].as_u64().unwrap(), "{few}");
    let text = folder.ok("render shadows.toml --samples 16 --quiet").stdout;
    assert!(text.contains(&format!("  tolerance   not assured in {count} pixels by 16 rays each\n")), "{text}");
    let russian = folder.ok("render shadows.toml --samples 16 --quiet --lang ru").stdout;
    let told = format!("  допуск      не гарантирован; таких пикселей: {count}; лучей на каждый: 16\n");
    assert!(russian.contains(&told), "{russian}");
    let many = folder.ok("render shadows.toml --quiet --json").json();
    assert_eq!(many["over_tolerance"], 0);
    assert!(!folder.ok("render shadows.toml --quiet").stdout.contains("not assured"));
    let plain = SHADOWS.replace("[400, 300]", "[60, 45]").replace("tolerance = 0.01", "samples = 4");
    let plain = Folder::with("shadows.toml", plain);
    assert!(plain.ok("render shadows.toml --quiet --json").json().get("over_tolerance").is_none());
}
