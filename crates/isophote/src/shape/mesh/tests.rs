//! Meshes in scenes: compared with exact arithmetic, and lit without shadowing themselves.

use std::sync::Arc;

use super::CornerNormals;
use super::{Mesh, MeshData, MeshPlacing};
use crate::conformance::conforms;
use crate::map::Quantity;
use crate::prepare::PreparedScene;
use crate::render::{ReferenceRenderer, RenderSettings, Renderer};
use crate::scene::{Scene, Syntax};
use crate::shape::{Geometry, Rotation};
use crate::tolerance::DOUBLE;
use crate::vector::Vector;

/// A ball of triangles between circles of latitude, with the sphere's normals if it is smooth.
fn ball(is_smooth: bool) -> Mesh {
    let (rows, columns) = (10_u32, 16_u32);
    let mut data = MeshData::default();
    for row in 0..=rows {
        let (ring, height) = (std::f64::consts::PI * f64::from(row) / f64::from(rows)).sin_cos();
        for column in 0..columns {
            let (sine, cosine) = (std::f64::consts::TAU * f64::from(column) / f64::from(columns)).sin_cos();
            // The poles are single points, so their triangles without area are left out.
            let ring = if row == 0 || row == rows { 0.0 } else { ring };
            data.vertices.push([ring * cosine, height, ring * sine]);
        }
    }
    for row in 0..rows {
        for column in 0..columns {
            let [here, next] = [column, (column + 1) % columns].map(|column| row * columns + column);
            data.triangles.extend([[here, next, here + columns], [next, next + columns, here + columns]]);
        }
    }
    if is_smooth {
        data.normals = Some(CornerNormals { vectors: data.vertices.clone(), corners: data.triangles.clone() });
    }
    let rotation = Rotation::about(Vector::new(1.0, 0.3, 0.2), 20.0);
    let placing = MeshPlacing { scale: Vector::new(1.0, 0.8, 1.0), rotation, position: Vector::new(0.1, 0.0, -0.1) };
    let mesh = Mesh::new(data, &placing).expect("it is valid");
    assert_eq!(mesh.left_out(), 2 * 16);
    mesh
}

fn scene(mesh: Mesh, shadows: bool, rest: &str) -> PreparedScene {
    let text = format!(
        r#"
        version = 1
        length = "m"
        convention = "lab"
        shadows = {shadows}
        camera = {{ eye = [0, 1, 6], target = [0, 0, 0], screen = {{ distance = 6, x = [-1.6, 1.6], y = [-1.2, 1.2] }}, resolution = [40, 30] }}
        material.wall = {{ diffuse = 0.5, specular = 0.3, shininess = 10 }}
        sphere = [{{ center = [0, 0, 0], radius = 1, material = "wall" }}]
        light = [{{ position = [5, 4, 2], intensity = 10 }}, {{ position = [-4, -1, -0.2], intensity = 10 }}]
        {rest}
        "#
    );
    let mut scene = Scene::from_text("mesh", &text, Syntax::Toml).unwrap_or_else(|error| panic!("{error}"));
    scene.shapes[0].geometry = Geometry::Mesh(Arc::new(mesh));
    PreparedScene::new(&scene)
}

const GROUND: &str = r#"plane = [{ point = [0, -1.1, 0], normal = [0, 1, 0], material = "wall" }]"#;

#[test]
fn meshes_are_rendered_within_tolerance() {
    for is_smooth in [false, true] {
        let scene = scene(ball(is_smooth), true, GROUND);
        let deviation =
            conforms(&ReferenceRenderer, &scene, &DOUBLE).unwrap_or_else(|error| panic!("{is_smooth}: {error}"));
        assert!(deviation.visible > 700, "{deviation:?}");
    }
}

fn irradiance(scene: &PreparedScene) -> Vec<f64> {
    let settings = RenderSettings { quantities: vec![Quantity::Irradiance], ..RenderSettings::default() };
    let map = ReferenceRenderer.render(scene, &settings).expect("it renders");
    let values = map.scalar(&Quantity::Irradiance).expect("it was asked for");
    (0..map.region.size.pixels()).map(|index| values.at(index)).collect()
}

/// Its triangles touch along edges, and none blocks another's light.
#[test]
fn a_convex_mesh_alone_casts_no_shadow_on_itself() {
    let [with, without] = [true, false].map(|shadows| irradiance(&scene(ball(false), shadows, "")));
    assert!(with.iter().filter(|value| **value > 0.0).count() > 200);
    assert_eq!(with, without);
}

/// The points that are dark with shadows and lit without them form only a thin band at the terminator, where the triangles
/// face away although their normals do not; no single triangle stands out.
#[test]
fn the_terminator_of_a_smooth_mesh_is_not_cut_by_its_triangles() {
    let [with, without] = [true, false].map(|shadows| irradiance(&scene(ball(true), shadows, "")));
    let peak = without.iter().copied().fold(0.0, f64::max);
    for (with, without) in with.iter().zip(&without) {
        assert!(with == without || *without < 0.25 * peak, "{with} {without} of {peak}");
    }
}
