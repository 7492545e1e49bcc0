use super::{spheres_fault, write::rounded};
use crate::import::{
    MaterialSlots, SphereList,
    SpheresFormat::{Csv, Npy, Ply},
    spheres_from_bytes,
};

fn list() -> SphereList {
    SphereList { centers: vec![[1.0, 2.0, 3.0], [-0.5, 0.25, 1e3]], radii: vec![0.1, 2.5], materials: None }
}

fn slots(names: &[Option<&str>], slots: &[u16]) -> MaterialSlots {
    let names = names.iter().map(|name| name.map(str::to_owned)).collect();
    MaterialSlots { names, slots: slots.to_vec() }
}

#[test]
fn a_table_has_its_columns_in_any_order() {
    let read = |text: &str| spheres_from_bytes(text.as_bytes(), Csv).unwrap_or_else(|fault| panic!("{fault}"));
    assert_eq!(read("x,y,z,radius\n1,2,3,0.1\n-0.5,0.25,1e3,2.5"), list());
    assert_eq!(
        read("\u{feff}# two\r\n radius, z ,\"y\",x\r\n\r\n0.1, 3, 2, 1\r\n# last\r\n2.5,1000,.25,-.5\r\n"),
        list()
    );
    let text = "material,x,y,z,radius\nsteel,1,2,3,0.1\n\"a, \"\"b\"\"\",-0.5,0.25,1e3,2.5\n,0,0,0,1\nsteel,0,0,0,1\n";
    assert_eq!(read(text).materials, Some(slots(&[Some("steel"), Some("a, \"b\""), None], &[0, 1, 2, 0])));
    assert_eq!(read("material,x,y,z,radius\n,1,2,3,0.1\n,-0.5,0.25,1e3,2.5\n"), list());
}

#[test]
fn mistakes_of_tables_are_named_with_their_line() {
    let fault = |text: &str| spheres_fault(Csv, text);
    let allowed = "allowed: x, y, z, radius and, if wanted, material, separated by commas";
    assert_eq!(fault("x,y,z,r\n1,2,3,4\n"), format!("line 1: a column is ‘r’; {allowed}"));
    assert_eq!(fault("x;y;z;radius\n1;2;3;4\n"), format!("line 1: a column is ‘x;y;z;radius’; {allowed}"));
    assert_eq!(fault("x,y,z,y\n"), format!("line 1: a column that is there twice is ‘y’; {allowed}"));
    assert_eq!(fault("x,y,z\n1,2,3\n"), "line 1: column radius is missing; needed are x, y, z and radius");
    let with = |row: &str| fault(&format!("x,y,z,radius\n1,2,3,4\n{row}\n"));
    assert_eq!(with("1,2,3"), "line 3: the row, by its fields, has 3; the first line has 4");
    assert_eq!(with("1,2,3,4,5"), "line 3: the row, by its fields, has 5; the first line has 4");
    assert_eq!(with("1,2,,4"), "line 3: z is ‘’; a number is needed");
    assert_eq!(with("1,2,a,4"), "line 3: z is ‘a’; a number is needed");
    assert_eq!(with("1,nan,3,4"), "line 3: y is NaN; it must be finite");
    assert_eq!(with("1,2,3,0"), "line 3: radius is 0; it must be greater than 0");
    assert_eq!(with("1,2,3,inf"), "line 3: radius is inf; it must be finite");
    assert_eq!(fault("x,y,z,radius\n"), "the file: it has no spheres");
    assert_eq!(fault("# nothing\n"), "the file: it has no spheres");
    let named = |name: &str| fault(&format!("x,y,z,radius,material\n1,2,3,4,{name}\n"));
    let quotes = "allowed: quotes around the whole name, doubled within";
    assert_eq!(named("a\"b"), format!("line 2: a name is ‘a\"b’; {quotes}"));
    assert_eq!(named("\"a"), format!("line 2: a name is ‘\"a’; {quotes}"));
    let many = (0..65537).map(|i| format!("0,0,0,1,m{i}")).collect::<Vec<_>>().join("\n");
    assert_eq!(fault(&format!("x,y,z,radius,material\n{many}")), "line 65538: there are more than 65536 materials");
}

/// Written by hand, because NumPy pads and its versions differ.
fn npy(version: u8, dictionary: &str, numbers: &[u8]) -> Vec<u8> {
    let length = u32::try_from(dictionary.len()).unwrap().to_le_bytes();
    let length = if version == 1 { &length[..2] } else { &length };
    [b"\x93NUMPY", &[version, 0][..], length, dictionary.as_bytes(), numbers].concat()
}

fn numbers<const N: usize>(bytes: fn(f64) -> [u8; N]) -> Vec<u8> {
    [1.0, 2.0, 3.0, 0.1, -0.5, 0.25, 1e3, 2.5].into_iter().flat_map(bytes).collect()
}

