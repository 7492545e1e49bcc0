//! Outputs of scenes that name files: which files they were made of, and whether those are still the same.

use std::fmt::Write;
use std::fs;

use crate::common::Folder;
use crate::zarr::tree;

const SCENE: &str = r#"version = 1
length = "m"
convention = "irradiance"
camera = { eye = [0, 0, -10], target = [0, 0, 0], field_of_view = 40, resolution = [48, 36] }
light = [{ position = [0, 0, -40], intensity = 1 }]

[[mesh]]
file = "meshes/sheet.obj"
"#;

/// A folder `sub` with the scene and its mesh, and an empty folder `out`.
fn folder(mesh: &str) -> Folder {
    let folder = Folder::new();
    fs::create_dir_all(folder.path("sub/meshes")).unwrap();
    fs::create_dir(folder.path("out")).unwrap();
    folder.write("sub/scene.toml", SCENE);
    folder.write("sub/meshes/sheet.obj", mesh);
    folder
}

fn triangle(size: u32) -> String {
    format!("v -{size} -{size} 0\nv {size} -{size} 0\nv 0 {size} 0\nf 1 3 2\n")
}

/// A file that is too large to be carried.
fn large(size: u32) -> String {
    let mut mesh = triangle(size);
    for _ in 0..8000 {
        writeln!(mesh, "# nothing").unwrap();
    }
    mesh
}

#[test]
fn a_store_is_never_continued_with_another_mesh() {
    let folder = folder(&triangle(2));
    folder.ok("render sub/scene.toml -o out/map.zarr --shard-side 16 --shard 1/2");
    folder.write("sub/meshes/sheet.obj", triangle(3));
    let words = ["holds another map: a file of the scene is ‘meshes/sheet.obj’, ", "SHA-256", "there and", "here"];
    folder.run("render sub/scene.toml -o out/map.zarr --resume").failed(2, &words);
    folder.run("render sub/scene.toml -o out/map.zarr --shard 2/2").failed(2, &words);
    folder.write("sub/meshes/sheet.obj", triangle(2));
    folder.ok("render sub/scene.toml -o out/map.zarr --shard-side 16 --shard 2/2");
    // From another folder too: where a file is does not matter.
    fs::rename(folder.path("sub"), folder.path("moved")).unwrap();
    folder.ok("render moved/scene.toml -o out/map.zarr --resume");
}

#[test]
fn small_files_are_in_the_output_itself() {
    let folder = folder(&triangle(2));
    for name in ["map.exr", "map.png", "map.npz", "map.npy", "map.csv", "map.zarr"] {
        folder.ok(&format!("render sub/scene.toml -o out/{name}"));
    }
    fs::remove_dir_all(folder.path("sub")).unwrap();
    for name in ["map.exr", "map.png", "map.npz", "map.npy", "map.csv", "map.zarr"] {
        let shown = folder.ok(&format!("show out/{name}"));
        assert!(
            shown.stdout.contains("  file        meshes/sheet.obj, 35 bytes, carried, SHA-256 "),
            "{}",
            shown.stdout
        );
        folder.ok(&format!("render out/{name} -o again.npz -o again.exr"));
        assert!(folder.read("again.exr") == folder.read("out/map.exr"), "{name}");
    }
    folder.ok("render out/map.exr -o again.zarr");
    assert_eq!(tree(&folder.path("again.zarr")), tree(&folder.path("out/map.zarr")));
}

#[test]
fn large_files_are_found_where_they_were() {
    let folder = folder(&large(2));
    folder.ok("render sub/scene.toml -o out/map.exr");
    for part in ["1/2", "2/2"] {
        folder.ok(&format!("render sub/scene.toml -o out/map.zarr --shard-side 16 --shard {part}"));
    }
    let merged = folder.ok("merge out/map.zarr --check");
    assert_eq!(merged.stdout, folder.ok("render out/map.exr -o again.exr").stdout);
    assert!(folder.read("again.exr") == folder.read("out/map.exr"));
    // Moved along with its files, and called from elsewhere.
    fs::create_dir(folder.path("moved")).unwrap();
    for name in ["sub", "out"] {
        fs::rename(folder.path(name), folder.path("moved").join(name)).unwrap();
    }
    folder.ok("render moved/out/map.exr -o again.exr");
    folder.ok("merge moved/out/map.zarr");
}

#[test]
fn a_file_that_has_changed_or_is_gone_is_said_so() {
    let folder = folder(&large(2));
    folder.ok("render sub/scene.toml -o out/map.exr -o out/map.npz");
    folder.write("sub/meshes/sheet.obj", large(3));
    let words = ["sub/meshes/sheet.obj’ that this was made of (80035 bytes with the SHA-256", "has changed", "--scene"];
    folder.run("render out/map.exr").failed(3, &words);
    fs::remove_file(folder.path("sub/meshes/sheet.obj")).unwrap();
    let words = ["sub/meshes/sheet.obj’ that this was made of (80035 bytes with the SHA-256", "is not there any more"];
    folder.run("render out/map.npz").failed(3, &words);
}
