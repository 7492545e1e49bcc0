//! The arguments of `isophote section`.

use std::path::PathBuf;

use clap::Args;

use crate::args::parse;
use crate::args::scene::SceneArgument;

#[derive(Args)]
pub struct SectionArguments {
    #[command(flatten)]
    pub scene: SceneArgument,

    #[command(flatten)]
    pub line: LineArgument,

    /// How many points a --line has (by default 513)
    #[arg(long, value_name = "COUNT", value_parser = clap::value_parser!(u32).range(2..=1_000_000))]
    pub samples: Option<u32>,

    /// Channel: brightness, irradiance, ambient, diffuse, specular or depth; may be given several times (by default the
    /// brightness)
    #[arg(short, long, value_name = "NAME")]
    pub channel: Vec<String>,

    /// Write to FILE instead: .csv, .png or .svg; may be given several times
    #[arg(short, long, value_name = "FILE")]
    pub output: Vec<PathBuf>,

    /// Print the values as JSON
    #[arg(long)]
    pub json: bool,

    /// No notes: only results and errors
    #[arg(short, long)]
    pub quiet: bool,
}

#[derive(Args)]
#[group(required = true, multiple = false)]
pub struct LineArgument {
    /// Along a row of pixels, 0 at the top
    #[arg(long, value_name = "ROW")]
    pub row: Option<u32>,

    /// Along a column of pixels, 0 at the left
    #[arg(long, value_name = "COLUMN")]
    pub column: Option<u32>,

    /// Between two points of the screen, in the scene's length unit or, of a fisheye or panorama, in degrees
    #[arg(long, value_name = "X0,Y0,X1,Y1", allow_hyphen_values = true, value_parser = parse::line)]
    pub line: Option<[f64; 4]>,
}
