//! A scene as the fragment of a link: `web/src/scene/url.ts` says how, and reads it.

use std::io::{self, Write};

use base64::Engine;
use base64::engine::general_purpose::URL_SAFE_NO_PAD;
use flate2::write::DeflateEncoder;
use flate2::{Compression, Crc};
use isophote::scene::SceneSource;

/// The fragment, with its `#`, that holds a scene.
pub fn fragment(scene: &SceneSource) -> io::Result<String> {
    let json = serde_json::to_vec(scene)?;
    let mut packed = DeflateEncoder::new(Vec::new(), Compression::best());
    packed.write_all(&json)?;
    let mut sum = Crc::new();
    sum.update(&json);
    Ok(format!("#s1.{}.{:08x}", URL_SAFE_NO_PAD.encode(packed.finish()?), sum.sum()))
}

#[cfg(test)]
mod tests {
    use std::io::Read;

    use flate2::read::DeflateDecoder;
    use isophote::scene::{Scene, Syntax, library::Starter};

    use super::*;

    #[test]
    fn a_fragment_holds_the_scene_and_its_sum() {
        let scene = Scene::from_text("lab", Starter::Lab.text(), Syntax::Toml).unwrap();
        let fragment = fragment(scene.source()).unwrap();
        let [begin, data, sum] = *fragment.split('.').collect::<Vec<_>>() else { panic!("{fragment}") };
        assert_eq!(begin, "#s1");
        let mut json = Vec::new();
        DeflateDecoder::new(&URL_SAFE_NO_PAD.decode(data).unwrap()[..]).read_to_end(&mut json).unwrap();
        let again = Scene::from_text("link", std::str::from_utf8(&json).unwrap(), Syntax::Json).unwrap();
        assert_eq!(again.source().to_toml(), scene.source().to_toml());
        let mut expected = Crc::new();
        expected.update(&json);
        assert_eq!(sum, format!("{:08x}", expected.sum()));
    }
}
