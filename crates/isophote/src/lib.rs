//! Isophote computes the brightness of surfaces lit by point lights, with units and a formula number on every value.
//!
//! # A tour
//!
//! A [scene](scene::Scene) is TOML or JSON text. It is validated once, as a whole; the result is valid, with lengths in
//! metres.
//!
//! ```
//! use isophote::scene::{Scene, Syntax};
//!
//! let text = r#"
//!     version = 1
//!     length = "m"
//!     convention = "lambert"
//!
//!     [camera]
//!     eye = [0, 0, 0]
//!     forward = [0, 0, 1]
//!     resolution = [80, 60]
//!     screen = { distance = 5, x = [-4, 4], y = [-3, 3] }
//!
//!     [material.chalk]
//!     diffuse = 0.7
//!
//!     [[sphere]]
//!     center = [0, 0, 5]
//!     radius = 1
//!     material = "chalk"
//!
//!     [[light]]
//!     position = [5, 5, -10]
//!     intensity = 100
//! "#;
//! let scene = Scene::from_text("tour", text, Syntax::Toml)?;
//! assert_eq!(scene.lights().len(), 1);
//! # Ok::<(), isophote::scene::SceneError>(())
//! ```
//!
//! An error message names the place in the scene, the value, and what is allowed.
//!
//! ```
//! # use isophote::scene::{Scene, Syntax};
//! let error = Scene::from_text("tour", "version = 1\nlength = \"inch\"", Syntax::Toml).unwrap_err();
//! assert!(error.to_string().contains("allowed: mm, cm, m"));
//! ```
//!
//! [`PreparedScene`](prepare::PreparedScene) prepares a scene for tracing. A [`Renderer`](render::Renderer) turns it into a
//! [`Map`](map::Map): named channels with units, and a mask of the pixels that see a surface.
//!
//! ```
//! use isophote::analysis::statistics::statistics;
//! use isophote::lanes::Precision;
//! use isophote::map::Quantity;
//! use isophote::prepare::PreparedScene;
//! use isophote::render::{RenderSettings, Renderer, SimdRenderer};
//! # use isophote::scene::{Scene, Syntax, library::Starter};
//!
//! # let scene = Scene::from_text("lab", Starter::Lab.text(), Syntax::Toml)?;
//! let prepared = PreparedScene::new(&scene);
//! let settings = RenderSettings { quantities: vec![Quantity::Brightness], ..RenderSettings::default() };
//! let map = SimdRenderer::new(Precision::Double, None).render(&prepared, &settings)?;
//! let brightness = statistics(&map, &Quantity::Brightness).expect("the sphere is in the picture");
//! assert!(brightness.min.value >= 0.0 && brightness.max.value < 0.4);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! A [probe](analysis::probe) gives the value at a point, and can explain how it was computed.
//!
//! ```
//! use isophote::analysis::probe::ProbePosition;
//! use isophote::text::Language;
//! use isophote::vector::Vector;
//! # use isophote::prepare::PreparedScene;
//! # use isophote::scene::{Scene, Syntax, library::Starter};
//!
//! # let prepared = PreparedScene::new(&Scene::from_text("lab", Starter::Lab.text(), Syntax::Toml)?);
//! let reading = prepared.probe(&ProbePosition::Point(Vector::new(0.0, 0.0, 4.0)))?;
//! assert!((reading.shading.brightness() - 0.316677297547093).abs() < 1e-14);
//! assert!(reading.explain(&prepared, "P1", Language::English).contains("E   = v I cosθ_i / r²"));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! The crate `isophote-export` writes maps to files; `isophote-zarr` renders maps that are larger than memory.
//!
//! Formula numbers such as (3.3) are those of `docs/physics.md`; `ARCHITECTURE.md` is the map of the code.

pub mod accelerate;
pub mod analysis;
pub mod camera;
pub mod color;
pub mod conformance;
pub mod double_double;
mod hammersley;
pub mod import;
pub mod lanes;
pub mod light;
pub mod map;
pub mod outline;
pub mod prepare;
pub mod ray;
pub mod real;
pub mod reflectance;
pub mod render;
#[cfg(test)]
mod sample_map;
pub mod scalar;
pub mod scene;
pub mod shade;
pub mod shape;
pub mod sum;
pub mod text;
pub mod threads;
pub mod tolerance;
pub mod units;
pub mod vector;
