//! The command line as the user types it.

use std::num::{NonZeroU32, NonZeroUsize};
use std::path::PathBuf;

use clap::builder::{PossibleValuesParser, TypedValueParser};
use clap::{Args, Parser, Subcommand};
use isophote::analysis::surface::SurfaceProjection;
use isophote::export::colormap::Colormap;
use isophote::lanes::Precision;
use isophote::map::{Pixel, Region, Resolution};
use isophote::scene::Filter;
use isophote::scene::library::Starter;
use isophote::scene::source::SamplingSource;
use isophote::shape::Side;
use isophote::units::Keyword;
use isophote_zarr::Part;

use crate::numbers;

/// Brightness of surfaces lit by point lights: maps, exact values at points, pictures.
///
/// Without a command, renders the lab's scene: a table to standard output and the picture lab.png.
#[derive(Parser)]
#[command(name = "isophote", version, max_term_width = 100)]
#[command(after_help = "Exit codes: 0 fine, 1 failed, 2 wrong arguments, 3 invalid scene, 130 interrupted.")]
pub struct Arguments {
    /// What to do.
    #[command(subcommand)]
    pub command: Option<Command>,
}

#[derive(Subcommand)]
pub enum Command {
    /// Compute the brightness map of a scene; print its extremes and probes, write it to files
    Render(RenderArguments),
    /// Print exact values at points of a surface, with every step if asked
    Probe(ProbeArguments),
    /// Print or plot the values along a line of the picture
    Section(SectionArguments),
    /// Print, write or plot a channel over a shape's own surface: its flux, mean and extremes, and its map
    Surface(SurfaceArguments),
    /// Print, write or plot the illuminances at the points of a grid, and how even they are
    Grid(GridArguments),
    /// Put the parts of a .zarr store together: print its extremes and probes, or what is missing
    Merge(MergeArguments),
    /// Check a scene and print it as it is understood, in metres
    Check(CheckArguments),
    /// Write a commented scene file to start from
    New(NewArguments),
    /// Print what an output file says about itself
    Show(ShowArguments),
    /// Print the JSON Schema of scene files
    Schema,
    /// Print the completions for a shell
    Completions {
        /// The shell.
        shell: clap_complete::Shell,
    },
    /// Print the manual page, or that of a command
    Man {
        /// A command, such as `render`.
        command: Option<String>,
    },
}

/// Where the scene comes from.
#[derive(Args, Default)]
pub struct SceneArgument {
    /// Scene file (TOML, or JSON by its suffix), an output file of this program, or - for standard input; without it,
    /// the lab's scene
    #[arg(value_name = "SCENE")]
    pub scene: Option<PathBuf>,
}

/// How many rays a pixel's value is made of, instead of what the scene says.
#[derive(Args, Clone, Copy, Default)]
pub struct SamplingArguments {
    /// Rays for each pixel, whose mean is its value; with --tolerance the most that a pixel gets (256 by default)
    #[arg(long, value_name = "COUNT")]
    pub samples: Option<u64>,

    /// Smooth edges: each pixel gets as many rays as keep the error of its brightness below this part of the largest
    #[arg(long, value_name = "PART")]
    pub tolerance: Option<f64>,

    /// What a pixel is a mean over: its own area (box), or more (triangle, gaussian, mitchell)
    #[arg(long, value_name = "NAME", value_parser = keyword::<Filter>())]
    pub filter: Option<Filter>,
}

impl SamplingArguments {
    pub fn source(self) -> SamplingSource {
        SamplingSource { samples: self.samples, tolerance: self.tolerance, filter: self.filter }
    }
}

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
    /// coverage or light.NAME; may be given
    /// several times. The first one is summarised and pictured. By default the picture shows the brightness, or its
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
    #[arg(long, value_name = "NAME", value_parser = keyword::<Colormap>())]
    pub colormap: Option<Colormap>,

    /// The values that become the first and the last colour (by default 0 and the maximum; in figures the minimum and
    /// the maximum)
    #[arg(long, value_name = "MIN,MAX", allow_hyphen_values = true, value_parser = parse_range)]
    pub range: Option<[f64; 2]>,

    /// Brighten the middle tones of .png pictures: v becomes v^(1/GAMMA)
    #[arg(long, value_name = "GAMMA", default_value_t = 1.0, value_parser = parse_gamma)]
    pub gamma: f64,

    /// Bits of a grey .png picture
    #[arg(long, value_name = "BITS", default_value = "8", value_parser = ["8", "16"])]
    pub bits: String,

    /// About how many isophotes a figure shows; 0 for none
    #[arg(long, value_name = "COUNT", default_value_t = crate::commands::DEFAULT_ISOPHOTES, value_parser = clap::value_parser!(u8).range(0..=50))]
    pub isophotes: u8,

    /// Leave pixels without a surface out of .csv files
    #[arg(long)]
    pub visible_only: bool,

    /// How brightness is computed: in 64 bits (double), or in 32 (single), faster and exact to 3e-6 of the maximum
    #[arg(long, value_name = "PRECISION", default_value = "double", value_parser = keyword::<Precision>())]
    pub precision: Precision,

    /// How many threads compute; as many as there are processors by default
    #[arg(long, value_name = "COUNT", value_parser = parse_threads)]
    pub threads: Option<NonZeroUsize>,

    #[command(flatten)]
    pub store: StoreArguments,

    /// Print the results as JSON
    #[arg(long)]
    pub json: bool,

    /// No notes, no progress: only results and errors
    #[arg(short, long)]
    pub quiet: bool,
}

