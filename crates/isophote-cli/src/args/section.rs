//! The arguments of `isophote section`.

use std::path::PathBuf;

use clap::Args;

use crate::args::language::LanguageArgument;
use crate::args::parse;
use crate::args::scene::SceneArgument;

#[derive(Args)]
pub struct SectionArguments {
    #[command(flatten)]
    pub scene: SceneArgument,

    #[command(flatten)]
    pub line: LineArgument,

    /// How many points a line has that is no row or column of pixels (by default 513)
    #[arg(long, value_name = "COUNT", value_parser = clap::value_parser!(u32).range(2..=1_000_000))]
    pub samples: Option<u32>,

    /// Channel: brightness, irradiance, ambient, diffuse, specular or depth; may be given several times (by default the
    /// brightness)
    #[arg(short, long, value_name = "NAME")]
    pub channel: Vec<String>,

    /// Write to FILE instead: .csv, .png or .svg; may be given several times
    #[arg(short, long, value_name = "FILE")]
    pub output: Vec<PathBuf>,

    #[command(flatten)]
    pub language: LanguageArgument,

    /// Print the values as JSON
    #[arg(long)]
    pub json: bool,

    /// No notes: only results and errors
    #[arg(short, long)]
    pub quiet: bool,
}

/// The lines; all together in one table, file or plot.
#[derive(Args)]
#[group(required = true, multiple = true)]
pub struct LineArgument {
    /// Horizontally and vertically through the centre of a shape, as it appears on the screen, from edge to edge of the image
    #[arg(long, value_name = "NAME")]
    pub through: Vec<String>,

    /// From the left edge of the image to the right one, at this y of the screen, in the scene's length unit or, of a fisheye
    /// or panorama, in degrees
    #[arg(long, value_name = "Y", allow_hyphen_values = true, value_parser = parse::number)]
    pub horizontal: Vec<f64>,

    /// From the lower edge of the image to the upper one, at this x of the screen
    #[arg(long, value_name = "X", allow_hyphen_values = true, value_parser = parse::number)]
    pub vertical: Vec<f64>,

    /// Between two points of the screen
    #[arg(long, value_name = "X0,Y0,X1,Y1", allow_hyphen_values = true, value_parser = parse::line)]
    pub line: Vec<[f64; 4]>,

    /// Along the centres of a row of pixels, 0 at the top. If the image has an even number of rows, none runs through its
    /// middle
    #[arg(long, value_name = "ROW")]
    pub row: Vec<u32>,

    /// Along the centres of a column of pixels, 0 at the left
    #[arg(long, value_name = "COLUMN")]
    pub column: Vec<u32>,
}
