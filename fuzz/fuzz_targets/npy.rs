#![no_main]

use isophote::import::SpheresFormat;

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| isophote_fuzz::check_spheres(bytes, SpheresFormat::Npy));