/// What concerns .zarr stores alone.
#[derive(Args, Default)]
pub struct StoreArguments {
    /// Continue a .zarr store that was not finished; begin it if there is none
    #[arg(long)]
    pub resume: bool,

    /// Compute only every N-th shard of a .zarr store, the I-th of each N, beside other processes that compute the
    /// others; `isophote merge` puts them together
    #[arg(long, value_name = "I/N", value_parser = parse_part)]
    pub shard: Option<Part>,

    /// Memory that the computation of a .zarr store may take, such as 512M or 2G
    #[arg(long, value_name = "SIZE", value_parser = numbers::memory)]
    pub memory: Option<u64>,

    /// Side of a shard in pixels, for tests that need many shards of a small image
    #[arg(long, value_name = "PIXELS", hide = true)]
    pub shard_side: Option<NonZeroU32>,
}

#[derive(Args)]
#[expect(clippy::struct_excessive_bools, reason = "each is a flag of the command line")]
pub struct ProbeArguments {
    #[command(flatten)]
    pub scene: SceneArgument,

    /// A point on a surface, in the scene's length unit; may be given several times
    #[arg(long, value_name = "X,Y,Z", allow_hyphen_values = true, value_parser = parse_point)]
    pub at: Vec<[f64; 3]>,

    /// What the centre of a pixel sees; may be given several times
    #[arg(long, value_name = "COLUMN,ROW", allow_hyphen_values = true, value_parser = numbers::pixel)]
    pub pixel: Vec<Pixel>,

    /// A point of a sphere in degrees: THETA from the direction towards the viewer, PHI from the screen's x towards its
    /// y; may be given several times
    #[arg(long, value_name = "THETA,PHI", allow_hyphen_values = true, value_parser = parse_angles)]
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

    /// Print the results as JSON
    #[arg(long, conflicts_with = "explain")]
    pub json: bool,

    /// No notes: only results and errors
    #[arg(short, long)]
    pub quiet: bool,
}

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
    #[arg(long, value_name = "X0,Y0,X1,Y1", allow_hyphen_values = true, value_parser = parse_line)]
    pub line: Option<[f64; 4]>,
}

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
    #[arg(long, value_name = "NAME", default_value = "equirectangular", value_parser = keyword::<SurfaceProjection>())]
    pub projection: SurfaceProjection,

    /// The direction in which the latitude of a sphere is 90° (by default 0,1,0)
    #[arg(long, value_name = "X,Y,Z", allow_hyphen_values = true, value_parser = parse_direction)]
    pub axis: Option<[f64; 3]>,

    /// The same, by the light to which the axis leads
    #[arg(long, value_name = "LIGHT", conflicts_with = "axis")]
    pub towards: Option<String>,

    /// Which side: the outside of a closed shape and the side of a flat one's normal, or the other
    #[arg(long, value_name = "SIDE", default_value = "front", value_parser = keyword::<Side>())]
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

    /// Print the results as JSON
    #[arg(long)]
    pub json: bool,

    /// No notes: only results and errors
    #[arg(short, long)]
    pub quiet: bool,
}

/// How maps of surfaces and grids are pictured.
#[derive(Args)]
pub struct CellStyleArguments {
    /// Colours of pictures and figures (pictures are grey by default, figures viridis)
    #[arg(long, value_name = "NAME", value_parser = keyword::<Colormap>())]
    pub colormap: Option<Colormap>,

    /// The values that become the first and the last colour (by default 0 and the maximum; in figures the minimum and
    /// the maximum)
    #[arg(long, value_name = "MIN,MAX", allow_hyphen_values = true, value_parser = parse_range)]
    pub range: Option<[f64; 2]>,

