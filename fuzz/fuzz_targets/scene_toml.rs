#![no_main]

use isophote::scene::Syntax;

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| isophote_fuzz::check_scene(bytes, Syntax::Toml));
