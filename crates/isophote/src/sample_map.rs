//! Maps of given functions, for testing code that reads maps.

use crate::map::{Coordinates, Map, Provenance, Quantity, Resolution, Values, Window};
use crate::units::LengthUnit;

/// What a sample map shows at one pixel.
#[derive(Clone, Copy)]
pub(crate) struct Seen {
    pub(crate) brightness: f64,
    pub(crate) shape: i32,
}

/// A map of brightness over the window −half..half in both directions, in metres; `seen` is called at pixel centres.
pub(crate) fn square_map(pixels: u32, half: f64, seen: impl Fn(f64, f64) -> Option<Seen>) -> Map {
    let size = Resolution { width: pixels, height: pixels };
    let window =
        Window { x: [-half, half], y: [-half, half], length: LengthUnit::Metre, coordinates: Coordinates::Screen };
    let pitch = 2.0 * half / f64::from(pixels);
    let centre = |index: u32| -half + (f64::from(index) + 0.5) * pitch;
    let pixels: Vec<Option<Seen>> = (0..size.height)
        .flat_map(|row| (0..size.width).map(move |column| (row, column)))
        .map(|(row, column)| seen(centre(column), half - (f64::from(row) + 0.5) * pitch))
        .collect();
    let brightness = pixels.iter().map(|pixel| pixel.map_or(0.0, |seen| seen.brightness)).collect();
    let shapes = pixels.iter().map(|pixel| pixel.map_or(-1, |seen| seen.shape)).collect();
    let provenance = Provenance {
        program: "isophote 0.1.0".into(),
        title: "Sample".into(),
        scene: String::new(),
        files: Vec::new(),
        convention: "lab (3.3)".into(),
        renderer: "double reference".into(),
        color_space: None,
    };
    let map = Map::builder(size, window, provenance)
        .channel(Quantity::Brightness, "W/m²", Values::Scalar(brightness))
        .channel(Quantity::Normal, "1", Values::Vector(vec![[0.0; 3]; size.pixels()]))
        .channel(Quantity::Shape, "", Values::Index(shapes));
    map.build().expect("channels of one size, 0 where nothing is seen")
}

/// Shape 0 everywhere, with this brightness.
pub(crate) fn everywhere(brightness: impl Fn(f64, f64) -> f64) -> impl Fn(f64, f64) -> Option<Seen> {
    move |x, y| Some(Seen { brightness: brightness(x, y), shape: 0 })
}
