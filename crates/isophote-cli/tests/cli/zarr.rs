//! Maps larger than memory: the store as its user meets it.

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;

use crate::common::{Folder, LAB};

/// Every file below a folder with its content.
pub fn tree(folder: &Path) -> BTreeMap<String, Vec<u8>> {
    let mut files = BTreeMap::new();
    let mut folders = vec![folder.to_path_buf()];
    while let Some(next) = folders.pop() {
        for entry in fs::read_dir(next).unwrap() {
            let path = entry.unwrap().path();
            if path.is_dir() {
                folders.push(path);
            } else {
                let name = path.strip_prefix(folder).unwrap().to_str().unwrap().to_owned();
                files.insert(name, fs::read(&path).unwrap());
            }
        }
    }
    files
}

#[test]
fn the_summary_is_that_of_a_render_in_memory() {
    let folder = Folder::with("lab.toml", LAB);
    let known = folder.ok("render lab.toml --size 120x90");
    let stored = folder.ok("render lab.toml --size 120x90 -o map.zarr --shard-side 32");
    assert_eq!(stored.stdout, known.stdout);
    assert_eq!(stored.stderr, "wrote map.zarr: 12 shards\n");
    assert_eq!(folder.ok("merge map.zarr --check").stdout, known.stdout);
    let [stored, known] =
        ["merge map.zarr --json", "render lab.toml --size 120x90 --json"].map(|command| folder.ok(command).json());
    for key in ["max", "min", "visible_pixels", "lit_pixels", "pixels", "probes", "resolution"] {
        assert_eq!(stored[key], known[key], "{key}");
    }
}

#[test]
fn a_store_shows_what_it_is_and_renders_again() {
    let folder = Folder::with("lab.toml", LAB);
    folder.ok("render lab.toml --size 40x30 -o map.zarr -c depth -c brightness --lights");
    let shown = folder.ok("show map.zarr");
    assert_eq!(shown.row("image")[1..], ["40", "×", "30", "pixels"]);
    for channel in ["channel     depth, m\n", "channel     brightness, W/m²\n", "channel     light.lamp, W/m²\n"] {
        assert!(shown.stdout.contains(channel), "{}", shown.stdout);
    }
    assert_eq!(folder.ok("show map.zarr --json").json()["full"]["width"], 40);
    folder.ok("render map.zarr -o again.zarr -c depth -c brightness --lights");
    assert_eq!(tree(&folder.path("again.zarr")), tree(&folder.path("map.zarr")));
    folder.ok("render map.zarr -o map.npy -o map.png");
    folder.ok("show map.zarr/preview.png");
    fs::create_dir(folder.path("empty.zarr")).unwrap();
    folder.run("show empty.zarr").failed(1, &["‘empty.zarr’ is no Zarr store of Isophote"]);
    folder.run("render empty.zarr").failed(3, &["no scene can be taken out of it"]);
    folder.run("merge empty.zarr").failed(1, &["‘empty.zarr’ is no Zarr store of Isophote"]);
    folder.run("merge none.zarr").failed(1, &["‘none.zarr’ is no Zarr store of Isophote"]);
}

#[test]
fn what_makes_no_sense_together_is_refused_before_anything_is_written() {
    let folder = Folder::new();
    for (arguments, words) in [
        ("-o map.zarr -o map.png", "-o map.zarr does not go with another -o"),
        ("-o map.png -o map.zarr", "-o map.zarr does not go with another -o"),
        ("-o map.zarr --figure map.svg", "does not go with --figure: the map is never in memory as a whole"),
        ("-o map.zarr --region 0,0,5,5", "does not go with --region"),
        ("-o map.png --resume", "--resume needs -o NAME.zarr"),
        ("--shard 1/2", "--shard needs -o NAME.zarr"),
        ("--memory 1G", "--memory needs -o NAME.zarr"),
        ("-o map.zarr --memory 1000", "expected a whole number and K, M, G or T, such as 512M"),
        ("-o map.zarr --shard 0/2", "expected I/N with I from 1 to N, such as 3/16"),
        ("-o map.zarr --shard 3/2", "expected I/N"),
        ("-o map.zarr -c nothing", "there is no channel `nothing`"),
    ] {
        folder.run(&format!("render {arguments}")).failed(2, &[words]);
        assert!(folder.names().is_empty(), "{arguments}: {:?}", folder.names());
    }
    folder.run("render -o none/map.zarr").failed(1, &["‘none/map.zarr’ is in a folder ‘none’ that does not exist"]);
    let little = folder.run("render -o map.zarr --memory 16M");
    little.failed(2, &["--memory: a limit of 16 MiB of memory is too small: one shard of this map needs"]);
    assert!(!folder.path("map.zarr").exists(), "nothing is left that would stop the next command");
    let noted = folder.ok("render --size 40x30 -o other.zarr --gamma 2 --bits 16");
    assert!(noted.stderr.starts_with("--gamma has no effect: it is not for .zarr stores\n--bits"), "{}", noted.stderr);
}

