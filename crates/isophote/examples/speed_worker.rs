//! Our side of `validation/speed`: a process that lives through the comparison and times a renderer when told to.
//!
//! `speed_worker --list` prints the names of the contestants, one a line; `speed_worker NAME` then reads one JSON request a
//! line and answers each with one line of JSON, as the workers of the other programs do.

use std::error::Error;
use std::hint::black_box;
use std::io::{BufRead, Write, stdin, stdout};
use std::num::NonZeroUsize;
use std::path::Path;
use std::time::{Duration, Instant};

use isophote::map::{Map, Pixel, Quantity};
use isophote::prepare::PreparedScene;
use isophote::render::{RenderSettings, Renderer, Threaded};
use isophote::scene::Scene;
use serde::{Deserialize, Serialize};

/// Every renderer that takes part, with the number of its threads. Another one is another line.
fn contestants() -> Vec<(&'static str, Box<dyn Renderer>)> {
    vec![
        ("isophote-double-1", Box::new(Threaded { threads: NonZeroUsize::new(1) })),
        ("isophote-double-2", Box::new(Threaded { threads: NonZeroUsize::new(2) })),
    ]
}

#[derive(Deserialize)]
#[serde(tag = "do", rename_all = "lowercase")]
enum Request {
    /// Reads and prepares the scene that the next requests are about.
    Load { scene: String },
    /// Renders again and again for so many seconds, after one render that is not timed.
    Time { seconds: f64 },
    /// Brightness at pixels, given as column and row.
    Values { pixels: Vec<[u32; 2]> },
}

#[derive(Serialize)]
#[serde(rename_all = "lowercase")]
enum Answer {
    Loaded(&'static str),
    Seconds(Vec<f64>),
    Values(Vec<f64>),
    Error(String),
}

fn main() -> Result<(), Box<dyn Error>> {
    let asked = std::env::args().nth(1).unwrap_or_default();
    if asked == "--list" {
        for (name, _) in contestants() {
            println!("{name}");
        }
        return Ok(());
    }
    let (name, renderer) = contestants()
        .into_iter()
        .find(|(name, _)| *name == asked)
        .ok_or_else(|| format!("contestant \"{asked}\": must be one that --list prints"))?;
    serve(name, renderer.as_ref())
}

fn serve(name: &'static str, renderer: &dyn Renderer) -> Result<(), Box<dyn Error>> {
    let mut scene = None;
    for line in stdin().lock().lines() {
        let answer = answer(name, &line?, renderer, &mut scene);
        let answer = answer.unwrap_or_else(|error| Answer::Error(error.to_string()));
        println!("{}", serde_json::to_string(&answer)?);
        stdout().flush()?;
    }
    Ok(())
}

fn answer(
    name: &'static str,
    line: &str,
    renderer: &dyn Renderer,
    scene: &mut Option<PreparedScene>,
) -> Result<Answer, Box<dyn Error>> {
    let request = serde_json::from_str(line)?;
    if let Request::Load { scene: path } = &request {
        *scene = Some(PreparedScene::new(&Scene::from_file(Path::new(path))?));
        return Ok(Answer::Loaded(name));
    }
    let scene = scene.as_ref().ok_or("no scene is loaded")?;
    let settings = RenderSettings { quantities: vec![Quantity::Brightness], ..RenderSettings::default() };
    let render = || renderer.render(scene, &settings);
    match request {
        Request::Time { seconds } => time(render, Duration::try_from_secs_f64(seconds)?),
        Request::Values { pixels } => values(&render()?, &pixels),
        Request::Load { .. } => unreachable!("answered above"),
    }
}

fn time<E: Error + 'static>(render: impl Fn() -> Result<Map, E>, least: Duration) -> Result<Answer, Box<dyn Error>> {
    black_box(render()?);
    let start = Instant::now();
    let mut seconds = Vec::new();
    while seconds.is_empty() || start.elapsed() < least {
        let start = Instant::now();
        // The map of one turn is freed before the next begins, as it is in a program that renders one after the other.
        black_box(render()?);
        seconds.push(start.elapsed().as_secs_f64());
    }
    Ok(Answer::Seconds(seconds))
}

fn values(map: &Map, pixels: &[[u32; 2]]) -> Result<Answer, Box<dyn Error>> {
    let brightness = map.scalar(&Quantity::Brightness).ok_or("the map lacks its brightness")?;
    let value = |&[column, row]: &[u32; 2]| {
        let pixel = Pixel { column, row };
        let index = pixel.row as usize * map.full.width as usize + pixel.column as usize;
        brightness.get(index).copied().ok_or(format!("column {column}, row {row}: outside the image"))
    };
    Ok(Answer::Values(pixels.iter().map(value).collect::<Result<_, _>>()?))
}
