//! Scenes whose files come from elsewhere than a file system, or from nowhere.

use std::borrow::Cow;
use std::cell::RefCell;

use isophote::map::Resolution;
use isophote::scene::{MemoryFiles, NoFiles, Origin, ReadFailure, Resolver, Scene, Syntax};

const SCENE: &str = r#"version = 1
length = "m"
convention = "irradiance"
camera = { eye = [0, 0, -10], target = [0, 0, 0], field_of_view = 40 }
light = [{ position = [0, 0, -40], intensity = 1 }]

[[mesh]]
file = "triangle.obj"
"#;

const TRIANGLE: &str = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";

/// Files in memory that note which of them are read.
struct Noting {
    files: MemoryFiles,
    read: RefCell<Vec<String>>,
}

impl Noting {
    fn new(triangle: &str) -> Self {
        Self { files: MemoryFiles::from_iter([("triangle.obj", triangle)]), read: RefCell::default() }
    }
}

impl Resolver for Noting {
    fn read(&self, name: &str) -> Result<Cow<'_, [u8]>, ReadFailure> {
        self.read.borrow_mut().push(name.into());
        self.files.read(name)
    }

    fn origin(&self) -> Origin {
        self.files.origin()
    }
}

fn read(files: &dyn Resolver, earlier: Option<&Scene>) -> Scene {
    Scene::from_text_with(files, earlier, "scene.toml", SCENE, Syntax::Toml).unwrap_or_else(|error| panic!("{error}"))
}

#[test]
fn a_mesh_is_read_from_memory() {
    let files = Noting::new(TRIANGLE);
    let scene = read(&files, None);
    assert_eq!(scene.shapes()[0].geometry.parts(), 1);
    assert_eq!(*files.read.borrow(), ["triangle.obj"]);
    let again = Scene::from_source_with(&files, scene.source().clone()).unwrap_or_else(|error| panic!("{error}"));
    assert_eq!(again.shapes(), scene.shapes());
}

#[test]
fn what_an_earlier_scene_has_of_the_same_files_is_not_read_again() {
    let first = read(&Noting::new(TRIANGLE), None);
    let same = Noting::new(TRIANGLE);
    assert_eq!(read(&same, Some(&first)).shapes(), first.shapes());
    assert_eq!(*same.read.borrow(), Vec::<String>::new());
    // The same name, but another file.
    let other = Noting::new("v 0 0 0\nv 2 0 0\nv 0 2 0\nv 2 2 0\nf 1 2 3\nf 2 4 3\n");
    assert_eq!(read(&other, Some(&first)).shapes()[0].geometry.parts(), 2);
    assert_eq!(*other.read.borrow(), ["triangle.obj"]);
}

/// Its files need not be at hand any more.
#[test]
fn another_resolution_reads_no_files() {
    let scene = read(&Noting::new(TRIANGLE), None);
    let small = scene.with_resolution(Resolution { width: 4, height: 3 }).unwrap_or_else(|error| panic!("{error}"));
    assert_eq!(small.shapes(), scene.shapes());
}

#[test]
fn where_no_files_can_be_read_a_scene_that_names_one_is_refused() {
    let error = Scene::from_text_with(&NoFiles, None, "scene.toml", SCENE, Syntax::Toml).expect_err("it names a file");
    insta::assert_snapshot!(error.report(false));
    let without = SCENE.split("[[mesh]]").next().unwrap();
    assert!(Scene::from_text_with(&NoFiles, None, "scene.toml", without, Syntax::Toml).is_ok());
}

#[test]
fn a_file_that_is_not_at_hand_is_refused_with_those_that_are() {
    let files = MemoryFiles::from_iter([("circle.obj", TRIANGLE), ("square.obj", TRIANGLE)]);
    let error = Scene::from_text_with(&files, None, "scene.toml", SCENE, Syntax::Toml).expect_err("it names another");
    insta::assert_snapshot!(error.report(false));
}
