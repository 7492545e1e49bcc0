#![no_main]

use isophote::import::{MeshFormat, SpheresFormat};

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| {
    isophote_fuzz::check_mesh(bytes, MeshFormat::Ply);
    isophote_fuzz::check_spheres(bytes, SpheresFormat::Ply);
});
