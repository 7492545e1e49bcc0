//! Figures for a report: with axes, a colour bar and labelled isophotes.

use png::ColorType;

use crate::common::{COURSE, Folder, TWO_LIGHTS};

/// The texts of an SVG, in its order.
fn texts(svg: &str) -> Vec<&str> {
    let after_tag = |rest: &'_ str| rest.split_once('>').map(|(_, text)| text.len());
    svg.split("<text")
        .skip(1)
        .map(|rest| {
            let start = rest.len() - after_tag(rest).unwrap();
            rest[start..].split("</text>").next().unwrap()
        })
        .collect()
}

#[test]
fn the_figure_of_the_lab_has_title_unit_axes_and_probes() {
    let folder = Folder::new();
    let outcome = folder.ok("render --size 160x120 --figure lab.svg --figure lab.png");
    assert_eq!(outcome.stderr, "wrote lab.svg\nwrote lab.png\n");
    assert_eq!(folder.names(), ["lab.png", "lab.svg"], "the picture is not made beside a figure that is asked for");
    let svg = folder.text("lab.svg");
    let texts = texts(&svg);
    for expected in [
        "Lab 4: one sphere, one light",
        "x, m",
        "y, m",
        "brightness, lab (3.3), W/m²",
        "P1",
        "P2",
        "P3",
        "P4",
        "−4",
        "no surface",
    ] {
        assert!(texts.contains(&expected), "{expected:?} is not among {texts:?}");
    }
    assert!(
        texts.iter().filter(|text| **text == "0.20").count() >= 2,
        "a level of the isophotes and a tick of the bar"
    );
}

#[test]
#[expect(clippy::float_cmp, reason = "whole numbers")]
fn the_png_figure_is_the_svg_figure_at_twice_its_size() {
    let folder = Folder::new();
    folder.ok("render --size 80x60 --figure lab.svg --figure lab.png");
    let svg = folder.text("lab.svg");
    let side = |name: &str| {
        svg.split_once(&format!(" {name}=\"")).unwrap().1.split('"').next().unwrap().parse::<f64>().unwrap()
    };
    let picture = folder.picture("lab.png");
    assert_eq!([f64::from(picture.width), f64::from(picture.height)], [2.0 * side("width"), 2.0 * side("height")]);
    let colors: std::collections::HashSet<&[u8; 4]> = picture.pixels(ColorType::Rgba).iter().collect();
    assert!(colors.contains(&[255, 255, 255, 255]), "white paper");
    assert!(colors.len() > 500, "a map in colours, {} of them", colors.len());
}

#[test]
fn figures_are_in_the_unit_of_the_scene() {
    let folder = Folder::with("course.toml", COURSE);
    folder.ok("render course.toml --size 60x60 --figure course.svg");
    let svg = folder.text("course.svg");
    let texts = texts(&svg);
    for expected in ["x, mm", "brightness, course (3.4), W/(m²·sr)", "front", "400"] {
        assert!(texts.contains(&expected), "{expected:?} is not among {texts:?}");
    }
}

#[test]
fn zero_isophotes_leave_the_map_alone() {
    let folder = Folder::with("two.toml", TWO_LIGHTS);
    let labels = |arguments: &str| {
        folder.ok(&format!("render two.toml --size 80x60 --figure map.svg {arguments}"));
        folder.text("map.svg").matches("rotate(").count()
    };
    let none = labels("--isophotes 0");
    assert!(labels("") > none && labels("--isophotes 12") > labels("--isophotes 4"), "labels along the lines");
    folder.run("render two.toml --isophotes 51").failed(2, &["0..=50"]);
}

#[test]
fn the_colormap_and_the_channel_of_a_figure_can_be_chosen() {
    let folder = Folder::new();
    folder.ok("render --size 80x60 --figure viridis.svg");
    folder.ok("render --size 80x60 --colormap cividis --figure cividis.svg");
    folder.ok("render --size 80x60 --channel depth --figure depth.svg");
    assert_ne!(folder.text("viridis.svg"), folder.text("cividis.svg"));
    let svg = folder.text("depth.svg");
    assert!(texts(&svg).contains(&"depth, m"), "{:?}", texts(&svg));
}

#[test]
fn a_title_is_text_whatever_is_in_it() {
    let scene = crate::common::lab_with("Lab 4: one sphere, one light", "a < b & c > d 'e' ü λ 球");
    let folder = Folder::with("lab.toml", scene);
    folder.ok("render lab.toml --size 40x30 --figure lab.svg --figure lab.png");
    let svg = folder.text("lab.svg");
    assert!(svg.contains("a &lt; b &amp; c"), "{:?}", texts(&svg));
    assert!(folder.picture("lab.png").width > 0);
}
