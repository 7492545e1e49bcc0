//! The map and the colour bar as images.

use isophote::map::Map;

use crate::colormap::Colormap;
use crate::figure::drawing::{Color, Drawing, Image, Rectangle};

/// The mapping from values to colours.
#[derive(Clone, Copy)]
pub(super) struct Scale {
    pub(super) colormap: Colormap,
    /// The values shown in the first and the last colour.
    pub(super) range: [f64; 2],
}

impl Scale {
    pub(super) fn color(&self, value: f64) -> Color {
        self.colormap.color((value - self.range[0]) / (self.range[1] - self.range[0]))
    }
}

/// The map as an image, one image pixel per map pixel, coloured by value; transparent where no surface is seen.
pub(super) fn draw_map(drawing: &mut Drawing, map: &Map, color: impl Fn(usize) -> Color, place: Rectangle) {
    let size = map.region.size;
    let mut rgba = vec![0; 4 * size.pixels()];
    for index in map.mask().indices() {
        let [red, green, blue] = color(index);
        rgba[4 * index..][..4].copy_from_slice(&[red, green, blue, 255]);
    }
    // More map pixels than px on the page: let the viewer average, or thin features would disappear.
    let pixelated = f64::from(size.width) <= 2.0 * place.width;
    drawing.image(Image { place, size: [size.width, size.height], rgba, pixelated });
}

/// The 256 colours, with the last one at the top.
pub(super) fn draw_ramp(drawing: &mut Drawing, colormap: Colormap, place: Rectangle) {
    let color = |index: u32| {
        let [red, green, blue] = colormap.color(f64::from(index) / 255.0);
        [red, green, blue, 255]
    };
    let rgba = (0..256).rev().flat_map(color).collect();
    drawing.image(Image { place, size: [1, 256], rgba, pixelated: true });
}
