//! How pictures look.

use clap::Args;
use isophote_export::colormap::Colormap;

use crate::args::parse;

/// About how many isophotes a figure shows that is not told.
pub const DEFAULT_ISOPHOTES: u8 = 6;

/// How maps of surfaces and grids are pictured.
#[derive(Args)]
pub struct CellStyleArguments {
    /// Colours of pictures and figures (pictures are grey by default, figures viridis)
    #[arg(long, value_name = "NAME", value_parser = parse::keyword::<Colormap>())]
    pub colormap: Option<Colormap>,

    /// The values that become the first and the last colour (by default 0 and the maximum; in figures the minimum and
    /// the maximum)
    #[arg(long, value_name = "MIN,MAX", allow_hyphen_values = true, value_parser = parse::range)]
    pub range: Option<[f64; 2]>,

    /// About how many isophotes a figure shows; 0 for none
    #[arg(long, value_name = "COUNT", default_value_t = DEFAULT_ISOPHOTES, value_parser = clap::value_parser!(u8).range(0..=50))]
    pub isophotes: u8,
}
