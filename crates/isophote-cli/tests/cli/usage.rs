//! Wrong arguments (exit code 2) and places that cannot be written (exit code 1).

use std::time::{Duration, Instant};

use crate::common::{Folder, LAB};

/// Refuses without leaving anything.
#[track_caller]
fn refused(arguments: &str, words: &[&str]) {
    let folder = Folder::new();
    folder.run(arguments).failed(2, words);
    assert!(folder.names().is_empty(), "{:?}", folder.names());
}

#[test]
fn an_unknown_suffix_is_refused_with_the_known_ones() {
    refused("render -o map.bmp", &["cannot tell the format of map.bmp; allowed: .png, .exr, .npy, .npz, .csv, .zarr"]);
    refused("render -o map", &["cannot tell the format of map"]);
    refused("render -o map.png -o -", &["cannot tell the format of -"]);
    refused("render --figure map.pdf", &["allowed for figures: .svg, .png"]);
}

#[test]
fn a_size_that_makes_no_image_is_refused_with_what_is_allowed() {
    let allowed = "allowed: width and height from 1 to 1000000";
    refused("render --size 0x0", &["--size", "the resolution is 0 × 0 pixels", allowed]);
    refused("render --size 1000001x1", &["the resolution is 1000001 × 1 pixels", allowed]);
    let allowed = "allowed: sides up to 65536, together at most 134217728 pixels; -o NAME.zarr takes larger ones";
    refused("render --size 70000x1", &["a map of 70000×1 pixels is too large to be held in memory", allowed]);
    refused("render --size 60000x60000", &["60000×60000", allowed]);
    for size in ["800", "800x", "-8x6", "8.5x6", "99999999999x1"] {
        refused(&format!("render --size={size}"), &["expected WIDTHxHEIGHT, such as 1920x1080"]);
    }
}

#[test]
fn a_region_outside_of_the_image_is_refused() {
    refused(
        "render --region 0,0,900,10",
        &["the region 900×10 at column 0, row 0 is not within the image of 800×600 pixels"],
    );
    refused("render --region 800,0,1,1", &["is not within the image"]);
    refused("render --region 0,0,0,5", &["is not within the image"]);
    refused("render --region 4294967295,4294967295,4294967295,4294967295", &["is not within the image"]);
    refused("render --region 1,2,3", &["expected COLUMN,ROW,WIDTH,HEIGHT"]);
}

#[test]
fn an_unknown_channel_is_refused_with_the_list() {
    let list = "allowed: brightness, irradiance, ambient, diffuse, specular, depth, position, normal, shape, samples, coverage, sampling-error, ambient-error, z-depth, cos_theta_o, camera-normal, material, light.lamp";
    refused("render --channel brightnes", &["there is no channel `brightnes`", list]);
    refused("render --channel light.lump", &["there is no channel `light.lump`", list]);
    refused("render --channel sampling-error", &["the scene has no tolerance; allowed with `sampling.tolerance`"]);
    refused("section --row 1 --channel foo", &["there is no channel `foo`", list]);
}

#[test]
fn numbers_that_mean_nothing_are_refused() {
    refused("render --range 3,1", &["MIN must be smaller than MAX"]);
    refused("render --range 1", &["expected MIN,MAX"]);
    refused("render --range 0,inf", &["inf is not a finite number"]);
    refused("render --gamma 0", &["allowed: 0.1 to 10"]);
    refused("render --bits 12", &["8, 16"]);
    refused("render --threads 0", &["--threads", "allowed: 1 to 1024"]);
    refused("render --threads 99999", &["--threads", "allowed: 1 to 1024"]);
    refused("render --colormap jet", &["viridis"]);
    refused("probe --at 0,0", &["expected X,Y,Z"]);
    refused("probe --at 0,0,nan", &["NaN is not a finite number"]);
    refused("probe --pixel 1.5,2", &["expected COLUMN,ROW in whole pixels"]);
    refused("dance", &["dance"]);
    refused("render --colour", &["--colour"]);
}

