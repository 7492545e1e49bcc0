use std::{
    fs::File,
    io::{self, BufReader, BufWriter},
};

use super::sample;
use crate::{
    export::npz,
    map::{Channel, Quantity, Resolution, Values},
};

#[test]
#[ignore = "takes 5 GB of memory and of disk, and some minutes"]
fn members_above_4_gib_are_whole() {
    let (width, height) = (1 << 15, 5500);
    let pixels = (1 << 15) * 5500;
    let mut map = sample();
    map.region.size = Resolution { width, height };
    let mut positions = vec![[0.0; 3]; pixels];
    positions[pixels - 1] = [1.0, 2.0, 3.0];
    map.channels = vec![
        Channel { quantity: Quantity::Position, unit: "mm".into(), values: Values::Vector(positions) },
        Channel { quantity: Quantity::Shape, unit: String::new(), values: Values::Index(vec![0; pixels]) },
    ];
    let mut file = tempfile::NamedTempFile::new().unwrap();
    npz::write(&map, &mut BufWriter::new(file.as_file_mut())).unwrap();

    let mut archive = zip::ZipArchive::new(BufReader::new(File::open(file.path()).unwrap())).unwrap();
    let mut member = archive.by_name("position.npy").unwrap();
    assert_eq!(member.size(), 128 + 24 * pixels as u64);
    // Compares the checksum on the way.
    assert_eq!(io::copy(&mut member, &mut io::sink()).unwrap(), 128 + 24 * pixels as u64);
}
