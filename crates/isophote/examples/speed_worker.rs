//! Our side of `validation/speed`: a process that runs for the whole comparison and times a renderer on request.
//!
//! `speed_worker --list` prints the names of the contestants, one per line; `speed_worker NAME` then reads one JSON
//! request per line and answers each with one line of JSON, like the workers of the other programs.

use std::error::Error;
use std::hint::black_box;
use std::io::{BufRead, Write, stdin, stdout};
use std::num::NonZeroUsize;
use std::path::Path;
use std::time::{Duration, Instant};

use isophote::lanes::Precision;
use isophote::map::{Map, Pixel, Quantity};
use isophote::prepare::PreparedScene;
use isophote::render::{RenderSettings, Renderer, SimdRenderer};
use isophote::scene::Scene;
use serde::{Deserialize, Serialize};

/// A renderer, and whether it reuses the memory of its last map.
struct Contestant {
    renderer: SimdRenderer,
    reuses: bool,
}

/// All contestants: precision, threads, and memory reuse.
fn contestants() -> Vec<(&'static str, Contestant)> {
    let contestant = |precision, threads, reuses| {
        let renderer = SimdRenderer::new(precision, NonZeroUsize::new(threads));
        Contestant { renderer, reuses }
    };
    vec![
        ("isophote-single-1", contestant(Precision::Single, 1, false)),
        ("isophote-single-2", contestant(Precision::Single, 2, false)),
        ("isophote-single-2-reuse", contestant(Precision::Single, 2, true)),
        ("isophote-double-1", contestant(Precision::Double, 1, false)),
        ("isophote-double-2", contestant(Precision::Double, 2, false)),
        ("isophote-double-2-reuse", contestant(Precision::Double, 2, true)),
    ]
}

#[derive(Deserialize)]
#[serde(tag = "do", rename_all = "lowercase")]
enum Request {
    /// Reads and prepares the scene for the following requests.
    Load { scene: String },
    /// Renders repeatedly for `seconds`, after one render that is not timed.
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
    let (name, contestant) = contestants()
        .into_iter()
        .find(|(name, _)| *name == asked)
        .ok_or_else(|| format!("contestant \"{asked}\": must be one that --list prints"))?;
    serve(name, &contestant)
}

fn serve(name: &'static str, contestant: &Contestant) -> Result<(), Box<dyn Error>> {
    let mut scene = None;
    for line in stdin().lock().lines() {
        let answer = answer(name, &line?, contestant, &mut scene);
        let answer = answer.unwrap_or_else(|error| Answer::Error(error.to_string()));
        println!("{}", serde_json::to_string(&answer)?);
        stdout().flush()?;
    }
    Ok(())
}

fn answer(
    name: &'static str,
    line: &str,
    contestant: &Contestant,
    scene: &mut Option<PreparedScene>,
) -> Result<Answer, Box<dyn Error>> {
    let request = serde_json::from_str(line)?;
    if let Request::Load { scene: path } = &request {
        *scene = Some(PreparedScene::new(&Scene::from_file(Path::new(path))?));
        return Ok(Answer::Loaded(name));
    }
    let scene = scene.as_ref().ok_or("no scene is loaded")?;
    let settings = RenderSettings { quantities: vec![Quantity::Brightness], ..RenderSettings::default() };
    let render = |last: Option<Map>| match last.filter(|_| contestant.reuses) {
        Some(last) => contestant.renderer.render_again(scene, &settings, last),
        None => contestant.renderer.render(scene, &settings),
    };
    match request {
        Request::Time { seconds } => time(render, Duration::try_from_secs_f64(seconds)?),
        Request::Values { pixels } => values(&render(None)?, &pixels),
        Request::Load { .. } => unreachable!("answered above"),
    }
}

fn time<E: Error + 'static>(
    render: impl Fn(Option<Map>) -> Result<Map, E>,
    least: Duration,
) -> Result<Answer, Box<dyn Error>> {
    let mut last = Some(render(None)?);
    let start = Instant::now();
    let mut seconds = Vec::new();
    while seconds.is_empty() || start.elapsed() < least {
        let start = Instant::now();
        // Each map is freed or reused within the next iteration, as in a program that renders one map after another.
        last = Some(black_box(render(last.take())?));
        seconds.push(start.elapsed().as_secs_f64());
    }
    Ok(Answer::Seconds(seconds))
}

fn values(map: &Map, pixels: &[[u32; 2]]) -> Result<Answer, Box<dyn Error>> {
    let brightness = map.scalar(&Quantity::Brightness).ok_or("the map lacks its brightness")?;
    let value = |&[column, row]: &[u32; 2]| {
        let pixel = Pixel { column, row };
        let index = pixel.row as usize * map.full.width as usize + pixel.column as usize;
        (index < brightness.len())
            .then(|| brightness.at(index))
            .ok_or(format!("column {column}, row {row}: outside the image"))
    };
    Ok(Answer::Values(pixels.iter().map(value).collect::<Result<_, _>>()?))
}
