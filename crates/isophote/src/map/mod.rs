//! The result of a render: named channels of linear values with units, and their provenance.

mod builder;
mod coordinates;
mod mask;
mod source_file;
mod totals;
mod values;

pub use builder::{MapBuilder, MapError};
pub use coordinates::{CoordinateAxis, Coordinates};
pub use mask::{Mask, Run};
pub use source_file::SourceFile;
pub use totals::{Extreme, Totals, totals};
pub use values::{Scalars, Values};

use serde::{Deserialize, Serialize};

use crate::message;
use crate::reflectance::Convention;
use crate::text::{Language, Message};
use crate::units::{Keyword, LengthUnit, ScreenUnit, UnitSystem};

/// Width and height in pixels.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
pub struct Resolution {
    /// Pixels in a row.
    pub width: u32,
    /// Rows.
    pub height: u32,
}

impl Resolution {
    /// The number of pixels of an image of any size.
    #[must_use]
    pub fn count(self) -> u64 {
        u64::from(self.width) * u64::from(self.height)
    }

    /// The number of pixels of a map in memory. For an image that exceeds the address space it is the largest `usize`, which
    /// cannot be allocated, rather than a product that wrapped around.
    #[must_use]
    pub fn pixels(self) -> usize {
        usize::try_from(self.count()).unwrap_or(usize::MAX)
    }

    /// The longest side of a map in memory: the limit of image formats and their readers.
    pub const LONGEST_IN_MEMORY: u32 = 65_536;
    /// The most pixels of a map in memory: a channel of this many doubles takes 1 GiB.
    pub const MOST_IN_MEMORY: u64 = 1 << 27;

    /// Whether a map of this size may be held in memory as a whole; larger images are rendered region by region.
    #[must_use]
    pub fn fits_memory(self) -> bool {
        self.width.max(self.height) <= Self::LONGEST_IN_MEMORY && self.count() <= Self::MOST_IN_MEMORY
    }
}

/// One pixel: column 0 is the left one, row 0 the top one (2.1).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
pub struct Pixel {
    /// Counted from the left, from 0.
    pub column: u32,
    /// Counted from the top, from 0.
    pub row: u32,
}

/// A rectangle of pixels of the full image.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
pub struct Region {
    /// The top left pixel, counted in the full image.
    pub corner: Pixel,
    /// Its size.
    pub size: Resolution,
}

/// A rectangle on the screen, or on a surface, in the units of its coordinates.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Window {
    /// Left and right edge.
    pub x: [f64; 2],
    /// Lower and upper edge.
    pub y: [f64; 2],
    /// The scene's unit of length: the unit of both, unless the coordinates imply another.
    pub length: LengthUnit,
    /// What x and y are.
    #[serde(default, skip_serializing_if = "Coordinates::is_default")]
    pub coordinates: Coordinates,
}

impl Window {
    /// The unit of the edges on a screen.
    #[must_use]
    pub fn unit(&self) -> ScreenUnit {
        ScreenUnit::of(self.length, self.coordinates == Coordinates::ScreenAngles)
    }
}

/// What a channel holds.
#[derive(Clone, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
pub enum Quantity {
    /// Brightness by the scene's convention (3.1)–(3.12).
    Brightness,
    /// Irradiance (illuminance in a photometric scene), summed over the lights and with the ambient light (3.1).
    Irradiance,
    /// The ambient part of the irradiance (3.9).
    Ambient,
    /// The diffuse part of the brightness.
    Diffuse,
    /// The specular part of the brightness.
    Specular,
    /// Distance to the surface along the viewing ray: from the eye, ‖P − O‖, or, for parallel rays, from the plane through
    /// it.
    Depth,
    /// The point P on the surface.
    Position,
    /// The unit normal at P, on the viewer's side.
    Normal,
    /// Index of the visible shape, −1 where there is none.
    Shape,
    /// The number of rays through the pixel, 0 where no surface is seen.
    Samples,
    /// The fraction of these rays that hit a surface.
    Coverage,
    /// The standard error of [`Ambient`](Self::Ambient), where its obstruction is sampled.
    AmbientError,
    /// A bound on the error of the mean brightness over the pixel's area (2.6); 0 where the value at the centre is the mean.
    /// Only in scenes with a tolerance.
    SamplingError,
    /// The distance of P along the direction of view: that of the plane through P parallel to the screen.
    ZDepth,
    /// The cosine of the angle between the normal and the direction to the eye.
    CosThetaO,
    /// The unit normal in the axes of the camera, which run to the right, down and forward (2.12).
    CameraNormal,
    /// Index of the material that is seen among the scene's materials in the order of their names; −1 where there is none.
    Material,
    /// Brightness from the light with this name alone, one term of (3.1) to (3.6).
    LightBrightness(String),
    /// The brightness of each component of the light: R, G, B in the scene's colour space. Only in scenes with colours,
    /// where every other quantity is a luminance (3.10).
    Color,
    /// Irradiance from the light with this name alone, one term of (3.1).
    Light(String),
}

