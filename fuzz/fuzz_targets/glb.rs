#![no_main]

use isophote::import::MeshFormat;

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| isophote_fuzz::check_mesh(bytes, MeshFormat::Glb));
