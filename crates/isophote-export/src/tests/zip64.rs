use std::fs::File;
use std::io::{self, BufReader, BufWriter};

use isophote::map::{Quantity, Resolution, Values};

use super::begun;
use crate::npz;

#[test]
#[ignore = "takes 5 GB of memory and of disk, and some minutes"]
fn members_above_4_gib_are_whole() {
    let (width, height) = (1 << 15, 5500);
    let pixels = (1 << 15) * 5500;
    let mut positions = vec![[0.0; 3]; pixels];
    positions[pixels - 1] = [1.0, 2.0, 3.0];
    let map = begun(Resolution { width: width + 1, height: height + 2 }, Resolution { width, height })
        .channel(Quantity::Position, "mm", Values::Vector(positions))
        .channel(Quantity::Shape, "", Values::Index(vec![0; pixels]));
    let map = map.build().unwrap();
    let mut file = tempfile::NamedTempFile::new().unwrap();
    npz::write(&map, &mut BufWriter::new(file.as_file_mut())).unwrap();

    let mut archive = zip::ZipArchive::new(BufReader::new(File::open(file.path()).unwrap())).unwrap();
    let mut member = archive.by_name("position.npy").unwrap();
    assert_eq!(member.size(), 128 + 24 * pixels as u64);
    // Also verifies the checksum.
    assert_eq!(io::copy(&mut member, &mut io::sink()).unwrap(), 128 + 24 * pixels as u64);
}