    /// About how many isophotes a figure shows; 0 for none
    #[arg(long, value_name = "COUNT", default_value_t = crate::commands::DEFAULT_ISOPHOTES, value_parser = clap::value_parser!(u8).range(0..=50))]
    pub isophotes: u8,
}

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
    #[arg(long, value_name = "X,Y,Z", allow_hyphen_values = true, conflicts_with = "center", value_parser = parse_point)]
    pub corner: Option<[f64; 3]>,

    /// The middle of the grid, instead of its corner
    #[arg(long, value_name = "X,Y,Z", allow_hyphen_values = true, value_parser = parse_point)]
    pub center: Option<[f64; 3]>,

    /// One edge of the grid: where it leads and how long it is
    #[arg(long, value_name = "X,Y,Z", allow_hyphen_values = true, value_parser = parse_point)]
    pub u: Option<[f64; 3]>,

    /// The other edge, at right angles to the first
    #[arg(long, value_name = "X,Y,Z", allow_hyphen_values = true, value_parser = parse_point)]
    pub v: Option<[f64; 3]>,

    /// Points along u and along v, each in the middle of its cell
    #[arg(long, value_name = "NxM", value_parser = numbers::size)]
    pub points: Option<Resolution>,

    /// The side that is lit: the one to which u × v leads (front), or the other
    #[arg(long, value_name = "SIDE", value_parser = keyword::<Side>())]
    pub side: Option<Side>,
}

#[derive(Args)]
pub struct CheckArguments {
    #[command(flatten)]
    pub scene: SceneArgument,

    /// Print the scene, with every default filled in, as JSON
    #[arg(long)]
    pub json: bool,

    /// No warnings: only results and errors
    #[arg(short, long)]
    pub quiet: bool,
}

#[derive(Args)]
pub struct NewArguments {
    /// Which scene
    #[arg(value_name = "NAME", value_parser = keyword::<Starter>())]
    pub name: Starter,

    /// Write to FILE (by default NAME.toml), or - for standard output
    #[arg(short, long, value_name = "FILE")]
    pub output: Option<PathBuf>,

    /// Overwrite a file that exists
    #[arg(short, long)]
    pub force: bool,
}

#[derive(Args)]
pub struct MergeArguments {
    /// A .zarr store whose parts were computed by `isophote render --shard`
    pub store: PathBuf,

    /// Read every shard and compare it with its checksums
    #[arg(long)]
    pub check: bool,

    /// Print the results as JSON
    #[arg(long)]
    pub json: bool,
}

#[derive(Args)]
pub struct ShowArguments {
    /// A file or .zarr store that this program wrote
    pub file: PathBuf,

    /// Print the scene that the file carries, as a scene file
    #[arg(long, conflicts_with = "json")]
    pub scene: bool,

    /// Print everything as JSON
    #[arg(long)]
    pub json: bool,
}

/// One of a closed set of words.
fn keyword<C: Keyword + Send + Sync>() -> impl TypedValueParser<Value = C> {
    let names = C::ALL.iter().map(|choice| choice.name());
    PossibleValuesParser::new(names).try_map(|name| C::from_name(&name).ok_or("no such word"))
}

fn parse_point(text: &str) -> Result<[f64; 3], String> {
    numbers::finite(text, "X,Y,Z, such as 0,0,4")
}

fn parse_direction(text: &str) -> Result<[f64; 3], String> {
    let direction: [f64; 3] = numbers::finite(text, "X,Y,Z, such as 0,1,0")?;
    let largest = direction.iter().fold(0.0_f64, |largest, component| largest.max(component.abs()));
    if (1e-100..=1e100).contains(&largest) { Ok(direction) } else { Err("allowed: any direction with a length".into()) }
}

fn parse_angles(text: &str) -> Result<[f64; 2], String> {
    numbers::finite(text, "THETA,PHI in degrees, such as 45,90")
}

fn parse_line(text: &str) -> Result<[f64; 4], String> {
    numbers::finite(text, "X0,Y0,X1,Y1, such as -1,0,1,0")
}

fn parse_range(text: &str) -> Result<[f64; 2], String> {
    let range: [f64; 2] = numbers::finite(text, "MIN,MAX, such as 0,0.5")?;
    if range[0] < range[1] { Ok(range) } else { Err("MIN must be smaller than MAX".into()) }
}

/// Tens of thousands of threads would bring the machine to a standstill before the system refuses the next one.
fn parse_threads(text: &str) -> Result<NonZeroUsize, String> {
    let threads = text.parse().ok().filter(|threads: &NonZeroUsize| threads.get() <= 1024);
    threads.ok_or_else(|| "allowed: 1 to 1024".into())
}

fn parse_part(text: &str) -> Result<Part, String> {
    let part =
        text.split_once('/').and_then(|(number, of)| Part::new(number.trim().parse().ok()?, of.trim().parse().ok()?));
    part.ok_or_else(|| "expected I/N with I from 1 to N, such as 3/16".into())
}

fn parse_gamma(text: &str) -> Result<f64, String> {
    let gamma: f64 = text.parse().map_err(|_| "expected a number".to_owned())?;
    if (0.1..=10.0).contains(&gamma) { Ok(gamma) } else { Err("allowed: 0.1 to 10".into()) }
}
