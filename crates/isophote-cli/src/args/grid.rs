//! The arguments of `isophote grid`.

use std::path::PathBuf;

use clap::Args;
use isophote::map::Resolution;
use isophote::shape::Side;

use crate::args::language::LanguageArgument;
use crate::args::parse;
use crate::args::scene::SceneArgument;
use crate::args::style::CellStyleArguments;
use crate::numbers;

#[derive(Args)]
pub struct GridArguments {
    #[command(flatten)]
    pub scene: SceneArgument,

    /// One of the scene's grids (by default all of them)
    #[arg(long, value_name = "NAME", conflicts_with_all = ["corner", "center", "u", "v", "points", "side"])]
    pub name: Option<String>,

    #[command(flatten)]
    pub placed: PlacedGridArguments,

    /// Channel: irradiance, light.NAME, position or normal; may be given several times. The first one is summed up and
    /// pictured (by default the irradiance, which is the illuminance in a photometric scene)
    #[arg(short, long, value_name = "NAME")]
    pub channel: Vec<String>,

    /// Write the values to FILE: .csv, .png, .exr, .npy or .npz; may be given several times
    #[arg(short, long, value_name = "FILE")]
    pub output: Vec<PathBuf>,

    /// Draw the grid with axes, colour bar and isolines into FILE: .svg or .png; may be given several times
    #[arg(long, value_name = "FILE")]
    pub figure: Vec<PathBuf>,

    #[command(flatten)]
    pub style: CellStyleArguments,

    #[command(flatten)]
    pub language: LanguageArgument,

    /// Print the results, with all values, as JSON
    #[arg(long)]
    pub json: bool,

    /// No notes: only results and errors
    #[arg(short, long)]
    pub quiet: bool,
}

/// A grid in place of the scene's own.
#[derive(Args)]
pub struct PlacedGridArguments {
    /// A grid in place of the scene's own: the corner where both edges begin, in the scene's length unit
    #[arg(long, value_name = "X,Y,Z", allow_hyphen_values = true, conflicts_with = "center", value_parser = parse::point)]
    pub corner: Option<[f64; 3]>,

    /// The middle of the grid, instead of its corner
    #[arg(long, value_name = "X,Y,Z", allow_hyphen_values = true, value_parser = parse::point)]
    pub center: Option<[f64; 3]>,

    /// One edge of the grid: where it leads and how long it is
    #[arg(long, value_name = "X,Y,Z", allow_hyphen_values = true, value_parser = parse::point)]
    pub u: Option<[f64; 3]>,

    /// The other edge, at right angles to the first
    #[arg(long, value_name = "X,Y,Z", allow_hyphen_values = true, value_parser = parse::point)]
    pub v: Option<[f64; 3]>,

    /// Points along u and along v, each in the middle of its cell
    #[arg(long, value_name = "NxM", value_parser = numbers::size)]
    pub points: Option<Resolution>,

    /// The side that is lit: the one to which u × v leads (front), or the other
    #[arg(long, value_name = "SIDE", value_parser = parse::keyword::<Side>())]
    pub side: Option<Side>,
}
