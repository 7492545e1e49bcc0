//! The arguments of `isophote probe`.

use clap::Args;
use isophote::map::Pixel;

use crate::args::language::LanguageArgument;
use crate::args::parse;
use crate::args::scene::SceneArgument;
use crate::numbers;

#[derive(Args)]
#[expect(clippy::struct_excessive_bools, reason = "each is a flag of the command line")]
pub struct ProbeArguments {
    #[command(flatten)]
    pub scene: SceneArgument,

    /// A point on a surface, in the scene's length unit; may be given several times
    #[arg(long, value_name = "X,Y,Z", allow_hyphen_values = true, value_parser = parse::point)]
    pub at: Vec<[f64; 3]>,

    /// What the centre of a pixel sees; may be given several times
    #[arg(long, value_name = "COLUMN,ROW", allow_hyphen_values = true, value_parser = numbers::pixel)]
    pub pixel: Vec<Pixel>,

    /// A point of a sphere in degrees: THETA from the direction towards the viewer, PHI from the screen's x towards its
    /// y; may be given several times
    #[arg(long, value_name = "THETA,PHI", allow_hyphen_values = true, value_parser = parse::angles)]
    pub angles: Vec<[f64; 2]>,

    /// The sphere that --angles means; not needed when there is only one
    #[arg(long, value_name = "NAME", requires = "angles")]
    pub shape: Option<String>,

    /// Move points given by --at to the nearest surface
    #[arg(long, requires = "at")]
    pub snap: bool,

    /// Show every step of the calculation, with its numbers and formula numbers
    #[arg(long)]
    pub explain: bool,

    #[command(flatten)]
    pub language: LanguageArgument,

    /// Print the results as JSON
    #[arg(long, conflicts_with = "explain")]
    pub json: bool,

    /// No notes: only results and errors
    #[arg(short, long)]
    pub quiet: bool,
}
