//! The parts of a glTF document that affect the shape.

use crate::message;
use crate::text::Message;
use serde::Deserialize;

use super::{follow, transform::Transform};
use crate::import::{Fault, FilePosition, FileProblem, text::shown};

/// The root of the JSON. Keys that are not listed here do not affect the shape.
#[derive(Debug, Deserialize)]
#[serde(rename_all = "camelCase")]
pub(super) struct Document {
    pub asset: Asset,
    pub scene: Option<usize>,
    #[serde(default)]
    pub scenes: Vec<Scene>,
    #[serde(default)]
    pub nodes: Vec<Node>,
    #[serde(default)]
    pub meshes: Vec<Mesh>,
    #[serde(default)]
    pub accessors: Vec<Accessor>,
    #[serde(default)]
    pub buffer_views: Vec<BufferView>,
    #[serde(default)]
    pub buffers: Vec<Buffer>,
    #[serde(default)]
    pub materials: Vec<Material>,
    #[serde(default)]
    pub extensions_required: Vec<String>,
}

#[derive(Debug, Deserialize)]
pub(super) struct Asset {
    pub version: String,
}

#[derive(Debug, Deserialize)]
pub(super) struct Scene {
    #[serde(default)]
    pub nodes: Vec<usize>,
}

#[derive(Debug, Deserialize)]
pub(super) struct Node {
    #[serde(default)]
    pub children: Vec<usize>,
    pub mesh: Option<usize>,
    pub skin: Option<usize>,
    #[serde(default)]
    pub weights: Vec<f64>,
    pub matrix: Option<[f64; 16]>,
    pub translation: Option<[f64; 3]>,
    pub rotation: Option<[f64; 4]>,
    pub scale: Option<[f64; 3]>,
}

#[derive(Debug, Deserialize)]
pub(super) struct Mesh {
    pub primitives: Vec<Primitive>,
    #[serde(default)]
    pub weights: Vec<f64>,
}

#[derive(Debug, Deserialize)]
pub(super) struct Primitive {
    pub attributes: Attributes,
    pub indices: Option<usize>,
    pub material: Option<usize>,
    #[serde(default = "triangles")]
    pub mode: u64,
}

/// The default mode of glTF.
fn triangles() -> u64 {
    4
}

#[derive(Debug, Deserialize)]
#[serde(rename_all = "UPPERCASE")]
pub(super) struct Attributes {
    pub position: Option<usize>,
    pub normal: Option<usize>,
}

#[derive(Debug, Deserialize)]
#[serde(rename_all = "camelCase")]
pub(super) struct Accessor {
    pub buffer_view: Option<usize>,
    #[serde(default)]
    pub byte_offset: u64,
    pub component_type: u64,
    pub count: u64,
    #[serde(rename = "type")]
    pub kind: String,
    pub sparse: Option<serde::de::IgnoredAny>,
}

#[derive(Debug, Deserialize)]
#[serde(rename_all = "camelCase")]
pub(super) struct BufferView {
    pub buffer: usize,
    #[serde(default)]
    pub byte_offset: u64,
    pub byte_length: u64,
    pub byte_stride: Option<u64>,
}

#[derive(Debug, Deserialize)]
#[serde(rename_all = "camelCase")]
pub(super) struct Buffer {
    pub uri: Option<String>,
    pub byte_length: u64,
}

#[derive(Debug, Deserialize)]
pub(super) struct Material {
    pub name: Option<String>,
}

impl Document {
    pub fn parse(json: &[u8]) -> Result<Self, Fault> {
        serde_json::from_slice(json).map_err(|error| {
            let (what, allowed) = (message!("the JSON chunk"), message!("a document of glTF 2.0"));
            FileProblem::Unexpected { what, found: error.to_string(), allowed }
                .at(FilePosition::Json(Message::verbatim("JSON")))
        })
    }

    /// Checks that the numbers describe the shape directly: nothing is compressed, and no pose or morph target changes it.
    pub fn check_supported(&self) -> Result<(), Fault> {
        let unsupported = |place: String, what: Message, instead: Message| {
            Err(FileProblem::Unsupported { what, instead }.at(FilePosition::Json(Message::verbatim(place))))
        };
        if !self.asset.version.starts_with("2.") {
            let what = message!("version {version}", version = shown(self.asset.version.as_bytes()));
            return unsupported("asset".into(), what, message!("export glTF 2.0"));
        }
        let shapeless = ["KHR_materials_", "KHR_texture_", "EXT_texture_", "KHR_lights_punctual"];
        let is_shapeless = |name: &&String| !shapeless.iter().any(|start| name.starts_with(start));
        if let Some(name) = self.extensions_required.iter().find(is_shapeless) {
            let what = message!("extension {name}", name = shown(name.as_bytes()));
            return unsupported(
                "extensionsRequired".into(),
                what,
                message!("export without compression or quantization"),
            );
        }
        let moves = |weights: &[f64]| weights.iter().any(|weight| *weight != 0.0);
        for (index, node) in self.nodes.iter().enumerate() {
            if node.skin.is_some() {
                return unsupported(
                    format!("nodes[{index}]"),
                    message!("a skin"),
                    message!("apply the pose before the export"),
                );
            }
            if moves(&node.weights) {
                return unsupported(
                    format!("nodes[{index}]"),
                    message!("morphing"),
                    message!("apply it before the export"),
                );
            }
        }
        for (index, mesh) in self.meshes.iter().enumerate() {
            if moves(&mesh.weights) {
                return unsupported(
                    format!("meshes[{index}]"),
                    message!("morphing"),
                    message!("apply it before the export"),
                );
            }
        }
        Ok(())
    }

    /// The nodes of the scene (the default one, otherwise the first) with their transforms, parents before children.
    pub fn placed_nodes(&self) -> Result<Vec<(usize, Transform)>, Fault> {
        let scene =
            follow(&self.scenes, self.scene.unwrap_or(0), &message!("document"), || Message::verbatim("scene"))?;
        let mut is_placed = vec![false; self.nodes.len()];
        let mut placed = Vec::new();
        let below = |children: &[usize], transform: Transform| -> Vec<(usize, Transform)> {
            children.iter().rev().map(|child| (*child, transform)).collect()
        };
        let mut waiting = below(&scene.nodes, Transform::IDENTITY);
        while let Some((index, parent)) = waiting.pop() {
            let place = Message::verbatim(format!("nodes[{index}]"));
            let node = follow(&self.nodes, index, &message!("a scene or node"), || message!("a node"))?;
            if std::mem::replace(&mut is_placed[index], true) {
                let (what, allowed) = (message!("the node's parents"), message!("one parent, and no circle"));
                return Err(
                    FileProblem::Unexpected { what, found: "two".into(), allowed }.at(FilePosition::Json(place))
                );
            }
            let transform = Transform::of(node).map_err(|problem| problem.at(FilePosition::Json(place)))?;
            let transform = parent.after(&transform);
            placed.push((index, transform));
            waiting.extend(below(&node.children, transform));
        }
        Ok(placed)
    }

    pub fn material_name(&self, index: usize, place: &Message) -> Result<String, Fault> {
        let material = follow(&self.materials, index, place, || Message::verbatim("material"))?;
        Ok(material.name.clone().unwrap_or_else(|| format!("material {index}")))
    }
}
