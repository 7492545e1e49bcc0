//! Every step of a value, as golden text: a student can follow it with a calculator.

use crate::common::{COURSE, Folder, ROOM, assert_close, lab_with};

fn explained(scene: &str, arguments: &str) -> String {
    let folder = Folder::with("scene.toml", scene);
    folder.ok(&format!("probe scene.toml --quiet --explain {arguments}")).stdout
}

#[test]
fn the_labs_fourth_point() {
    insta::assert_snapshot!(Folder::new().ok("probe --angles 30,45 --explain").stdout);
}

#[test]
fn two_lambertian_lights_in_millimetres() {
    insta::assert_snapshot!(explained(COURSE, "--at 0,0,-300"));
}

#[test]
fn a_wall_seen_from_inside_the_room() {
    insta::assert_snapshot!(explained(ROOM, "--at 0,0,-2"));
}

#[test]
fn a_side_that_faces_away_from_the_eye() {
    insta::assert_snapshot!(explained(crate::common::LAB, "--at 1,0,5"));
}

#[test]
fn the_physically_normalised_radiance() {
    insta::assert_snapshot!(explained(&lab_with("convention = \"lab\"", "convention = \"radiance\""), "--at 0,0,4"));
}

#[test]
fn several_points_are_explained_one_after_the_other() {
    let all = Folder::new().ok("probe --explain").stdout;
    let names: Vec<&str> = all.lines().filter(|line| line.contains(": Lab 4")).collect();
    assert_eq!(names, ["P1", "P2", "P3", "P4"].map(|name| format!("{name}: Lab 4: one sphere, one light")));
}

/// The number that follows these words.
fn number_after(text: &str, words: &str) -> f64 {
    let rest = text.split_once(words).unwrap_or_else(|| panic!("no {words:?} in\n{text}")).1;
    rest.split([' ', ',', '\n', ')']).next().unwrap().parse().unwrap()
}

#[test]
fn the_printed_numbers_give_the_printed_result_on_a_calculator() {
    let text = Folder::new().ok("probe --angles 30,45 --explain").stdout;
    let [r, cos_i, cos_o] =
        ["‖S − P‖ = ", "cosθ_i = max(0, N·L) = max(0, ", "cosθ_o = N·V = "].map(|words| number_after(&text, words));
    let irradiance = 100.0 * cos_i / (r * r);
    assert_close(number_after(&text, "Sum over 1 light\n  E = "), irradiance, 1e-11);
    let lobe = number_after(&text, "cosθ_h = max(0, N·H) = ").powi(20);
    assert_close(number_after(&text, "^20 = "), lobe, 1e-10);
    let [diffuse, specular] = ["  diffuse  = ", "  specular = "].map(|words| {
        let line = text.split_once(words).unwrap().1.lines().next().unwrap();
        line.rsplit_once(" = ").unwrap().1.split(' ').next().unwrap().parse::<f64>().unwrap()
    });
    assert_close(diffuse, irradiance * 0.7 * cos_o, 1e-11);
    assert_close(specular, irradiance * 0.3 * lobe, 1e-10);
    let brightness = text.rsplit_once("  B = ").unwrap().1.split(' ').next().unwrap().parse().unwrap();
    assert_close(brightness, diffuse + specular, 1e-11);
}
