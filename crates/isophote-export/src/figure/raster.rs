//! The map and the colour bar as embedded PNG images.

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use isophote::map::{Map, Resolution};

use crate::colormap::Colormap;
use crate::figure::error::FigureError;
use crate::figure::svg::{Rectangle, Svg, number};

/// The mapping from values to colours.
#[derive(Clone, Copy)]
pub(super) struct Scale {
    pub(super) colormap: Colormap,
    /// The values shown in the first and the last colour.
    pub(super) range: [f64; 2],
}

impl Scale {
    pub(super) fn color(&self, value: f64) -> [u8; 3] {
        self.colormap.color((value - self.range[0]) / (self.range[1] - self.range[0]))
    }
}

/// The map as an image, one image pixel per map pixel, coloured by value; transparent where no surface is seen.
pub(super) fn draw_map(
    svg: &mut Svg,
    map: &Map,
    color: impl Fn(usize) -> [u8; 3],
    place: Rectangle,
) -> Result<(), FigureError> {
    let size = map.region.size;
    let mut pixels = vec![0; 4 * size.pixels()];
    for index in map.mask().indices() {
        let [red, green, blue] = color(index);
        pixels[4 * index..][..4].copy_from_slice(&[red, green, blue, 255]);
    }
    // More map pixels than px on the page: let the viewer average, or thin features would disappear.
    let is_coarse = f64::from(size.width) <= 2.0 * place.width;
    draw_image(svg, size, &pixels, place, is_coarse)
}

/// The 256 colours, with the last one at the top.
pub(super) fn draw_ramp(svg: &mut Svg, colormap: Colormap, place: Rectangle) -> Result<(), FigureError> {
    let color = |index: u32| {
        let [red, green, blue] = colormap.color(f64::from(index) / 255.0);
        [red, green, blue, 255]
    };
    let pixels: Vec<u8> = (0..256).rev().flat_map(color).collect();
    draw_image(svg, Resolution { width: 1, height: 256 }, &pixels, place, true)
}

fn draw_image(
    svg: &mut Svg,
    size: Resolution,
    rgba: &[u8],
    place: Rectangle,
    pixelated: bool,
) -> Result<(), FigureError> {
    let Rectangle { left, top, width, height } = place;
    let [left, top, width, height] = [left, top, width, height].map(number);
    // As a style: the SVG 1.1 attribute does not allow this value, so readers would ignore it there.
    let rendering = if pixelated { " style=\"image-rendering:pixelated\"" } else { "" };
    let data = STANDARD.encode(encode(size, rgba)?);
    svg.raw(&format!(
        "<image x=\"{left}\" y=\"{top}\" width=\"{width}\" height=\"{height}\" preserveAspectRatio=\"none\"{rendering} \
         xlink:href=\"data:image/png;base64,{data}\"/>"
    ));
    Ok(())
}

fn encode(size: Resolution, rgba: &[u8]) -> Result<Vec<u8>, FigureError> {
    let mut file = Vec::new();
    let mut encoder = png::Encoder::new(&mut file, size.width, size.height);
    encoder.set_color(png::ColorType::Rgba);
    encoder.set_depth(png::BitDepth::Eight);
    let mut writer = encoder.write_header().map_err(|error| FigureError::Png(error.to_string()))?;
    writer.write_image_data(rgba).map_err(|error| FigureError::Png(error.to_string()))?;
    writer.finish().map_err(|error| FigureError::Png(error.to_string()))?;
    Ok(file)
}
