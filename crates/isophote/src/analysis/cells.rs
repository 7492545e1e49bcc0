//! Maps whose cells are not pixels of a camera.

use crate::lanes::{Instructions, Precision};
use crate::map::{Map, Quantity, Region, Resolution, Window};
use crate::prepare::PreparedScene;
use crate::render::band::{self, Sheet};
use crate::render::cells::{self, Cells};
use crate::render::{Observer, RenderError, layers};

/// The layout of a map of cells.
pub(super) struct Layout {
    pub(super) size: Resolution,
    pub(super) window: Window,
    /// What the map shows, and how it was computed.
    pub(super) renderer: String,
    /// Index of the shape that all cells belong to.
    pub(super) shape: usize,
}

/// Builds the map from the cells. Cells without a value are left out of the mask.
///
/// # Errors
/// A light that the scene does not have, or the observer's wish to end.
pub(super) fn map(
    scene: &PreparedScene,
    layout: Layout,
    quantities: &[Quantity],
    observer: Option<&dyn Observer>,
    cells: &Cells<'_>,
) -> Result<Map, RenderError> {
    map_by(Some(Instructions::best()), scene, layout, quantities, observer, cells)
}

fn map_by(
    instructions: Option<Instructions>,
    scene: &PreparedScene,
    layout: Layout,
    quantities: &[Quantity],
    observer: Option<&dyn Observer>,
    cells: &Cells<'_>,
) -> Result<Map, RenderError> {
    let Layout { size, window, renderer, shape } = layout;
    let sheet = Sheet { full: size, region: Region::all(size), window, whole: window, renderer };
    let mut layers = band::empty_layers(scene, &sheet, quantities, Precision::Double, Vec::new())?;
    cells::fill(&mut layers, (scene, shape), cells, instructions, observer)?;
    Ok(layers::combined(scene, quantities, layers))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::analysis::surface::{SurfaceProjection, SurfaceRequest};
    use crate::map::{Coordinates, Pixel, Scalars};
    use crate::scene::{MemoryFiles, Scene, Syntax};
    use crate::shape::{Primitive, Side, SurfacePoint};
    use crate::units::LengthUnit;
    use crate::vector::Vector;

    const SCENE: &str = r#"
        version = 1
        length = "m"
        convention = "radiance"
        shadows = true
        camera = { eye = [1, 3, 6], target = [0, 0, 0], resolution = [40, 30], field_of_view = 50 }
        material.a = { diffuse = 0.6, specular = 0.3, shininess = 25 }
        material.b = { diffuse = 0.4 }
        ambient = { radiance = 0.7, obstructed = true, samples = 23 }
        plane = [{ name = "floor", point = [0, -1, 0], normal = [0, 1, 0], material = "b" }]
        sphere = [{ center = [0.2, 0.1, 0.3], radius = 0.4, material = "b" }]
        box = [{ center = [-1, -0.5, 0.3], size = [0.7, 1, 0.5], material = "a" }]
        mesh = [{ file = "mesh.obj", material = "a" }]
        light = [
            { position = [3, 4, 2], intensity = 30 },
            { position = [-2, 1, 1.5], intensity = 10 },
            { position = [0.2, 0.15, 0.2], intensity = 0.5 },
            { emission = "parallel", direction = [-1, -2, -1], irradiance = 2 },
        ]
    "#;
    const MESH: &str = "v 0 0 0\nv 1 0.2 0\nv 0.3 1 0.1\nv 0.5 0.4 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3";

    fn prepared(text: &str) -> PreparedScene {
        let files = MemoryFiles::from_iter([("mesh.obj", MESH)]);
        let scene = Scene::from_text_with(&files, None, "scene.toml", text, Syntax::Toml);
        PreparedScene::new(&scene.unwrap_or_else(|error| panic!("{error}")))
    }

    /// The largest difference between cells in packets and one by one, as a part of the largest value of a channel.
    fn difference(scene: &PreparedScene, shape: usize, quantities: &[Quantity], cells: &Cells<'_>) -> f64 {
        let size = Resolution { width: 45, height: 35 };
        let maps = [Some(Instructions::best()), None].map(|instructions| {
            let window =
                Window { x: [0.0, 1.0], y: [0.0, 1.0], length: LengthUnit::Metre, coordinates: Coordinates::Grid };
            let layout = Layout { size, window, renderer: String::new(), shape };
            map_by(instructions, scene, layout, quantities, None, cells).unwrap_or_else(|error| panic!("{error}"))
        });
        assert_eq!(maps[0].mask().shapes(), maps[1].mask().shapes());
        let mut worst = 0.0_f64;
        for (channel, other) in maps[0].channels().iter().zip(maps[1].channels()) {
            let (Some(values), Some(others)) = (Scalars::of(&channel.values), Scalars::of(&other.values)) else {
                assert_eq!(channel.values, other.values);
                continue;
            };
            let greatest = (0..size.pixels()).map(|index| others.at(index)).fold(0.0, f64::max);
            assert!(greatest > 0.0, "{:?} is dark", channel.quantity);
            let off = |index| (values.at(index) - others.at(index)).abs() / greatest;
            worst = (0..size.pixels()).map(off).fold(worst, f64::max);
        }
        worst
    }

    /// On a floor, through solids and above everything: the same as point by point.
    #[test]
    fn free_points_in_packets_get_the_light_that_they_get_one_by_one() {
        let open = SCENE.replace(", obstructed = true, samples = 23", "");
        for (text, height) in [(SCENE, -1.0), (SCENE, 0.07), (&open, 0.07)] {
            let scene = prepared(text);
            let quantities = [
                Quantity::Irradiance,
                Quantity::Ambient,
                Quantity::Position,
                Quantity::Light(scene.scene().lights()[0].name.clone()),
            ];
            let normal = Vector::new(0.0, 1.0, 0.0);
            let point = |Pixel { column, row }| {
                let anchor = Vector::new(0.1 * f64::from(column) - 2.2, height, 0.1 * f64::from(row) - 1.7);
                SurfacePoint { anchor, offset: Vector::default(), normal, view: normal, cos_theta_o: 1.0 }
            };
            let worst = difference(&scene, 0, &quantities, &Cells::Free(&|cell| Some(point(cell))));
            assert!(worst < 1e-14, "{worst}");
        }
    }

    /// On every shape that has a surface of its own, with the brightness that the eye would see.
    #[test]
    fn points_of_shapes_in_packets_are_as_bright_as_one_by_one() {
        let scene = prepared(SCENE);
        for shape in 1..scene.scene().shapes().len() {
            let request = SurfaceRequest {
                primitive: Primitive { shape, part: 0 },
                projection: SurfaceProjection::default(),
                axis: None,
                side: Side::default(),
                size: Some(Resolution { width: 45, height: 35 }),
            };
            let Ok(surface) = scene.surface(&request) else { continue };
            let quantities = [Quantity::Brightness, Quantity::Irradiance, Quantity::Ambient, Quantity::Normal];
            let cell = |cell| Some(surface.hit(cell)).filter(|hit| hit.point.cos_theta_o > 0.0);
            let worst = difference(&scene, shape, &quantities, &Cells::OnShapes(&cell));
            assert!(worst < 1e-14, "{shape}: {worst}");
        }
    }
}
