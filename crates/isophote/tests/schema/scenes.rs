//! Scenes that together have every key, and every limit within reach.

use isophote::import::MemoryFiles;
use isophote::scene::{Scene, SceneError, Syntax};
use serde_json::{Value, json};

/// The scenes, as JSON.
pub fn all() -> Vec<Value> {
    let table =
        |text: &str| serde_json::to_value(text.parse::<toml::Table>().expect("it is TOML")).expect("it is data");
    let world = table(include_str!("../files/every-key.toml"));
    let cameras = table(include_str!("../files/cameras.toml"));
    let with = |key: &str, value: &Value| {
        let mut scene = world.clone();
        scene[key] = value.clone();
        scene
    };
    let mut scenes: Vec<Value> =
        cameras["camera"].as_array().into_iter().flatten().map(|camera| with("camera", camera)).collect();
    // Of ambient light there is but one.
    let mut white = scenes[0].clone();
    white["ambient"]["radiance"] = json!(1);
    scenes.push(white);
    // Coefficients that are no albedos may be larger.
    let mut per_steradian = scenes[0].clone();
    per_steradian["convention"] = json!("course");
    scenes.push(per_steradian);
    scenes
}

/// The scene that a JSON value is, with its files.
pub fn read(scene: &Value) -> Result<Scene, SceneError> {
    let files = MemoryFiles::from_iter([
        ("corner.obj", include_str!("../files/corner.obj")),
        ("points.csv", include_str!("../files/points.csv")),
    ]);
    Scene::from_text_with(&files, None, "the scene", &scene.to_string(), Syntax::Json)
}
