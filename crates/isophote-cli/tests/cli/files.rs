//! Map files, read back by readers that this project did not write.

use exr::prelude::{ReadChannels, ReadLayers};
use png::BitDepth;

use crate::common::{COURSE, Folder, TWO_LIGHTS, bits, npy};

const CHANNELS: &str = "column,row,x,y,shape,brightness,irradiance,diffuse,specular,depth,position.x,position.y,\
                        position.z,normal.x,normal.y,normal.z";

#[test]
fn a_csv_file_has_a_row_for_each_pixel_with_its_place_and_every_channel() {
    let folder = Folder::new();
    folder.ok("render --size 40x30 -o map.csv");
    let table = folder.csv("map.csv");
    assert_eq!(table.names.join(","), CHANNELS);
    assert_eq!(table.rows.len(), 1200);
    let row = &table.rows[15 * 40 + 20];
    assert_eq!(row[..5], [20.0, 15.0, 0.1, -0.1, 0.0], "column, row, centre of the pixel, shape");
    let text = folder.text("map.csv");
    for unit in
        ["# brightness: W/m²", "# depth: m", "# normal.x, normal.y, normal.z: no unit", "# convention: lab (3.3)"]
    {
        assert!(text.lines().any(|line| line == unit), "{unit}");
    }
    for (index, row) in table.rows.iter().enumerate() {
        if row[4] < 0.0 {
            assert_eq!(row[5..], [0.0; 11], "a missed pixel holds zeros");
        } else {
            let [x, y, z] = [10, 11, 12].map(|column| row[column]);
            assert!((x.hypot(y).hypot(z - 5.0) - 1.0).abs() < 1e-14, "pixel {index} is on the sphere");
            assert!((x.hypot(y).hypot(z) - row[9]).abs() < 1e-14, "its depth is its distance from the eye");
            assert!((row[5] - row[7] - row[8]).abs() < 1e-16, "brightness is diffuse plus specular");
        }
    }
}

#[test]
fn an_exr_file_holds_the_named_layers_in_floats() {
    let folder = Folder::with("two.toml", TWO_LIGHTS);
    folder.ok("render two.toml --size 40x30 --lights -o map.exr -o map.csv");
    let table = folder.csv("map.csv");
    let reader = exr::prelude::read().no_deep_data().largest_resolution_level().all_channels().first_valid_layer();
    let image = reader.all_attributes().from_file(folder.path("map.exr")).unwrap();
    assert_eq!(image.layer_data.size, exr::prelude::Vec2(40, 30));
    let names: Vec<String> =
        image.layer_data.channel_data.list.iter().map(|channel| channel.name.to_string()).collect();
    let expected =
        "N.X N.Y N.Z P.X P.Y P.Z Y Z diffuse.Y irradiance.Y light.left.Y light.right.Y shape.index specular.Y";
    assert_eq!(names.join(" "), expected);
    let pairs = [
        ("Y", "brightness"),
        ("Z", "depth"),
        ("N.Z", "normal.z"),
        ("P.X", "position.x"),
        ("shape.index", "shape"),
        ("light.right.Y", "light.right"),
        ("specular.Y", "specular"),
    ];
    for (name, column) in pairs {
        let channel =
            image.layer_data.channel_data.list.iter().find(|channel| channel.name.to_string() == name).unwrap();
        let samples: Vec<f32> = channel.sample_data.values_as_f32().collect();
        #[expect(clippy::cast_possible_truncation, reason = "the file has 32 bits")]
        let expected: Vec<f32> = table.column(column).iter().map(|&value| value as f32).collect();
        assert!(samples == expected && samples.iter().any(|&sample| sample > 0.0), "{name}");
    }
}

#[test]
fn an_npy_file_holds_one_channel_in_doubles() {
    let folder = Folder::with("course.toml", COURSE);
    folder.ok("render course.toml --size 30x30 -o map.npy -o map.csv");
    let (kind, shape, values) = npy(&folder.read("map.npy"));
    assert_eq!((kind.as_str(), shape.as_slice()), ("<f8", &[30, 30][..]));
    assert_eq!(bits(&values), bits(&folder.csv("map.csv").column("brightness")));
    folder.ok("render course.toml --size 30x20 --channel normal -o normal.npy");
    let (kind, shape, _) = npy(&folder.read("normal.npy"));
    assert_eq!((kind.as_str(), shape.as_slice()), ("<f8", &[20, 30, 3][..]));
    folder.ok("render course.toml --size 30x20 --channel shape -o shape.npy");
    let (kind, _, shapes) = npy(&folder.read("shape.npy"));
    assert_eq!((kind.as_str(), shapes[0], shapes[10 * 30 + 15]), ("<i4", -1.0, 0.0));
}

