//! What an output says of the files that its scene names.

use crate::message;
use crate::text::Message;
use serde::{Deserialize, Serialize};

/// A file that a scene was read from.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct SourceFile {
    /// Its name in the scene.
    pub name: String,
    /// Where it was: the directory of the scene, as it was given, and the name.
    pub path: String,
    /// Its length.
    pub bytes: u64,
    /// The SHA-256 of its content, in hexadecimal digits.
    pub sha256: String,
    /// Its content in Base64, if it is small.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub content: Option<String>,
}

impl SourceFile {
    /// Whether both are the same content under the same name, wherever it was found.
    #[must_use]
    pub fn is_same_content(&self, other: &Self) -> bool {
        (&self.name, self.bytes, &self.sha256) == (&other.name, other.bytes, &other.sha256)
    }

    /// Its length and its hash, for messages.
    #[must_use]
    pub fn describe(&self) -> Message {
        message!("{bytes} bytes with the SHA-256 {hash}", bytes = self.bytes, hash = self.sha256)
    }
}
