//! What the page is told is what the core computes.

use isophote::analysis::probe::ProbePosition;
use isophote::analysis::section::SectionLine;
use isophote::analysis::statistics::counts;
use isophote::lanes::Precision;
use isophote::map::{Pixel, Quantity};
use isophote::prepare::PreparedScene;
use isophote::render::{RenderSettings, Renderer, SimdRenderer};
use isophote::scene::{Scene, Syntax, library::Starter};
use isophote::units::Keyword;
use isophote_web::Core;
use serde_json::{Value, json};

/// A core that holds a starter scene, which was handed over as JSON, and the same scene as the core's own reader has it.
fn loaded(starter: Starter) -> (Core, PreparedScene, Value) {
    let scene = Scene::from_text("", starter.text(), Syntax::Toml).unwrap();
    let mut core = Core::new();
    let read = parsed(&core.read(starter.text(), "toml").unwrap());
    assert_eq!(read["problems"].as_array().unwrap().len(), scene.warnings().len());
    let checked = parsed(&core.load(&read["scene"].to_string()).unwrap());
    (core, PreparedScene::new(&scene), checked)
}

fn parsed(json: &str) -> Value {
    serde_json::from_str(json).unwrap()
}

#[test]
fn bands_of_a_map_are_the_map() {
    for starter in Starter::ALL {
        let (mut core, prepared, checked) = loaded(*starter);
        let quantities = vec![Quantity::Brightness, Quantity::Irradiance];
        let map = SimdRenderer::new(Precision::Double, None)
            .render(&prepared, &RenderSettings { quantities, ..RenderSettings::default() })
            .unwrap();
        let expected: Vec<f64> = map.scalar(&Quantity::Brightness).unwrap().iter().collect();
        let height = u32::try_from(checked["info"]["resolution"][1].as_u64().unwrap()).unwrap();
        let (mut values, mut shapes, mut lit) = (Vec::new(), Vec::new(), 0);
        for (first, count) in [(0, 7), (7, height - 7)] {
            let mut band = core.render("brightness", first, count, 1).unwrap();
            let head = parsed(&band.head());
            assert_eq!(head["height"], count);
            lit += head["lit"].as_u64().unwrap();
            values.extend(band.take_values());
            shapes.extend(band.take_shapes());
        }
        assert_eq!(values, expected, "{}", starter.name());
        assert_eq!(shapes, map.mask().shapes());
        assert_eq!(Some(usize::try_from(lit).unwrap()), counts(&map).lit);
    }
}

#[test]
fn a_preview_has_half_the_pixels_of_the_same_window() {
    let (mut core, ..) = loaded(Starter::Lab);
    let head = parsed(&core.render("brightness", 0, 300, 2).unwrap().head());
    assert_eq!((&head["width"], &head["height"]), (&json!(400), &json!(300)));
    assert_eq!(head["window"], json!({"x": [-4.0, 4.0], "y": [-3.0, 3.0]}));
}

#[test]
fn a_small_map_shows_the_same_window_in_two_hundred_pixels() {
    let (mut core, prepared, _) = loaded(Starter::TwoLights);
    let name = format!("brightness.{}", prepared.scene().lights()[0].name);
    let mut band = core.thumbnail(&name).unwrap();
    let head = parsed(&band.head());
    assert_eq!((&head["channel"], &head["width"], &head["height"]), (&json!(name), &json!(200), &json!(150)));
    let whole = parsed(&core.render("brightness", 0, 600, 1).unwrap().head());
    assert_eq!(head["window"], whole["window"]);
    let (values, shapes) = (band.take_values(), band.take_shapes());
    assert_eq!((values.len(), shapes.len()), (200 * 150, 200 * 150));
    // The lights alone add up to the whole: this scene has no ambient light.
    let others = prepared.scene().lights().iter().skip(1).map(|light| format!("brightness.{}", light.name));
    let mut sum = values;
    for name in others {
        let one = core.thumbnail(&name).unwrap().take_values();
        sum.iter_mut().zip(one).for_each(|(sum, value)| *sum += value);
    }
    let whole = core.thumbnail("brightness").unwrap().take_values();
    let largest = whole.iter().copied().fold(0.0, f64::max);
    assert!(largest > 0.0 && sum.iter().zip(&whole).all(|(sum, value)| (sum - value).abs() <= 1e-12 * largest));
    let preview = core.render(&name, 0, 300, 2).unwrap().take_values();
    assert_eq!(preview.len(), 400 * 300);
}