impl Quantity {
    /// The quantities that every map can hold, whatever the lights are called.
    pub const COMMON: [Self; 9] = [
        Self::Brightness,
        Self::Irradiance,
        Self::Ambient,
        Self::Diffuse,
        Self::Specular,
        Self::Depth,
        Self::Position,
        Self::Normal,
        Self::Shape,
    ];

    /// The quantities that describe how the others were sampled.
    pub const OF_SAMPLING: [Self; 4] = [Self::Samples, Self::Coverage, Self::SamplingError, Self::AmbientError];

    /// The quantities that follow from the point and its normal, in terms of the camera.
    pub const OF_CAMERA: [Self; 3] = [Self::ZDepth, Self::CosThetaO, Self::CameraNormal];

    /// Whether it is made of other channels, or of other maps, once these are there.
    #[must_use]
    pub fn is_derived(&self) -> bool {
        Self::OF_CAMERA.contains(self) || matches!(self, Self::Material | Self::LightBrightness(_))
    }

    /// The unit of the quantity in a scene of this kind: `"1"` for pure numbers, `""` for indices.
    #[must_use]
    pub fn unit(&self, convention: Convention, units: UnitSystem, length: LengthUnit) -> &'static str {
        match self {
            Self::Brightness
            | Self::Color
            | Self::Diffuse
            | Self::Specular
            | Self::SamplingError
            | Self::LightBrightness(_) => convention.unit(units),
            Self::Irradiance | Self::Ambient | Self::AmbientError | Self::Light(_) => units.irradiance_unit(),
            Self::Depth | Self::ZDepth | Self::Position => length.name(),
            Self::Normal | Self::CameraNormal | Self::CosThetaO | Self::Samples | Self::Coverage => "1",
            Self::Shape | Self::Material => "",
        }
    }

    /// Whether it is one number per pixel, so that it has levels and statistics.
    #[must_use]
    pub fn is_scalar(&self) -> bool {
        !matches!(self, Self::Position | Self::Normal | Self::CameraNormal | Self::Shape | Self::Material | Self::Color)
    }

    /// Whether it can be shown as a picture: one number per pixel, or colours.
    #[must_use]
    pub fn can_be_picture(&self) -> bool {
        self.is_scalar() || *self == Self::Color
    }

    /// The quantity with this [name](Self::name).
    #[must_use]
    pub fn from_name(name: &str) -> Option<Self> {
        if let Some(light) = name.strip_prefix("light.") {
            return Some(Self::Light(light.into()));
        }
        if let Some(light) = name.strip_prefix("brightness.") {
            return Some(Self::LightBrightness(light.into()));
        }
        let mut named = Self::COMMON
            .into_iter()
            .chain(Self::OF_SAMPLING)
            .chain(Self::OF_CAMERA)
            .chain([Self::Material, Self::Color]);
        named.find(|quantity| quantity.name() == name)
    }

    /// The channel's name in outputs: `brightness`, `normal`, `light.lamp`, …
    #[must_use]
    pub fn name(&self) -> String {
        match self {
            Self::Brightness => "brightness".into(),
            Self::Irradiance => "irradiance".into(),
            Self::Ambient => "ambient".into(),
            Self::Diffuse => "diffuse".into(),
            Self::Specular => "specular".into(),
            Self::Depth => "depth".into(),
            Self::Position => "position".into(),
            Self::Normal => "normal".into(),
            Self::Shape => "shape".into(),
            Self::Samples => "samples".into(),
            Self::Coverage => "coverage".into(),
            Self::SamplingError => "sampling-error".into(),
            Self::AmbientError => "ambient-error".into(),
            Self::ZDepth => "z-depth".into(),
            Self::CosThetaO => "cos_theta_o".into(),
            Self::CameraNormal => "camera-normal".into(),
            Self::Material => "material".into(),
            Self::LightBrightness(light) => format!("brightness.{light}"),
            Self::Color => "color".into(),
            Self::Light(light) => format!("light.{light}"),
        }
    }
}

