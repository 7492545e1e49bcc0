//! Data written in any format is read back unchanged.

use proptest::{collection::vec, prelude::*};

use super::{
    corners, normals,
    write::{Polygons, ascii_ply, ascii_stl, binary_ply, binary_stl, glb_of, obj},
};
use crate::import::{MeshFormat, SpheresFormat, TriangleMesh, mesh_from_bytes, spheres_from_bytes};

/// Eighths: every format represents them exactly, areas are exact, and there are few enough that some vertices are equal.
fn vector() -> impl Strategy<Value = [f64; 3]> {
    proptest::array::uniform3(-3..4_i16).prop_map(|steps| steps.map(|step| f64::from(step) * 0.125))
}

fn polygons() -> impl Strategy<Value = Polygons> {
    let direction = vector().prop_filter("a direction", |vector| *vector != [0.0; 3]);
    (vec((vector(), direction), 3..20), any::<bool>())
        .prop_flat_map(|(vertices, has_normals)| {
            let faces = vec(vec(0..vertices.len(), 3..6), 1..20);
            (Just(vertices), Just(has_normals), faces)
        })
        .prop_map(|(vertices, has_normals, faces)| {
            let (vertices, normals): (Vec<_>, Vec<_>) = vertices.into_iter().unzip();
            Polygons { vertices, normals: has_normals.then_some(normals), faces }
        })
}

fn has_area([a, b, c]: [[f64; 3]; 3]) -> bool {
    let [u, v] = [b, c].map(|point| [0, 1, 2].map(|i| point[i] - a[i]));
    let cross = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]];
    cross != [0.0; 3]
}

fn check(mesh: &TriangleMesh, polygons: &Polygons, may_have_normals: bool) {
    let all = polygons.triangles().map(|triangle| (triangle, triangle.map(|index| polygons.vertices[index])));
    let kept: Vec<_> = all.filter(|(_, positions)| has_area(*positions)).collect();
    assert_eq!(corners(mesh), kept.iter().map(|(_, positions)| *positions).collect::<Vec<_>>());
    assert_eq!(mesh.triangles.len() as u64 + mesh.degenerate, polygons.triangles().count() as u64);
    for (index, vertex) in mesh.vertices.iter().enumerate() {
        assert!(!mesh.vertices[..index].contains(vertex), "no vertex is there twice");
        let index = u32::try_from(index).unwrap();
        assert!(mesh.triangles.iter().flatten().any(|corner| *corner == index), "each is used");
    }
    let Some(expected) = polygons.normals.as_ref().filter(|_| may_have_normals) else {
        assert!(mesh.normals.is_none());
        return;
    };
    for (found, (triangle, _)) in normals(mesh).iter().zip(kept) {
        for (found, expected) in found.iter().zip(triangle.map(|index| expected[index])) {
            let length = expected.iter().map(|component| component * component).sum::<f64>().sqrt();
            for (found, expected) in found.iter().zip(expected) {
                assert!((found - expected / length).abs() <= 1e-15);
            }
        }
    }
}

proptest! {
    #[test]
    fn a_mesh_comes_back_from_every_format(polygons in polygons()) {
        let positions: Vec<_> =
            polygons.triangles().map(|triangle| triangle.map(|index| polygons.vertices[index])).collect();
        prop_assume!(positions.iter().any(|triangle| has_area(*triangle)));
        let files = [
            (MeshFormat::Obj, true, obj(&polygons)),
            (MeshFormat::Ply, true, ascii_ply(&polygons)),
            (MeshFormat::Ply, true, binary_ply(&polygons, false)),
            (MeshFormat::Ply, true, binary_ply(&polygons, true)),
            (MeshFormat::Stl, false, ascii_stl(&positions)),
            (MeshFormat::Stl, false, binary_stl(b"solid", &positions)),
            (MeshFormat::Glb, true, glb_of(&polygons)),
        ];
        for (format, may_have_normals, file) in files {
            let mesh = mesh_from_bytes(&file, format);
            let mesh = mesh.unwrap_or_else(|fault| panic!("{format:?}: {fault}"));
            check(&mesh, &polygons, may_have_normals);
        }
    }

    #[test]
    fn spheres_come_back_from_every_format(spheres in vec((proptest::array::uniform3(-1e6..1e6), 1e-6..1e6), 1..50)) {
        let rows: Vec<[f64; 4]> = spheres.iter().map(|([x, y, z], radius)| [*x, *y, *z, *radius]).collect();
        let count = rows.len();
        let numbers: Vec<u8> = rows.as_flattened().iter().flat_map(|number| number.to_le_bytes()).collect();
        let lines: Vec<String> = rows.iter().map(|[x, y, z, radius]| format!("{x},{y:e},{z},{radius}")).collect();
        let csv = format!("x,y,z,radius\n{}", lines.join("\n"));
        let dictionary = format!("{{'descr': '<f8', 'fortran_order': False, 'shape': ({count}, 4), }}\n");
        let length = u16::try_from(dictionary.len()).unwrap().to_le_bytes();
        let npy = [b"\x93NUMPY\x01\0", &length[..], dictionary.as_bytes(), &numbers].concat();
        let properties = ["x", "y", "z", "radius"].map(|name| format!("property double {name}\n")).concat();
        let ply = format!("ply\nformat binary_little_endian 1.0\nelement vertex {count}\n{properties}end_header\n");
        let ply = [ply.as_bytes(), &numbers].concat();
        for (format, file) in
            [(SpheresFormat::Csv, csv.into_bytes()), (SpheresFormat::Npy, npy), (SpheresFormat::Ply, ply)]
        {
            let list = spheres_from_bytes(&file, format);
            let list = list.unwrap_or_else(|fault| panic!("{format:?}: {fault}"));
            let found: Vec<_> = list.centers.iter().copied().zip(list.radii).collect();
            prop_assert_eq!(&found, &spheres);
            prop_assert!(list.materials.is_none());
        }
    }
}
