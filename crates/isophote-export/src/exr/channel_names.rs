//! The names of channels in an EXR file; see the table in [`exr`](crate::exr).

use isophote::map::{Channel, Map, Quantity};

use crate::names;

/// The names of each channel in the file; three for vectors.
pub(super) fn of(map: &Map) -> Vec<Vec<String>> {
    let plain = |character: char| character.is_alphanumeric() || "-_".contains(character);
    let names = names::unique(map.channels(), plain);
    let axes = |layer: &str| ["X", "Y", "Z"].map(|axis| format!("{layer}.{axis}")).to_vec();
    let in_file = |(channel, name): (&Channel, String)| match channel.quantity {
        Quantity::Brightness => vec!["Y".into()],
        Quantity::Color => ["R", "G", "B"].map(String::from).to_vec(),
        Quantity::Depth => vec!["Z".into()],
        Quantity::Position => axes("P"),
        Quantity::Normal => axes("N"),
        Quantity::CameraNormal => axes("camera-normal"),
        Quantity::Shape => vec!["shape.index".into()],
        Quantity::Material => vec!["material.index".into()],
        Quantity::Irradiance
        | Quantity::Ambient
        | Quantity::AmbientError
        | Quantity::SamplingError
        | Quantity::Diffuse
        | Quantity::Specular
        | Quantity::LightBrightness(_)
        | Quantity::Light(_) => {
            vec![format!("{name}.Y")]
        }
        Quantity::Samples | Quantity::Coverage | Quantity::ZDepth | Quantity::CosThetaO => vec![format!("{name}.V")],
    };
    map.channels().iter().zip(names).map(in_file).collect()
}
