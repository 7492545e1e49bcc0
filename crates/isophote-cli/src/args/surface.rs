//! The arguments of `isophote surface`.

use std::path::PathBuf;

use clap::Args;
use isophote::analysis::surface::SurfaceProjection;
use isophote::map::Resolution;
use isophote::shape::Side;

use crate::args::language::LanguageArgument;
use crate::args::parse;
use crate::args::scene::SceneArgument;
use crate::args::style::CellStyleArguments;
use crate::numbers;

#[derive(Args)]
pub struct SurfaceArguments {
    #[command(flatten)]
    pub scene: SceneArgument,

    /// The shape: a sphere, a cylinder, a rectangle or a disk; not needed when there is only one
    #[arg(long, value_name = "NAME")]
    pub shape: Option<String>,

    /// Which of the spheres that are one shape, from 0
    #[arg(long, value_name = "NUMBER")]
    pub part: Option<u32>,

    /// Cells of the map (by default 360 columns, and as many rows as make cells about square)
    #[arg(long, value_name = "COLUMNSxROWS", value_parser = numbers::size)]
    pub size: Option<Resolution>,

    /// Even steps of latitude or radius, or rows of equal area
    #[arg(long, value_name = "NAME", default_value = "equirectangular", value_parser = parse::keyword::<SurfaceProjection>())]
    pub projection: SurfaceProjection,

    /// The direction in which the latitude of a sphere is 90° (by default 0,1,0)
    #[arg(long, value_name = "X,Y,Z", allow_hyphen_values = true, value_parser = parse::direction)]
    pub axis: Option<[f64; 3]>,

    /// The same, by the light to which the axis leads
    #[arg(long, value_name = "LIGHT", conflicts_with = "axis")]
    pub towards: Option<String>,

    /// Which side: the outside of a closed shape and the side of a flat one's normal, or the other
    #[arg(long, value_name = "SIDE", default_value = "front", value_parser = parse::keyword::<Side>())]
    pub side: Side,

    /// Channel: irradiance, light.NAME, position, normal, or brightness, color, diffuse or specular as the eye sees them;
    /// may be given several times. The first one is summed up and pictured (by default the irradiance)
    #[arg(short, long, value_name = "NAME")]
    pub channel: Vec<String>,

    /// Write the map to FILE: .png, .exr, .npy, .npz or .csv; may be given several times
    #[arg(short, long, value_name = "FILE")]
    pub output: Vec<PathBuf>,

    /// Draw the map with axes, colour bar and isophotes into FILE: .svg or .png; may be given several times
    #[arg(long, value_name = "FILE")]
    pub figure: Vec<PathBuf>,

    #[command(flatten)]
    pub style: CellStyleArguments,

    #[command(flatten)]
    pub language: LanguageArgument,

    /// Print the results as JSON
    #[arg(long)]
    pub json: bool,

    /// No notes: only results and errors
    #[arg(short, long)]
    pub quiet: bool,
}
