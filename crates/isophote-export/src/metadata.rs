//! What every file says about itself, in any format.

use isophote::map::{Channel, Map, Provenance, Region, Resolution, SourceFile, Window};
use serde::{Deserialize, Serialize};

/// The description stored as JSON in every file; it is enough to interpret the numbers and to render them again.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct FileMetadata {
    /// Version of this description: [`FileMetadata::VERSION`].
    pub isophote: u32,
    /// `isophote` and its version.
    pub program: String,
    /// The scene's title.
    pub title: String,
    /// The brightness convention and its formula number.
    pub convention: String,
    /// The renderer and its precision.
    pub renderer: String,
    /// The colour space of the scene's linear RGB; none if it has no colours.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub color_space: Option<String>,
    /// Size of the full image; the file may hold only a part of it.
    pub full: Resolution,
    /// The part that the file holds.
    pub region: Region,
    /// The outer edges of that part on the screen, in the screen's unit.
    pub window: Window,
    /// The channels in the file.
    pub channels: Vec<ChannelMetadata>,
    /// How numbers became grey levels or colours; only for pictures.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub picture: Option<PictureMetadata>,
    /// The scene as a TOML scene file, from which the map can be rendered again.
    pub scene: String,
    /// The files that the scene names, as they were read.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub files: Vec<SourceFile>,
}

/// A channel in a file.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct ChannelMetadata {
    /// [`Quantity::name`](isophote::map::Quantity::name), with the light's name as in the scene.
    pub name: String,
    /// Its unit: `"1"` for pure numbers, `""` for indices.
    pub unit: String,
    /// The names under which the file stores it, three for vectors; empty if it is the only content of the file.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub stored_as: Vec<String>,
}

/// How a picture shows its channel.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct PictureMetadata {
    /// The values of black and white, in the channel's unit.
    pub range: [f64; 2],
    /// How values become levels: `max`, `minmax` or `log`; older files do not say, and are proportional.
    #[serde(default = "proportional", skip_serializing_if = "is_proportional")]
    pub normalization: String,
    /// A value at a fraction v of the way from black to white is shown as v^(1/gamma); 1 is proportional.
    pub gamma: f64,
    /// Bits per sample: 8 or 16.
    pub depth: u8,
    /// Name of the colour map; none for grey, and for channels shown in their own colours.
    pub colormap: Option<String>,
    /// The encoding of such colours: `sRGB`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub encoding: Option<String>,
}

/// The name of the proportional normalization.
const PROPORTIONAL: &str = "max";

fn proportional() -> String {
    PROPORTIONAL.into()
}

fn is_proportional(normalization: &str) -> bool {
    normalization == PROPORTIONAL
}

impl FileMetadata {
    /// The version that this program writes, and the newest that it can read.
    pub const VERSION: u32 = 1;

    /// The description of a file that holds all channels of the map.
    #[must_use]
    pub fn of(map: &Map) -> Self {
        Self {
            isophote: Self::VERSION,
            program: map.provenance.program.clone(),
            title: map.provenance.title.clone(),
            convention: map.provenance.convention.clone(),
            renderer: map.provenance.renderer.clone(),
            color_space: map.provenance.color_space.clone(),
            full: map.full,
            region: map.region,
            window: map.window,
            channels: map.channels().iter().map(ChannelMetadata::of).collect(),
            picture: None,
            scene: map.provenance.scene.clone(),
            files: map.provenance.files.clone(),
        }
    }

    /// The description of a file that holds only this channel of the map.
    #[must_use]
    pub fn of_channel(map: &Map, channel: &Channel) -> Self {
        Self { channels: vec![ChannelMetadata::of(channel)], ..Self::of(map) }
    }

    /// The description of a file that holds all channels of the map under these names.
    pub(crate) fn of_stored(map: &Map, stored_as: Vec<Vec<String>>) -> Self {
        let mut metadata = Self::of(map);
        for (channel, names) in metadata.channels.iter_mut().zip(stored_as) {
            channel.stored_as = names;
        }
        metadata
    }

    /// Where the map comes from.
    #[must_use]
    pub fn provenance(&self) -> Provenance {
        Provenance {
            program: self.program.clone(),
            title: self.title.clone(),
            scene: self.scene.clone(),
            files: self.files.clone(),
            convention: self.convention.clone(),
            renderer: self.renderer.clone(),
            color_space: self.color_space.clone(),
        }
    }

    /// JSON on a single line.
    ///
    /// # Panics
    /// Never: only maps with keys that are not strings cannot be written as JSON.
    #[must_use]
    pub fn to_json(&self) -> String {
        serde_json::to_string(self).expect("texts, numbers and lists have a JSON form")
    }
}

impl ChannelMetadata {
    fn of(channel: &Channel) -> Self {
        Self { name: channel.quantity.name(), unit: channel.unit.clone(), stored_as: vec![] }
    }
}