/// The first file is refused before it is read, the second one before its spheres are laid out with their tree.
#[cfg(target_os = "linux")]
#[test]
fn files_that_exceed_the_memory_limit_are_refused_before_they_fill_it() {
    let folder = Folder::with("cloud.toml", format!("{LAB}\n[[spheres]]\nfile = \"cloud.npy\"\nmaterial = \"clay\"\n"));
    // Of this length, but without content on the disk.
    fs::File::create(folder.path("cloud.npy")).unwrap().set_len(64 << 30).unwrap();
    let huge = folder.run("render cloud.toml -o map.zarr --memory 1G");
    huge.failed(2, &["--memory: a limit of 1024 MiB of memory is too small: reading ‘cloud.npy’ needs at least 655"]);
    let count = 400_000;
    let header = format!("{{'descr': '<f8', 'fortran_order': False, 'shape': ({count}, 4), }}");
    let mut bytes = b"\x93NUMPY\x01\x00".to_vec();
    bytes.extend(u16::try_from(header.len()).unwrap().to_le_bytes());
    bytes.extend(header.as_bytes());
    for number in 0..count {
        bytes.extend([f64::from(number), 50.0, 50.0, 0.1].iter().flat_map(|number| number.to_le_bytes()));
    }
    folder.write("cloud.npy", &bytes);
    let many = folder.run("render cloud.toml -o map.zarr --memory 64M");
    many.failed(2, &["--memory: a limit of 64 MiB of memory is too small: reading ‘cloud.npy’ needs at least"]);
    assert_eq!(folder.names(), ["cloud.npy", "cloud.toml"]);
    folder.ok("render cloud.toml --size 40x30 -o map.zarr --memory 1G");
}

#[test]
fn a_store_that_exists_is_kept_and_the_choices_are_named() {
    let folder = Folder::with("lab.toml", LAB);
    folder.ok("render lab.toml --size 40x30 -o map.zarr --shard-side 8");
    let before = tree(&folder.path("map.zarr"));
    let again = folder.run("render lab.toml --size 40x30 -o map.zarr --shard-side 8");
    again.failed(2, &["‘map.zarr’ exists already: 20 of its 20 shards are done; isophote merge prints its results"]);
    let resumed = folder.ok("render lab.toml --size 40x30 -o map.zarr --resume");
    assert!(resumed.stdout.contains("maximum"), "{}", resumed.stdout);
    fs::remove_file(folder.path("map.zarr/.isophote/shards/1/1.json")).unwrap();
    let half = folder.run("render lab.toml --size 40x30 -o map.zarr");
    half.failed(2, &["19 of its 20 shards are done; --resume goes on with it; to begin anew, remove it"]);
    folder.run("merge map.zarr").failed(1, &["shard 1/1 is not computed; isophote render with --resume computes"]);
    folder.run("render lab.toml --size 80x60 -o map.zarr --resume").failed(2, &["the size is 40×30 there and 80×60"]);
    folder.write("lab.toml", LAB.replacen("shininess = 20", "shininess = 21", 1));
    let changed = folder.run("render lab.toml --size 40x30 -o map.zarr --resume");
    changed.failed(
        2,
        &["a line of the scene is ‘shininess = 20.0’ there and ‘shininess = 21.0’ here; go on with the same"],
    );
    folder.write("lab.toml", LAB);
    folder.ok("render lab.toml --size 40x30 -o map.zarr --resume");
    assert_eq!(tree(&folder.path("map.zarr")), before);
}

#[test]
fn parts_share_a_store_and_merge_to_the_bytes_of_one_run() {
    let folder = Folder::with("lab.toml", LAB);
    let whole = folder.ok("render lab.toml --size 80x60 -o whole.zarr --shard-side 8");
    let part =
        |part: &str| folder.ok(&format!("render lab.toml --size 80x60 -o map.zarr --shard-side 8 --shard {part}"));
    let first = part("2/3");
    assert_eq!((first.stdout.as_str(), first.stderr.as_str()), ("", "map.zarr: 27 shards are done, 53 are left\n"));
    folder.run("merge map.zarr").failed(1, &["‘map.zarr’ is incomplete: shard 0/0 is not computed"]);
    part("3/3");
    assert!(part("1/3").stderr.ends_with("80 shards are done, 0 are left; isophote merge finishes it\n"));
    assert_eq!(folder.ok("merge map.zarr --check").stdout, whole.stdout);
    assert_eq!(tree(&folder.path("map.zarr")), tree(&folder.path("whole.zarr")));
    let json = folder.ok("render lab.toml --size 80x60 -o map.zarr --shard 1/3 --json").json();
    assert_eq!(json, serde_json::json!({ "shards_done": 80, "shards_left": 0 }));
}
