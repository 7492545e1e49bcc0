//! The scene that a command works on.

use std::path::PathBuf;

use clap::Args;

/// Where the scene comes from.
#[derive(Args, Default)]
pub struct SceneArgument {
    /// Scene file (TOML, or JSON by its suffix), an output file of this program, or - for standard input; without it,
    /// the lab's scene
    #[arg(value_name = "SCENE")]
    pub scene: Option<PathBuf>,
}