#[test]
fn an_array_is_read_in_every_kind_and_version() {
    let dictionary = |kind: &str| format!("{{'descr': '{kind}', 'fortran_order': False, 'shape': (2, 4), }}  \n");
    for version in 1..=3 {
        for (kind, body) in [("<f8", numbers(f64::to_le_bytes)), (">f8", numbers(f64::to_be_bytes))] {
            let file = npy(version, &dictionary(kind), &body);
            assert_eq!(spheres_from_bytes(&file, Npy).unwrap(), list());
            // NumPy also ignores what follows.
            assert_eq!(spheres_from_bytes(&[&file[..], b"more"].concat(), Npy).unwrap(), list());
        }
    }
    let single = SphereList { radii: vec![f64::from(0.1_f32), 2.5], ..list() };
    let little = npy(1, &dictionary("<f4"), &numbers(|number| rounded(number).to_le_bytes()));
    let big = npy(1, &dictionary(">f4"), &numbers(|number| rounded(number).to_be_bytes()));
    assert_eq!(spheres_from_bytes(&little, Npy).unwrap(), single);
    assert_eq!(spheres_from_bytes(&big, Npy).unwrap(), single);
}

#[test]
fn mistakes_of_arrays_are_named() {
    let body = numbers(f64::to_le_bytes);
    let with = |kind: &str, order: &str, shape: &str| {
        let dictionary = format!("{{'descr': {kind}, 'fortran_order': {order}, 'shape': {shape}}}");
        spheres_fault(Npy, npy(1, &dictionary, &body))
    };
    let (f8, no) = ("'<f8'", "False");
    let kinds = "float32 and float64 (<f4, <f8, >f4, >f8)";
    assert_eq!(with("'<i8'", no, "(2, 4)"), format!("header: the kind of its numbers is ‘'<i8'’; allowed: {kinds}"));
    let message = with("[('x', '<f8'), ('y', '<f8')]", no, "(2,)");
    assert_eq!(message, format!("header: the kind of its numbers is ‘[('x', '<f8'), ('y', '<f8')]’; allowed: {kinds}"));
    assert_eq!(
        with(f8, no, "(2, 3)"),
        "header: its shape is ‘(2, 3)’; allowed: (N, 4): x, y, z, radius. To give all points one radius: \
         numpy.column_stack([points, numpy.full(len(points), radius)])"
    );
    assert_eq!(with(f8, no, "(8,)"), "header: its shape is ‘(8,)’; allowed: (N, 4): x, y, z, radius");
    assert_eq!(with(f8, no, "(-2, 4)"), "header: its shape is ‘(-2, 4)’; allowed: (N, 4): x, y, z, radius");
    assert_eq!(
        with(f8, "True", "(2, 4)"),
        "header: fortran_order is ‘True’; allowed: False (numpy.ascontiguousarray makes it so)"
    );
    assert_eq!(with(f8, no, "(3, 4)"), "header: 3 rows of 4 numbers need 96 bytes, but 64 are left in the file");
    let most = u64::MAX;
    let message = with(f8, no, &format!("({most}, 4)"));
    let needed = u128::from(most) * 32;
    assert_eq!(message, format!("header: {most} rows of 4 numbers need {needed} bytes, but 64 are left in the file"));
    assert_eq!(with(f8, no, "(0, 4)"), "the file: it has no spheres");
    let dictionary = "allowed: a dictionary with descr, fortran_order and shape";
    assert_eq!(
        spheres_fault(Npy, npy(1, "{'descr': 1}", &[])),
        format!("header: the header is ‘{{'descr': 1}}’; {dictionary}")
    );
    assert_eq!(
        spheres_fault(Npy, b"\x93NUMPY\x01\0\xff\xff{}"),
        "header: magic, version and header need 65545 bytes, but 12 are left in the file"
    );
    assert_eq!(
        spheres_fault(Npy, b"\x93NUMPY\x02\0\xff"),
        "header: magic, version and header need 12 bytes, but 9 are left in the file"
    );
    assert_eq!(spheres_fault(Npy, npy(4, "", &[])), "header: the version of the format is ‘4’; allowed: 1, 2 and 3");
    let mut nan = body.clone();
    nan[40..48].copy_from_slice(&f64::NAN.to_le_bytes());
    let good = "{'descr': '<f8', 'fortran_order': False, 'shape': (2, 4)}";
    assert_eq!(spheres_fault(Npy, npy(1, good, &nan)), "sphere 1: y is NaN; it must be finite");
}

#[test]
fn points_of_ply_have_a_radius_and_perhaps_a_material() {
    let header = "ply\nformat ascii 1.0\nelement vertex 2\nproperty float radius\nproperty double x\nproperty double y\n\
                  property double z\n";
    let plain = format!("{header}end_header\n0.1 1 2 3\n2.5 -0.5 0.25 1000\n");
    assert_eq!(spheres_from_bytes(plain.as_bytes(), Ply).unwrap(), list());
    let named = format!("{header}property uchar material\nend_header\n0.1 1 2 3 7\n2.5 -0.5 0.25 1000 0\n");
    let materials = spheres_from_bytes(named.as_bytes(), Ply).unwrap().materials;
    assert_eq!(materials, Some(slots(&[Some("7"), Some("0")], &[0, 1])));
    assert_eq!(
        spheres_fault(Ply, plain.replace("float radius", "float size")),
        "header: property radius of element vertex is missing; it must be a single number"
    );
    assert_eq!(spheres_fault(Ply, plain.replace("2.5", "-2.5")), "line 10: radius is -2.5; it must be greater than 0");
}
