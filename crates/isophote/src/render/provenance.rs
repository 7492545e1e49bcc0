//! What a map says about itself.

use crate::map::Provenance;
use crate::prepare::PreparedScene;
use crate::units::Keyword;

/// The provenance of a map of the scene.
pub fn provenance(scene: &PreparedScene, renderer: String) -> Provenance {
    Provenance {
        program: concat!("isophote ", env!("CARGO_PKG_VERSION")).into(),
        title: scene.scene().title.clone(),
        scene: scene.source_text().to_owned(),
        files: scene.scene().files().to_vec(),
        convention: scene.scene().convention.label(),
        renderer,
        color_space: scene.components().map(|components| components.space.name().to_owned()),
    }
}