#[test]
fn statistics_and_isophotes_are_those_of_the_frame() {
    let (mut core, prepared, _) = loaded(Starter::Lab);
    let mut band = core.render("brightness", 0, 600, 1).unwrap();
    let (values, shapes) = (band.take_values(), band.take_shapes());
    let analysis = parsed(&core.analyse(&band.head(), values.clone(), shapes.clone(), "[0.1, 0.3]").unwrap());
    let statistics = &analysis["statistics"];
    assert_eq!((&statistics["visible"], &statistics["lit"]), (&json!(32_744), &json!(32_059)));
    assert_eq!(statistics["max"]["pixel"], json!([418, 281]));
    let reading = prepared.probe(&ProbePosition::Pixel(Pixel { column: 418, row: 281 })).unwrap();
    assert_eq!(statistics["max"]["point"], json!(reading.position(prepared.scene().length())));
    let levels: Vec<f64> =
        analysis["isophotes"].as_array().unwrap().iter().map(|one| one["level"].as_f64().unwrap()).collect();
    assert_eq!(levels, [0.1, 0.3]);
    assert!(!analysis["isophotes"][0]["lines"][0]["points"].as_array().unwrap().is_empty());
    let about = parsed(&core.analyse(&band.head(), values, shapes, "8").unwrap());
    assert!((4..=16).contains(&about["isophotes"].as_array().unwrap().len()));
}

#[test]
fn readings_are_the_probes_of_the_core_to_the_last_bit() {
    let (core, prepared, _) = loaded(Starter::TwoLights);
    let requests = json!([{"name": "pixel", "pixel": [400, 300]}, {"name": "sky", "screen": [1e9, 1e9]}]);
    let probed = parsed(&core.probe(&requests.to_string()).unwrap());
    let reading = prepared.probe(&ProbePosition::Pixel(Pixel { column: 400, row: 300 })).unwrap();
    let answer = &probed[0]["reading"];
    assert_eq!(answer["brightness"].as_f64().unwrap(), reading.shading.brightness());
    assert_eq!(answer["irradiance"].as_f64().unwrap(), reading.shading.irradiance);
    for (index, light) in answer["lights"].as_array().unwrap().iter().enumerate() {
        assert_eq!(light["irradiance"].as_f64().unwrap(), reading.terms[index].irradiance);
        let shares = [&light["diffuse"], &light["specular"]].map(|share| share.as_f64().unwrap());
        assert_eq!(shares, reading.light_shares(&prepared, index));
    }
    assert_eq!(probed[1]["reading"], Value::Null);
    assert!(probed[1]["error"].as_str().unwrap().contains("no surface"));
}

