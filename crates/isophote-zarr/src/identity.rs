//! What a store says about itself, and whether it is the one requested.

use std::io;
use std::path::Path;

use isophote::map::SourceFile;
use isophote::message;
use isophote_export::FileMetadata;
use serde::Deserialize;
use serde_json::{Map as JsonMap, Value, json};

use crate::change::Change;
use crate::error::StoreError;
use crate::json::{object, pretty};
use crate::plan::Plan;

/// The file that describes a group or an array.
pub const ZARR_JSON: &str = "zarr.json";

/// The description of a store without its results: what must match for a computation to be continued.
#[derive(Clone, Debug, PartialEq)]
pub struct Identity {
    /// The map, as in every output file.
    pub metadata: FileMetadata,
    /// How it is divided into shards.
    pub plan: Plan,
    /// The description of each array by its name.
    pub arrays: JsonMap<String, Value>,
}

/// The description that a store carries, like every output file.
///
/// # Errors
/// Not a store of Isophote, or one that cannot be read.
pub fn read_metadata(path: &Path) -> Result<FileMetadata, StoreError> {
    let file = path.join(ZARR_JSON);
    let text = match std::fs::read(&file) {
        Err(error) if error.kind() == io::ErrorKind::NotFound => {
            return Err(StoreError::Foreign { path: path.into(), what: message!("no Zarr store of Isophote") });
        }
        text => text.map_err(|reason| StoreError::Read { path: file, reason })?,
    };
    Identity::from_json(&text, path).map(|identity| identity.metadata)
}

impl Identity {
    /// The group's `zarr.json`, with the descriptions of all arrays for readers of consolidated metadata, and with the
    /// results once they are known.
    pub fn to_json(&self, statistics: Option<Value>) -> Vec<u8> {
        let FileMetadata { title, convention, program, renderer, .. } = &self.metadata;
        let mut attributes = json!({
            "title": title,
            "convention": convention,
            "program": program,
            "renderer": renderer,
            "isophote": self.metadata,
            "isophote_plan": self.plan,
        });
        if let Some(color_space) = &self.metadata.color_space {
            attributes["color_space"] = json!(color_space);
        }
        if let Some(statistics) = statistics {
            attributes["statistics"] = statistics;
        }
        let group = json!({
            "zarr_format": 3,
            "node_type": "group",
            "attributes": attributes,
            "consolidated_metadata": { "kind": "inline", "must_understand": false, "metadata": self.arrays },
        });
        pretty(&group)
    }

    /// Reads the group's `zarr.json` of the store at `path`.
    pub fn from_json(text: &[u8], path: &Path) -> Result<Self, StoreError> {
        #[derive(Deserialize)]
        struct Version {
            isophote: u32,
        }
        let damaged = |reason: String| StoreError::Damaged { path: path.join(ZARR_JSON), reason };
        let mut group: Value = serde_json::from_slice(text).map_err(|error| damaged(error.to_string()))?;
        // Anything may stand where an object is expected: what is looked for in it is then absent.
        let mut take = |pointer| group.pointer_mut(pointer).map_or(Value::Null, Value::take);
        let metadata = take("/attributes/isophote");
        let plan = take("/attributes/isophote_plan");
        let arrays = object(take("/consolidated_metadata/metadata"));
        match Version::deserialize(&metadata) {
            Err(_) => {
                return Err(StoreError::Foreign { path: path.into(), what: message!("no Zarr store of Isophote") });
            }
            Ok(Version { isophote: version }) if version > FileMetadata::VERSION => {
                return Err(StoreError::Newer { path: path.into(), version });
            }
            Ok(_) => {}
        }
        let metadata: FileMetadata = serde_json::from_value(metadata).map_err(|error| damaged(error.to_string()))?;
        let plan: Plan = serde_json::from_value(plan).map_err(|error| damaged(error.to_string()))?;
        if !plan.is_sound() || plan.full != metadata.full {
            return Err(damaged("its plan does not fit its image".into()));
        }
        Ok(Self { metadata, plan, arrays })
    }

    /// Without the paths of the scene's files, which differ between computers.
    fn without_places(&self) -> Self {
        let mut identity = self.clone();
        for file in &mut identity.metadata.files {
            file.path.clear();
        }
        identity
    }

    /// How the requested identity differs from this one.
    pub fn changes(&self, asked: &Self) -> Vec<Change> {
        let (here, there) = (&asked.metadata, &self.metadata);
        let mut changes = Vec::new();
        let mut compare = |what, stored: String, asked: String| {
            if stored != asked {
                changes.push(Change { what, stored, asked });
            }
        };
        compare(message!("the program"), there.program.clone(), here.program.clone());
        compare(message!("the renderer"), there.renderer.clone(), here.renderer.clone());
        compare(message!("the size"), size(there), size(here));
        compare(message!("the list of channels"), channels(there), channels(here));
        compare(message!("the side of a shard"), self.plan.shard_side.to_string(), asked.plan.shard_side.to_string());
        if changes.is_empty() {
            changes.extend(changed_line(&there.scene, &here.scene));
        }
        if changes.is_empty() {
            changes.extend(changed_file(&there.files, &here.files));
        }
        let [stored, asked] = [self, asked].map(Self::without_places);
        if changes.is_empty() && stored != asked {
            let [stored, asked] =
                [stored, asked].map(|identity| format!("{:08x}", crc32c::crc32c(&identity.to_json(None))));
            changes.push(Change { what: message!("the checksum of the description"), stored, asked });
        }
        changes
    }
}

/// The first file of the scene whose content differs.
fn changed_file(stored: &[SourceFile], asked: &[SourceFile]) -> Option<Change> {
    let named = |files: &[SourceFile], name: &str| {
        let file = files.iter().find(|file| file.name == name);
        file.map_or("absent".into(), |file| format!("‘{name}’, {}", file.describe()))
    };
    let differs = |file: &&SourceFile, others: &[SourceFile]| !others.iter().any(|other| file.is_same_content(other));
    let changed =
        asked.iter().find(|file| differs(file, stored)).or(stored.iter().find(|file| differs(file, asked)))?;
    let [stored, asked] = [stored, asked].map(|files| named(files, &changed.name));
    Some(Change { what: message!("a file of the scene"), stored, asked })
}

fn size(metadata: &FileMetadata) -> String {
    format!("{}×{}", metadata.full.width, metadata.full.height)
}

fn channels(metadata: &FileMetadata) -> String {
    metadata.channels.iter().map(|channel| channel.name.as_str()).collect::<Vec<_>>().join(", ")
}

/// The first line that differs, which would be lost in the whole scene.
fn changed_line(stored: &str, asked: &str) -> Option<Change> {
    let quoted = |line: Option<&str>| line.map_or("absent".into(), |line| format!("‘{line}’"));
    let (mut stored, mut asked) = (stored.lines(), asked.lines());
    loop {
        match (stored.next(), asked.next()) {
            (None, None) => return None,
            (there, here) if there == here => {}
            (there, here) => {
                return Some(Change {
                    what: message!("a line of the scene"),
                    stored: quoted(there),
                    asked: quoted(here),
                });
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_first_line_that_changed_is_named() {
        let change = changed_line("a = 1\nb = 2\n", "a = 1\nb = 3\nc = 4\n").unwrap();
        assert_eq!(change.to_string(), "a line of the scene is ‘b = 2’ there and ‘b = 3’ here");
        let change = changed_line("a = 1\n", "a = 1\nb = 3\n").unwrap();
        assert_eq!(change.to_string(), "a line of the scene is absent there and ‘b = 3’ here");
        assert_eq!(changed_line("a", "a"), None);
    }
}
