//! What people read, in Russian: `--lang ru`.

use crate::common::{Folder, LAB, ROOM, lab_with};

#[test]
fn mistakes_of_a_scene_in_russian() {
    let scene = lab_with("radius = 1", "radius = -1").replacen("diffuse = 0.7", "difuse = 0.7", 1);
    let scene = scene.replacen("position = [5, 5, -10]", "position = [5, 5]", 1);
    let outcome = Folder::with("scene.toml", scene).run("check scene.toml --lang ru").failed(3, &[]);
    insta::assert_snapshot!(outcome.stderr);
}

#[test]
fn warnings_in_russian() {
    let outcome = Folder::with("room.toml", ROOM).ok("check room.toml --lang ru");
    insta::assert_snapshot!(outcome.stderr);
}

#[test]
fn a_scene_as_text_in_russian() {
    insta::assert_snapshot!(Folder::new().ok("check --lang ru").stdout);
}

#[test]
fn an_explanation_in_russian() {
    insta::assert_snapshot!(Folder::new().ok("probe --at 0,0,4 --explain --lang ru").stdout);
}

#[test]
fn a_summary_in_russian() {
    let outcome = Folder::with("lab.toml", LAB).ok("render lab.toml -o map.png --lang ru");
    insta::assert_snapshot!(format!("{}{}", outcome.stdout, outcome.stderr));
}

#[test]
fn wrong_arguments_in_russian() {
    let folder = Folder::new();
    let off = folder.run("probe --at 0,0,3 --pixel 900,0 --lang ru").failed(2, &[]);
    insta::assert_snapshot!(off.stderr);
    let unknown = folder.run("section --row 300 -c radiance --lang ru").failed(2, &[]);
    assert!(unknown.stderr.starts_with("ошибка: канала `radiance` нет; допустимо: brightness"), "{}", unknown.stderr);
}

#[test]
fn errors_of_files_and_stores_in_russian() {
    let folder = Folder::with("lab.toml", LAB);
    let refused = |arguments: &str, expected: &str| {
        let told = folder.run(&format!("{arguments} --lang ru")).stderr;
        assert!(told.contains(expected), "{arguments}: {told}");
    };
    refused("render lab.toml -o none/map.csv", "не записать «none/map.csv»: папки «none» нет");
    let render = "render lab.toml --size 40x30 --shard-side 20";
    folder.ok(&format!("{render} -o map.zarr --quiet"));
    refused(&format!("{render} -o map.zarr"), "«map.zarr» уже есть: готовых шардов");
    refused("render lab.toml --size 44x33 --shard-side 20 -o map.zarr --resume", "размер: там 40×30, здесь 44×33");
    std::fs::write(folder.path("map.zarr/zarr.json"), "{}").unwrap();
    refused("merge map.zarr", "не хранилище `.zarr` этой программы");
}

#[test]
fn the_labels_of_a_figure_in_russian() {
    let folder = Folder::new();
    folder.ok("render --figure map.svg --lang ru");
    let svg = std::fs::read_to_string(folder.path("map.svg")).unwrap();
    for label in ["яркость, lab (3.3), W/m²", "нет поверхности"] {
        assert!(svg.contains(label), "no {label:?} in the figure");
    }
    folder.ok("section --row 300 -c diffuse -c specular -o section.svg --lang ru --quiet");
    let svg = std::fs::read_to_string(folder.path("section.svg")).unwrap();
    for label in ["диффузная составляющая", "зеркальная составляющая", "сечение: строка 300"]
    {
        assert!(svg.contains(label), "no {label:?} in the section");
    }
}

#[test]
fn what_programs_read_is_the_same_in_every_language() {
    let folder = Folder::with("room.toml", ROOM);
    for command in ["check room.toml --json", "probe --json", "section --row 300 --json", "render room.toml --json"] {
        let russian = folder.ok(&format!("{command} --lang ru")).stdout;
        assert_eq!(russian, folder.ok(command).stdout, "{command}");
    }
    folder.ok("section --row 300 -o english.csv");
    folder.ok("section --row 300 -o russian.csv --lang ru");
    let [english, russian] = ["english.csv", "russian.csv"].map(|file| std::fs::read(folder.path(file)).unwrap());
    assert_eq!(english, russian);
}

#[test]
fn what_a_scene_says_is_escaped_in_russian_too() {
    let scene = lab_with("material = \"clay\"", "material = \"\\u001B[2Jclay\"");
    let outcome = Folder::with("scene.toml", scene).run("check scene.toml --lang ru").failed(3, &[]);
    assert!(!outcome.stderr.contains('\u{1b}'), "{:?}", outcome.stderr);
    assert!(outcome.stderr.contains("материала «\\u{1b}[2Jclay» нет"), "{}", outcome.stderr);
}
