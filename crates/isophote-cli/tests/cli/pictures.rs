//! How numbers become grey levels and colours.

use png::{BitDepth, ColorType};

use crate::common::{Folder, LAB};

/// The brightness of the lab at 80×60, and its greatest value.
fn brightness(folder: &Folder) -> (Vec<f64>, f64) {
    folder.ok("render --size 80x60 -o map.csv");
    let values = folder.csv("map.csv").column("brightness");
    let maximum = values.iter().copied().fold(0.0, f64::max);
    (values, maximum)
}

fn levels(folder: &Folder, arguments: &str) -> Vec<f64> {
    folder.ok(&format!("render --size 80x60 -o map.png {arguments}"));
    folder.picture("map.png").levels(BitDepth::Eight)
}

#[test]
fn range_names_black_and_white_and_tells_how_much_is_clipped() {
    let folder = Folder::new();
    let (values, _) = brightness(&folder);
    let expected: Vec<f64> = values.iter().map(|value| ((value - 0.05) / 0.15).clamp(0.0, 1.0) * 255.0).collect();
    let differences =
        levels(&folder, "--range 0.05,0.2").into_iter().zip(&expected).map(|(level, exact)| (level - exact).abs());
    assert!(differences.fold(0.0, f64::max) <= 0.5 + 1e-9, "rounded to nearest");
    let outcome = folder.ok("render --size 80x60 -o map.png --range 0.05,0.2");
    let shapes = folder.csv("map.csv").column("shape");
    let below = values.iter().zip(&shapes).filter(|(value, shape)| **value < 0.05 && **shape >= 0.0).count();
    let above = values.iter().filter(|value| **value > 0.2).count();
    let note = format!(
        "wrote map.png: 0.05 to 0.2 W/m² from black to white; {below} pixels below are clipped; {above} pixels above are clipped\n"
    );
    assert_eq!(outcome.stderr, note);
}

#[test]
fn normalization_stretches_or_takes_the_logarithm() {
    let folder = Folder::new();
    let scene = LAB.replace("convention = \"lab\"", "convention = \"irradiance\"");
    folder.write("bright.toml", scene.replace("[[light]]", "[ambient]\nradiance = 0.01\n\n[[light]]"));
    folder.ok("render bright.toml --size 80x60 -o map.csv");
    let (values, shapes) = (folder.csv("map.csv").column("brightness"), folder.csv("map.csv").column("shape"));
    let seen = || values.iter().zip(&shapes).filter(|(_, shape)| **shape >= 0.0).map(|(value, _)| *value);
    let (least, greatest) = (seen().fold(f64::MAX, f64::min), seen().fold(0.0, f64::max));
    assert!(least > 0.03, "{least}");
    let levels = |how: &str| {
        folder.ok(&format!("render bright.toml --size 80x60 -o map.png --normalize {how}"));
        folder.picture("map.png").levels(BitDepth::Eight)
    };
    let check = |how: &str, level: &dyn Fn(f64) -> f64| {
        for ((found, value), shape) in levels(how).into_iter().zip(&values).zip(&shapes) {
            let expected = if *shape >= 0.0 { 255.0 * level(*value) } else { 0.0 };
            assert!((found - expected).abs() <= 0.5 + 1e-9, "{how}: {found} {expected}");
        }
    };
    check("max", &|value| value / greatest);
    check("minmax", &|value| (value - least) / (greatest - least));
    check("log", &|value| 1.0 + (value / greatest).log10() / 3.0);
    assert!(folder.ok("show map.png").stdout.contains("logarithmic"));
    let told = folder.ok("render bright.toml --size 80x60 -o map.png --normalize log --range 0.01,1").stderr;
    assert!(told.contains("0.01 to 1 W/m² from black to white, by the logarithm"), "{told}");
    folder
        .run("render bright.toml --size 80x60 -o map.png --normalize log --range 0,1")
        .failed(2, &["--range starts at 0; with --normalize log it has to start above 0"]);
    folder.run("render -o map.png --normalize mean").failed(2, &["max, minmax, log"]);
    let told = folder.ok("render --size 8x6 -o map.csv --normalize log").stderr;
    assert!(told.contains("--normalize has no effect: no .png file is written"), "{told}");
}

#[test]
fn gamma_brightens_the_middle_tones_and_keeps_black_and_white() {
    let folder = Folder::new();
    let (values, maximum) = brightness(&folder);
    let expected: Vec<f64> = values.iter().map(|value| 255.0 * (value / maximum).powf(1.0 / 2.2)).collect();
    let levels = levels(&folder, "--gamma 2.2");
    assert!(levels.iter().zip(&expected).all(|(level, exact)| (level - exact).abs() <= 0.5 + 1e-9));
    assert!(levels.contains(&0.0) && levels.contains(&255.0));
}

#[test]
fn depth_16_keeps_sixteen_bits_of_the_map() {
    let folder = Folder::new();
    let (values, maximum) = brightness(&folder);
    folder.ok("render --size 80x60 --bits 16 -o map.png");
    let levels = folder.picture("map.png").levels(BitDepth::Sixteen);
    assert_eq!(levels, values.iter().map(|value| (65535.0 * value / maximum).round()).collect::<Vec<_>>());
}

#[test]
fn a_colormap_begins_and_ends_with_its_published_colours() {
    let folder = Folder::new();
    let (values, maximum) = brightness(&folder);
    let shapes = folder.csv("map.csv").column("shape");
    // Ends of the tables of matplotlib.
    for (name, first, last) in [("viridis", [68, 1, 84], [253, 231, 37]), ("inferno", [0, 0, 4], [252, 255, 164])] {
        folder.ok(&format!("render --size 80x60 --colormap {name} -o map.png"));
        let picture = folder.picture("map.png");
        let colors = picture.pixels(ColorType::Rgb);
        let at = |wanted: &dyn Fn(f64, f64) -> bool| {
            colors[values.iter().zip(&shapes).position(|(value, shape)| wanted(*value, *shape)).unwrap()]
        };
        #[expect(clippy::float_cmp, reason = "the very same numbers")]
        let brightest = at(&|value, _| value == maximum);
        assert_eq!(brightest, last, "{name}: the brightest pixel");
        assert_eq!(at(&|value, shape| value == 0.0 && shape >= 0.0), first, "{name}: a dark pixel of the sphere");
        assert_eq!(at(&|_, shape| shape < 0.0), [0, 0, 0], "{name}: no surface");
    }
}

#[test]
#[expect(clippy::float_cmp, reason = "whole numbers")]
fn the_gray_colormap_shows_what_the_grey_picture_shows() {
    let folder = Folder::new();
    let grey = levels(&folder, "");
    folder.ok("render --size 80x60 --colormap gray -o color.png");
    let picture = folder.picture("color.png");
    for (pixel, grey) in picture.pixels(ColorType::Rgb).iter().zip(grey) {
        assert_eq!(pixel.map(f64::from), [grey; 3]);
    }
}

#[test]
fn a_picture_of_another_channel_is_scaled_to_that_channel() {
    let folder = Folder::new();
    brightness(&folder);
    let specular = folder.csv("map.csv").column("specular");
    let maximum = specular.iter().copied().fold(0.0, f64::max);
    let expected: Vec<f64> = specular.iter().map(|value| (255.0 * value / maximum).round()).collect();
    assert_eq!(levels(&folder, "--channel specular"), expected);
}