/// What people call quantities, in figures and tables.
impl Quantity {
    /// Its name for people: in English that of the channel, in Russian a term, such as «облучённость» for the irradiance.
    #[must_use]
    pub fn label(&self, language: Language) -> String {
        self.label_in(UnitSystem::Radiometric, language)
    }

    /// The same in a scene of a unit system: in Russian the irradiance of a photometric scene is «освещённость».
    #[must_use]
    pub fn label_in(&self, units: UnitSystem, language: Language) -> String {
        match language {
            Language::English => self.name(),
            Language::Russian => self.term(units == UnitSystem::Photometric).in_language(language),
        }
    }

    fn term(&self, is_photometric: bool) -> Message {
        match self {
            Self::Irradiance if is_photometric => message!("illuminance"),
            Self::Ambient if is_photometric => message!("ambient illuminance"),
            Self::AmbientError if is_photometric => message!("standard error of the ambient illuminance"),
            Self::Light(light) if is_photometric => message!("illuminance from \"{light}\"", light),
            Self::Brightness => message!("brightness"),
            Self::Irradiance => message!("irradiance"),
            Self::Ambient => message!("ambient irradiance"),
            Self::Diffuse => message!("diffuse part"),
            Self::Specular => message!("specular part"),
            Self::Depth => message!("depth"),
            Self::Position => message!("point of the surface"),
            Self::Normal => message!("normal"),
            Self::Shape => message!("index of the shape"),
            Self::Samples => message!("number of rays"),
            Self::Coverage => message!("part of the pixel that shows a surface"),
            Self::SamplingError => message!("bound on the error of the mean"),
            Self::AmbientError => message!("standard error of the ambient irradiance"),
            Self::ZDepth => message!("depth along the direction of view"),
            Self::CosThetaO => Message::verbatim("cosθ_o"),
            Self::CameraNormal => message!("normal in the axes of the camera"),
            Self::Material => message!("index of the material"),
            Self::LightBrightness(light) => message!("brightness from \"{light}\"", light),
            Self::Color => message!("colour"),
            Self::Light(light) => message!("irradiance from \"{light}\"", light),
        }
    }
}

/// The values of one quantity over the image.
#[derive(Clone, Debug, PartialEq)]
pub struct Channel {
    /// What it holds.
    pub quantity: Quantity,
    /// Its unit, `"1"` for pure numbers and `""` for indices.
    pub unit: String,
    /// Its values.
    pub values: Values,
}

/// What an output file records about its origin.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Provenance {
    /// `isophote` and its version.
    pub program: String,
    /// The scene's title.
    pub title: String,
    /// The whole scene, as a TOML scene file that renders this map again.
    pub scene: String,
    /// The files that the scene names, as they were read.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub files: Vec<SourceFile>,
    /// The brightness convention and its formula number, such as `lab (3.3)`.
    pub convention: String,
    /// The renderer and its precision.
    pub renderer: String,
    /// The linear RGB space of the scene's colours; `None` for a scene without colours.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub color_space: Option<String>,
}

