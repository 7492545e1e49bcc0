//! How pixels are sampled.

use clap::Args;
use isophote::scene::Filter;
use isophote::scene::source::SamplingSource;

use crate::args::parse;

/// How many rays a pixel's value is made of, instead of what the scene says.
#[derive(Args, Clone, Copy, Default)]
pub struct SamplingArguments {
    /// Rays for each pixel, whose mean is its value; with --tolerance the most that a pixel gets (4096 by default)
    #[arg(long, value_name = "COUNT")]
    pub samples: Option<u64>,

    /// Smooth edges: each pixel gets as many rays as keep the error of its brightness below this part of the largest
    #[arg(long, value_name = "PART")]
    pub tolerance: Option<f64>,

    /// What a pixel is a mean over: its own area (box), or more (triangle, gaussian, mitchell)
    #[arg(long, value_name = "NAME", value_parser = parse::keyword::<Filter>())]
    pub filter: Option<Filter>,
}

impl SamplingArguments {
    pub fn source(self) -> SamplingSource {
        SamplingSource { samples: self.samples, tolerance: self.tolerance, filter: self.filter }
    }
}