#[test]
fn an_explanation_has_a_block_for_the_geometry_each_light_and_the_sum() {
    let (core, ..) = loaded(Starter::TwoLights);
    let explanation = parsed(&core.explain(r#"{"name": "P", "pixel": [400, 300]}"#).unwrap());
    let titles: Vec<&str> =
        explanation["blocks"].as_array().unwrap().iter().map(|block| block["title"].as_str().unwrap()).collect();
    assert!(titles[0].starts_with("Geometry"), "{titles:?}");
    assert!(titles[1].starts_with("Light 1") && titles[2].starts_with("Light 2"), "{titles:?}");
    assert!(titles.len() > 3, "{titles:?}");
    let has_lines = |block: &Value| !block["lines"].as_array().unwrap().is_empty();
    assert!(explanation["blocks"].as_array().unwrap().iter().all(has_lines));
}

#[test]
fn a_section_through_a_shape_is_a_horizontal_and_a_vertical_line() {
    let (core, prepared, _) = loaded(Starter::Lab);
    let sections =
        parsed(&core.section(r#"[{"kind": "through", "shape": "ball"}]"#, r#"["brightness", "irradiance"]"#).unwrap());
    let [across, down] = sections.as_array().unwrap().as_slice() else { panic!("{sections}") };
    assert_eq!((&across["axis"], &down["axis"]), (&json!("x"), &json!("y")));
    let line = SectionLine::Between { from: [-4.0, 0.0], to: [4.0, 0.0], samples: 513 };
    let expected: Vec<Option<f64>> = prepared
        .section(line)
        .unwrap()
        .iter()
        .map(|sample| sample.seen.as_ref().map(|(_, shading)| shading.brightness()))
        .collect();
    assert_eq!(across["values"]["brightness"], json!(expected));
    assert_eq!(across["units"]["irradiance"], "W/m²");
}

#[test]
fn the_areas_of_the_plane_task_are_read() {
    let (core, prepared, checked) = loaded(Starter::CoursePlane);
    let areas = parsed(&core.areas().unwrap());
    let expected = prepared.area(&prepared.scene().areas()[0]).unwrap();
    assert_eq!(areas[0]["max"]["value"].as_f64().unwrap(), expected.max.value);
    assert_eq!(areas[0]["mean"].as_f64().unwrap(), expected.mean);
    // The window of parallel rays lies in the plane through the eye.
    assert_eq!(checked["info"]["camera"]["corners"][2], json!([500.0, 400.0, 2000.0]));
}

#[test]
fn a_wrong_scene_is_told_with_places_and_the_last_one_stays() {
    let (mut core, ..) = loaded(Starter::Lab);
    let mut scene = parsed(&core.read(Starter::Lab.text(), "toml").unwrap())["scene"].clone();
    scene["sphere"][0]["radius"] = json!(-1);
    scene["light"][0]["intensity"] = json!("bright");
    let checked = parsed(&core.load(&scene.to_string()).unwrap());
    assert_eq!(checked["info"], Value::Null);
    let paths: Vec<&str> =
        checked["problems"].as_array().unwrap().iter().map(|problem| problem["path"].as_str().unwrap()).collect();
    assert!(paths.contains(&"sphere[0].radius") && paths.contains(&"light[0].intensity"), "{paths:?}");
    assert!(core.render("brightness", 0, 10, 1).is_ok());
}

#[test]
fn text_that_is_half_a_scene_gives_what_can_be_read() {
    let core = Core::new();
    let read = parsed(&core.read("version = 1\nlength = \"mm\"\n[camera]\neye = [0, 0", "toml").unwrap());
    assert_eq!(read["scene"]["length"], "mm");
    assert!(!read["problems"].as_array().unwrap().is_empty());
    assert_eq!(parsed(&core.read("", "toml").unwrap())["scene"], Value::Null);
}

#[test]
fn every_shape_is_told_with_the_place_where_it_is_written() {
    let text = std::fs::read_to_string("../../scenes/solids.toml").unwrap();
    let mut core = Core::new();
    let read = parsed(&core.read(&text, "toml").unwrap());
    let info = &parsed(&core.load(&read["scene"].to_string()).unwrap())["info"];
    for shape in info["shapes"].as_array().unwrap() {
        let path = shape["path"].as_str().unwrap();
        let (kind, index) = path.strip_suffix(']').unwrap().split_once('[').unwrap();
        let written = &read["scene"][kind][index.parse::<usize>().unwrap()];
        assert_eq!(shape["name"].as_str().unwrap(), written["name"].as_str().unwrap_or(path), "{path}");
        assert_eq!(shape["kind"], kind);
    }
}

#[test]
fn surfaces_and_grids_are_maps_with_coordinates_of_their_own() {
    let (core, ..) = loaded(Starter::Lab);
    let mut band = core.surface(r#"{"shape": "ball", "width": 60}"#, "irradiance").unwrap();
    let head = parsed(&band.head());
    assert_eq!((&head["width"], &head["height"]), (&json!(60), &json!(30)));
    assert_eq!(head["axes"][0]["name"], "longitude");
    let analysis = core.analyse(&band.head(), band.take_values(), band.take_shapes(), "5").unwrap();
    assert!(parsed(&analysis)["statistics"]["max"]["value"].as_f64().unwrap() > 0.0);
}

#[test]
fn files_are_the_formats_that_they_say() {
    let (core, ..) = loaded(Starter::Lab);
    let style = json!({"colormap": "gray", "range": null, "normalization": "max", "isophotes": 8});
    let sections = json!([{"kind": "through", "shape": "ball"}]);
    let of = |request: Value| core.export(&request.to_string()).unwrap();
    let png = of(json!({"kind": "png", "channel": "brightness", "style": style}));
    assert!(png.starts_with(b"\x89PNG"));
    let svg = of(json!({"kind": "figure-svg", "channel": "brightness", "style": style, "marks": true}));
    let svg = String::from_utf8(svg).unwrap();
    assert!(svg.starts_with("<svg") && svg.contains("P1"));
    assert!(
        of(json!({"kind": "figure-png", "channel": "irradiance", "style": style, "marks": false}))
            .starts_with(b"\x89PNG")
    );
    let csv = of(json!({"kind": "section-csv", "sections": sections, "channels": ["brightness", "diffuse"]}));
    assert_eq!(String::from_utf8(csv).unwrap().lines().filter(|line| !line.starts_with('#')).count(), 1 + 2 * 513);
    assert!(of(json!({"kind": "section-svg", "sections": sections, "channels": ["brightness"]})).starts_with(b"<svg"));
    let probes = json!([{"name": "P1", "at": [0, 0, 4]}, {"name": "nowhere", "at": [9, 9, 9]}]);
    let csv = String::from_utf8(of(json!({"kind": "probes-csv", "probes": probes}))).unwrap();
    assert!(csv.contains("\"P1\",0,0,4,0.3166772975470"), "{csv}");
    assert!(csv.contains("\"nowhere\",,,"), "{csv}");
    let table = String::from_utf8(of(json!({"kind": "map-csv", "channels": ["brightness"]}))).unwrap();
    assert_eq!(table.lines().filter(|line| !line.starts_with('#')).count(), 1 + 800 * 600);
}

#[test]
fn what_the_core_says_is_in_the_language_of_the_page() {
    let (mut core, ..) = loaded(Starter::Lab);
    core.set_language("ru").unwrap();
    let explained = parsed(&core.explain(&json!({"name": "P1", "at": [0.0, 0.0, 4.0]}).to_string()).unwrap());
    assert_eq!(explained["blocks"][0]["title"], "Геометрия (2.2), длины в m");
    let requests = json!([{"name": "", "at": [0.0, 0.0, 3.0]}, {"name": "", "at": [0.0, 0.0, 6.0]}]);
    let probed = parsed(&core.probe(&requests.to_string()).unwrap());
    let off = "точка не лежит ни на одной поверхности: она на 1 m снаружи от поверхности «ball»; ближайшая точка поверхности — [0, 0, 4]";
    assert_eq!(probed[0]["error"], off);
    assert_eq!(probed[1]["reading"]["unseenBecause"], "поверхность там обращена от наблюдателя (θ_o ≥ 90°)");
    let style = json!({"colormap": "gray", "range": null, "normalization": "max", "isophotes": 3});
    let figure = json!({"kind": "figure-svg", "channel": "brightness", "style": style, "marks": true});
    let figure = String::from_utf8(core.export(&figure.to_string()).unwrap()).unwrap();
    assert!(figure.contains("яркость, lab (3.3), W/m²"), "{figure}");
    let lines = json!([{"kind": "row", "row": 300}]);
    let section = parsed(&core.section(&lines.to_string(), r#"["brightness"]"#).unwrap());
    assert_eq!(section[0]["name"], "строка 300");
    let scene = Scene::from_text("", Starter::Lab.text(), Syntax::Toml).unwrap();
    let mut wrong = serde_json::to_value(scene.source()).unwrap();
    wrong["sphere"][0]["radius"] = json!(-1.0);
    let checked = parsed(&core.load(&wrong.to_string()).unwrap());
    assert_eq!(checked["problems"][0]["message"], "`sphere[0].radius` равно -1");
    core.set_language("en").unwrap();
    let checked = parsed(&core.load(&wrong.to_string()).unwrap());
    assert_eq!(checked["problems"][0]["message"], "`sphere[0].radius` is -1");
}

/// A lab with so many lamps.
fn with_lamps(count: usize) -> Value {
    let mut core = Core::new();
    let read = parsed(&core.read(Starter::Lab.text(), "toml").unwrap());
    let mut scene = read["scene"].clone();
    let lamp = |index: usize| json!({"name": format!("lamp {index}"), "position": [5, 5, -10], "intensity": 1});
    scene["light"] = (0..count).map(lamp).collect();
    let checked = parsed(&core.load(&scene.to_string()).unwrap());
    let reading = parsed(&core.probe(r#"[{"name": "P", "at": [0, 0, 4]}]"#).unwrap());
    let explanation = parsed(&core.explain(r#"{"name": "P", "at": [0, 0, 4]}"#).unwrap());
    json!({"info": checked["info"], "reading": reading[0]["reading"], "explanation": explanation})
}

#[test]
fn of_thousands_of_lamps_the_page_is_told_of_the_first_ones_and_of_their_sum() {
    let (few, many) = (with_lamps(3), with_lamps(3000));
    let length = |value: &Value| value.as_array().unwrap().len();
    assert_eq!(length(&few["info"]["lights"]), 3);
    assert_eq!(few["explanation"]["omitted"], 0);
    for lights in [&many["info"]["lights"], &many["reading"]["lights"]] {
        assert_eq!(length(lights), 60);
    }
    assert!(length(&many["info"]["channels"]) < 200);
    assert!(length(&many["explanation"]["blocks"]) < 200);
    assert!(many["explanation"]["omitted"].as_u64().unwrap() > 2000);
    // The values are those of all of them.
    let value = |answer: &Value| answer["reading"]["brightness"].as_f64().unwrap();
    assert!((value(&many) / value(&few) - 1000.0).abs() < 1e-9, "{} {}", value(&many), value(&few));
}

#[test]
fn a_scene_finds_the_files_that_were_handed_in() {
    let text = "version = 1\nlength = \"m\"\nconvention = \"irradiance\"\n[camera]\neye = [0, 0, 5]\n\
        field_of_view = 40\nresolution = [40, 30]\n[[mesh]]\nname = \"leaf\"\nfile = \"parts/leaf.obj\"\n\
        [[light]]\nposition = [0, 0, 5]\nintensity = 1\n";
    let mut core = Core::new();
    let read = parsed(&core.read(text, "toml").unwrap());
    assert_eq!(read["problems"][0]["path"], "mesh[0].file");
    core.add_file("parts/leaf.obj", b"v -1 -1 0\nv 1 -1 0\nv 0 1 0\nf 1 2 3\n".to_vec());
    let read = parsed(&core.read(text, "toml").unwrap());
    assert_eq!(read["problems"], json!([]));
    let checked = parsed(&core.load(&read["scene"].to_string()).unwrap());
    assert_eq!(checked["info"]["shapes"][0]["kind"], "mesh");
    let shapes = core.render("brightness", 0, 30, 1).unwrap().take_shapes();
    assert!(shapes.contains(&0) && shapes.contains(&-1));
    assert!(core.thumbnail("brightness").unwrap().take_shapes().contains(&0));
}