#[test]
fn what_cannot_be_a_picture_is_refused_before_anything_is_computed() {
    let slow = "render --size 11000x11000 --threads 1";
    let since = Instant::now();
    refused(&format!("{slow} --bits 16 --colormap viridis -o map.npy -o map.png"), &["--bits 16", "--colormap"]);
    refused(&format!("{slow} --channel position -o map.png"), &["`position` cannot be a picture"]);
    refused(&format!("{slow} --channel shape --figure map.svg"), &["`shape` cannot be a picture"]);
    refused(&format!("{slow} -o map.png -o map.csv --figure map.png"), &["map.png would be written twice"]);
    assert!(since.elapsed() < Duration::from_secs(10), "{:?}", since.elapsed());
}

#[test]
fn options_that_would_do_nothing_are_refused() {
    refused("probe --snap --pixel 400,300", &["--at"]);
    refused("probe --shape ball --at 0,0,4", &["--angles"]);
    // However the place is written.
    refused("render -o map.png --figure ./map.png", &["./map.png would be written twice"]);
    refused("section --row 1 -o row.csv -o row.csv", &["row.csv would be written twice"]);
}

#[test]
fn a_place_that_cannot_be_written_is_found_before_the_render() {
    let folder = Folder::with("blocked", "a file where a folder is wanted");
    std::fs::create_dir(folder.path("map.png")).unwrap();
    let since = Instant::now();
    let slow = "render --size 11000x11000 --threads 1";
    folder
        .run(&format!("{slow} -o map.csv -o none/map.png"))
        .failed(1, &["cannot write ‘none/map.png’: there is no folder ‘none’"]);
    folder.run(&format!("{slow} -o map.csv --figure none/map.svg")).failed(1, &["there is no folder ‘none’"]);
    folder.run(&format!("{slow} -o map.csv -o map.png")).failed(1, &["cannot write ‘map.png’: it is a folder"]);
    folder.run(&format!("{slow} -o blocked/map.png")).failed(1, &["blocked/map.png"]);
    folder.run("section --row 1 -o none/row.csv").failed(1, &["there is no folder ‘none’"]);
    assert!(since.elapsed() < Duration::from_secs(10), "{:?}", since.elapsed());
    assert_eq!(folder.names(), ["blocked", "map.png"]);
}

#[cfg(unix)]
#[test]
fn a_read_only_file_a_read_only_folder_and_a_device_keep_what_they_have() {
    use std::os::unix::fs::PermissionsExt;
    let folder = Folder::with("kept.csv", "kept");
    std::fs::set_permissions(folder.path("kept.csv"), PermissionsExt::from_mode(0o444)).unwrap();
    folder.run("render --size 4x3 -o kept.csv").failed(1, &["cannot write ‘kept.csv’: it is a read-only file"]);
    assert_eq!(folder.text("kept.csv"), "kept");
    std::os::unix::fs::symlink("/dev/null", folder.path("null.csv")).unwrap();
    folder.run("render --size 4x3 -o null.csv").failed(1, &["it is a device or a pipe"]);

    let locked = folder.path("locked");
    std::fs::create_dir(&locked).unwrap();
    std::fs::set_permissions(&locked, PermissionsExt::from_mode(0o555)).unwrap();
    // The superuser may write there all the same, but nobody can in /proc.
    let is_locked = std::fs::write(locked.join("try"), "").is_err();
    let target = if is_locked { "locked" } else { "/proc" };
    folder
        .run(&format!("render --size 4x3 -o {target}/map.csv"))
        .failed(1, &[&format!("cannot write ‘{target}/map.csv’")]);
    std::fs::set_permissions(&locked, PermissionsExt::from_mode(0o755)).unwrap();
}

#[test]
fn a_scene_may_be_called_anything_but_an_option() {
    let folder = Folder::with("-lab.toml", LAB);
    folder.ok("check -- -lab.toml");
    folder.ok("check ./-lab.toml");
    folder.run("check -lab.toml").failed(2, &["-l"]);
}
