//! The arguments of `isophote render`.

use std::num::NonZeroUsize;
use std::path::PathBuf;

use clap::Args;
use isophote::lanes::Precision;
use isophote::map::{Region, Resolution};
use isophote_export::colormap::Colormap;
use isophote_export::png::Normalization;

use crate::args::language::LanguageArgument;
use crate::args::parse;
use crate::args::sampling::SamplingArguments;
use crate::args::scene::SceneArgument;
use crate::args::store::StoreArguments;
use crate::args::style::DEFAULT_ISOPHOTES;
use crate::numbers;

#[derive(Args, Default)]
#[expect(clippy::struct_excessive_bools, reason = "each is a flag of the command line")]
pub struct RenderArguments {
    #[command(flatten)]
    pub scene: SceneArgument,

    /// Write the map to FILE: .png, .exr, .npy, .npz or .csv; may be given several times. Or, alone, to a .zarr store,
    /// which may be larger than memory. Without SCENE, -o and --figure: lab.png
    #[arg(short, long, value_name = "FILE")]
    pub output: Vec<PathBuf>,

    /// Draw the map with axes, colour bar and isophotes (of colours without the two) into FILE: .svg or .png; may be given
    /// several times
    #[arg(long, value_name = "FILE")]
    pub figure: Vec<PathBuf>,

    /// Channel: brightness, color, irradiance, ambient, diffuse, specular, depth, position, normal, shape, samples,
    /// coverage, sampling-error or light.NAME; may be given several times. The first one is summarised and pictured. By default the picture shows the brightness, or its
    /// colours in a scene that has them, and files with many channels get all
    #[arg(short, long, value_name = "NAME")]
    pub channel: Vec<String>,

    /// Add the irradiance from each light as a channel of its own
    #[arg(long)]
    pub lights: bool,

    /// Pixels of the whole image, instead of the scene's
    #[arg(long, value_name = "WIDTHxHEIGHT", value_parser = numbers::size)]
    pub size: Option<Resolution>,

    #[command(flatten)]
    pub sampling: SamplingArguments,

    /// Compute only this part of the image
    #[arg(long, value_name = "COLUMN,ROW,WIDTH,HEIGHT", value_parser = numbers::region)]
    pub region: Option<Region>,

    /// Colours of pictures and figures (pictures are grey by default, figures viridis)
    #[arg(long, value_name = "NAME", value_parser = parse::keyword::<Colormap>())]
    pub colormap: Option<Colormap>,

    /// The values that become the first and the last colour (by default 0 and the maximum; in figures the minimum and
    /// the maximum)
    #[arg(long, value_name = "MIN,MAX", allow_hyphen_values = true, value_parser = parse::range)]
    pub range: Option<[f64; 2]>,

    /// How a .png picture makes levels of values: proportional to them, with the maximum white (max), from the minimum to
    /// the maximum (minmax), or by their logarithm, over three decades up to the maximum (log); --range sets other ends
    #[arg(long, value_name = "HOW", default_value = "max", value_parser = parse::keyword::<Normalization>())]
    pub normalize: Normalization,

    /// Brighten the middle tones of .png pictures: v becomes v^(1/GAMMA)
    #[arg(long, value_name = "GAMMA", default_value_t = 1.0, value_parser = parse::gamma)]
    pub gamma: f64,

    /// Bits of a grey .png picture
    #[arg(long, value_name = "BITS", default_value = "8", value_parser = ["8", "16"])]
    pub bits: String,

    /// About how many isophotes a figure shows; 0 for none
    #[arg(long, value_name = "COUNT", default_value_t = DEFAULT_ISOPHOTES, value_parser = clap::value_parser!(u8).range(0..=50))]
    pub isophotes: u8,

    /// Leave pixels without a surface out of .csv files
    #[arg(long)]
    pub visible_only: bool,

    /// How brightness is computed: in 64 bits (double), or in 32 (single), faster and exact to 3e-6 of the maximum
    #[arg(long, value_name = "PRECISION", default_value = "double", value_parser = parse::keyword::<Precision>())]
    pub precision: Precision,

    /// How many threads compute; as many as there are processors by default
    #[arg(long, value_name = "COUNT", value_parser = parse::threads)]
    pub threads: Option<NonZeroUsize>,

    #[command(flatten)]
    pub store: StoreArguments,

    #[command(flatten)]
    pub language: LanguageArgument,

    /// Print the results as JSON
    #[arg(long)]
    pub json: bool,

    /// No notes, no progress: only results and errors
    #[arg(short, long)]
    pub quiet: bool,
}

impl RenderArguments {
    /// What the bare command does: the lab's scene and its picture.
    pub fn lab() -> Self {
        Self { bits: "8".into(), gamma: 1.0, isophotes: DEFAULT_ISOPHOTES, ..Self::default() }
    }
}