#[test]
fn an_npz_file_holds_all_channels_and_a_mask() {
    let folder = Folder::with("two.toml", TWO_LIGHTS);
    folder.ok("render two.toml --size 40x30 --lights -o map.npz -o map.csv");
    let members = zip_members(&folder.read("map.npz"));
    let names: Vec<&str> = members.iter().map(|(name, _)| name.as_str()).collect();
    let expected =
        "metadata mask brightness irradiance diffuse specular depth position normal shape light.left light.right";
    assert_eq!(names, expected.split(' ').map(|name| format!("{name}.npy")).collect::<Vec<_>>());
    let array = |name: &str| npy(&members.iter().find(|member| member.0 == format!("{name}.npy")).unwrap().1);
    let table = folder.csv("map.csv");
    for name in ["brightness", "specular", "depth", "shape", "light.left"] {
        assert_eq!(bits(&array(name).2), bits(&table.column(name)), "{name}");
    }
    let (kind, shape, mask) = array("mask");
    assert_eq!((kind.as_str(), shape.as_slice()), ("|b1", &[30, 40][..]));
    let seen: Vec<f64> = table.column("shape").iter().map(|&shape| f64::from(shape >= 0.0)).collect();
    assert_eq!(mask, seen);
}

/// Names and contents of an uncompressed ZIP archive, by its central directory (APPNOTE 4.3.12).
fn zip_members(bytes: &[u8]) -> Vec<(String, Vec<u8>)> {
    let short = |at: usize| usize::from(u16::from_le_bytes([bytes[at], bytes[at + 1]]));
    let long = |at: usize| short(at) | short(at + 2) << 16;
    let end = bytes.windows(4).rposition(|four| four == b"PK\x05\x06").unwrap();
    let mut at = long(end + 16);
    let mut members = Vec::new();
    for _ in 0..short(end + 10) {
        assert_eq!(&bytes[at..at + 4], b"PK\x01\x02");
        assert_eq!(short(at + 10), 0, "stored, not compressed");
        let name = String::from_utf8(bytes[at + 46..at + 46 + short(at + 28)].to_vec()).unwrap();
        let local = long(at + 42);
        let start = local + 30 + short(local + 26) + short(local + 28);
        members.push((name, bytes[start..start + long(at + 24)].to_vec()));
        at += 46 + short(at + 28) + short(at + 30) + short(at + 32);
    }
    members
}

#[test]
fn a_png_file_of_another_size_shows_the_numbers_of_the_csv_file() {
    let folder = Folder::with("course.toml", COURSE);
    folder.ok("render course.toml --size 50x50 -o map.png -o map.csv");
    let brightness = folder.csv("map.csv").column("brightness");
    let maximum = brightness.iter().copied().fold(0.0, f64::max);
    let levels = folder.picture("map.png").levels(BitDepth::Eight);
    assert_eq!(levels, brightness.iter().map(|value| (255.0 * value / maximum).round()).collect::<Vec<_>>());
    assert!(levels.contains(&255.0) && levels.contains(&0.0));
}

#[test]
fn several_files_at_once_are_the_same_as_one_by_one() {
    let (together, apart) = (Folder::new(), Folder::new());
    let names = ["map.png", "map.exr", "map.npy", "map.npz"];
    let outcome = together.ok("render --size 32x24 -o map.png -o map.exr -o map.npy -o map.npz");
    assert_eq!(together.names(), ["map.exr", "map.npy", "map.npz", "map.png"]);
    assert_eq!(outcome.stderr.lines().count(), 4, "each is noted");
    for name in names {
        apart.ok(&format!("render --size 32x24 -o {name}"));
        assert!(together.read(name) == apart.read(name), "{name}");
    }
}

#[test]
fn a_suffix_in_capitals_is_a_suffix_and_folders_may_have_any_name() {
    let folder = Folder::new();
    std::fs::create_dir(folder.path("карты.toml")).unwrap();
    folder.ok("render --size 8x6 -o карты.toml/ЛАБ.PNG -q");
    assert_eq!(folder.picture("карты.toml/ЛАБ.PNG").width, 8);
}

#[test]
fn an_existing_file_is_replaced_whole() {
    let folder = Folder::with("map.csv", "x".repeat(1 << 20));
    folder.ok("render --size 4x3 -o map.csv");
    assert_eq!(folder.csv("map.csv").rows.len(), 12);
    assert_eq!(folder.names(), ["map.csv"]);
}