/// An image of channels.
#[derive(Clone, Debug, PartialEq)]
pub struct Map {
    /// Size of the full image, of which the map may be a part.
    pub full: Resolution,
    /// The part that the map holds.
    pub region: Region,
    /// The region's outer edges on the screen.
    pub window: Window,
    /// Those of the whole image.
    pub(crate) whole: Window,
    /// The provenance of the map.
    pub provenance: Provenance,
    /// In a scene with a tolerance, the number of pixels in which the allowed number of rays was not enough for it: their
    /// [error bound](Quantity::SamplingError) exceeds the tolerance. `None` without a tolerance, and in maps that were not
    /// rendered just now.
    pub over_tolerance: Option<usize>,
    pub(crate) mask: Mask,
    pub(crate) channels: Vec<Channel>,
}

impl Map {
    /// All channels, in the requested order.
    #[must_use]
    pub fn channels(&self) -> &[Channel] {
        &self.channels
    }

    /// Removes the channels that are not wanted.
    pub fn retain(&mut self, is_wanted: impl Fn(&Quantity) -> bool) {
        self.channels.retain(|channel| is_wanted(&channel.quantity));
    }

    /// Adds the shape at each pixel as a channel, if the map does not hold it yet.
    pub fn add_shapes(&mut self) {
        if self.channel(&Quantity::Shape).is_none() {
            let values = Values::Index(self.mask.shapes());
            self.channels.push(Channel { quantity: Quantity::Shape, unit: String::new(), values });
        }
    }

    /// The channel with this quantity, if the map holds it.
    #[must_use]
    pub fn channel(&self, quantity: &Quantity) -> Option<&Channel> {
        self.channels.iter().find(|channel| channel.quantity == *quantity)
    }

    /// Takes the values of a channel out of the map, if it holds it.
    pub fn take(&mut self, quantity: &Quantity) -> Option<Values> {
        let index = self.channels.iter().position(|channel| channel.quantity == *quantity)?;
        Some(self.channels.remove(index).values)
    }

    /// The values of a scalar channel, if the map holds it.
    #[must_use]
    pub fn scalar(&self, quantity: &Quantity) -> Option<Scalars<'_>> {
        Scalars::of(&self.channel(quantity)?.values)
    }

    /// Which pixels see a surface, and which surface. Every map has a mask, whatever channels were requested.
    #[must_use]
    pub fn mask(&self) -> &Mask {
        &self.mask
    }

    /// The centre of a pixel of the full image, in the window's unit. It is reckoned from the edges of the whole image, so that
    /// it is the same in a map of any part.
    #[must_use]
    pub fn center(&self, pixel: Pixel) -> [f64; 2] {
        /// Weighted from both ends, so that a window symmetric about 0 gives coordinates that are symmetric to the last bit.
        fn between(edges: [f64; 2], index: u32, count: u32) -> f64 {
            let (before, after) = (f64::from(index) + 0.5, f64::from(count - index) - 0.5);
            (edges[0] * after + edges[1] * before) / f64::from(count)
        }
        let [bottom, top] = self.whole.y;
        [between(self.whole.x, pixel.column, self.full.width), between([top, bottom], pixel.row, self.full.height)]
    }

    /// The pixel of the full image with this index in the map's values.
    #[must_use]
    #[allow(clippy::cast_possible_truncation, reason = "an index of a map is below 2^27")]
    pub fn pixel(&self, index: usize) -> Pixel {
        let width = self.region.size.width as usize;
        let corner = self.region.corner;
        Pixel { column: corner.column + (index % width) as u32, row: corner.row + (index / width) as u32 }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// On 32 bits as well as on 64: in 32-bit address arithmetic, 65536² is 0.
    #[test]
    fn images_larger_than_any_memory_have_their_number_of_pixels() {
        let square = |side| Resolution { width: side, height: side };
        assert_eq!(square(65_536).count(), 1 << 32);
        assert_eq!(square(1_000_000).count(), 1_000_000_000_000);
        assert_eq!(square(65_536).pixels(), usize::try_from(1_u64 << 32).unwrap_or(usize::MAX));
        for side in [65_536, 65_537, 1_000_000, u32::MAX] {
            assert!(!square(side).fits_memory(), "{side}");
        }
        assert!(Resolution { width: 65_536, height: 2048 }.fits_memory());
        assert!(!Resolution { width: 65_536, height: 2049 }.fits_memory());
        assert!(!Resolution { width: 65_537, height: 1 }.fits_memory());
    }
}
