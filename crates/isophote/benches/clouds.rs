//! Clouds of spheres with shadows, from a thousand spheres to a million: time to read, to build and to render, and peak
//! memory. Each case runs in its own process, so that its memory can be measured.

use std::error::Error;
use std::fs::File;
use std::io::{BufWriter, Write};
use std::num::NonZeroUsize;
use std::path::Path;
use std::process::Command;
use std::time::{Duration, Instant};

use isophote::lanes::Precision;
use isophote::map::Quantity;
use isophote::prepare::PreparedScene;
use isophote::render::{RenderSettings, Renderer, SimdRenderer};
use isophote::scene::Scene;

/// One case: what is rendered, and how.
#[derive(Clone, Copy)]
struct Case {
    spheres: u32,
    radius: f64,
    lights: u32,
    threads: usize,
    precision: Precision,
}

fn main() -> Result<(), Box<dyn Error>> {
    let arguments: Vec<String> = std::env::args().collect();
    if let Some(at) = arguments.iter().position(|argument| argument == "--case") {
        return run(&Case::parse(&arguments[at + 1..])?);
    }
    println!("spheres  radius  lights  threads  precision  read ms  build ms  render ms  peak MB");
    let target = Case { spheres: 100_000, radius: 0.02, lights: 1, threads: 2, precision: Precision::Single };
    let mut cases = vec![
        target,
        Case { threads: 1, ..target },
        Case { precision: Precision::Double, ..target },
        Case { lights: 16, ..target },
        Case { lights: 16, threads: 1, ..target },
    ];
    // First all spheres have the same size, then they fill the same part of the box's volume.
    let counts = [1_000, 3_000, 10_000, 30_000, 100_000, 300_000, 1_000_000];
    cases.extend(counts.map(|spheres| Case { spheres, ..target }));
    cases.extend(counts.map(|spheres| Case {
        spheres,
        radius: 0.02 * (100_000.0 / f64::from(spheres)).cbrt(),
        ..target
    }));
    for case in cases {
        let Case { spheres, radius, lights, threads, precision } = case;
        let is_single = u8::from(precision == Precision::Single);
        let numbers = [spheres.to_string(), radius.to_string(), lights.to_string(), threads.to_string()];
        let status =
            Command::new(std::env::current_exe()?).arg("--case").args(numbers).arg(is_single.to_string()).status()?;
        if !status.success() {
            return Err(format!("{spheres} spheres: {status}").into());
        }
    }
    Ok(())
}

impl Case {
    fn parse(arguments: &[String]) -> Result<Self, Box<dyn Error>> {
        let [spheres, radius, lights, threads, is_single, ..] = arguments else { return Err("five numbers".into()) };
        Ok(Self {
            spheres: spheres.parse()?,
            radius: radius.parse()?,
            lights: lights.parse()?,
            threads: threads.parse()?,
            precision: if is_single == "1" { Precision::Single } else { Precision::Double },
        })
    }
}

fn run(case: &Case) -> Result<(), Box<dyn Error>> {
    let folder = tempfile::tempdir()?;
    write_spheres(&folder.path().join("cloud.npy"), case)?;
    let path = folder.path().join("cloud.toml");
    std::fs::write(&path, scene_text(case))?;
    let (read, scene) = timed(|| Scene::from_file(&path));
    let scene = scene?;
    let (build, prepared) = timed(|| PreparedScene::new(&scene));
    let renderer = SimdRenderer::new(case.precision, NonZeroUsize::new(case.threads));
    let settings = RenderSettings { quantities: vec![Quantity::Brightness], ..RenderSettings::default() };
    let start = Instant::now();
    let mut render = Duration::MAX;
    let mut turns = 0;
    while turns < 3 || start.elapsed() < Duration::from_secs(2) {
        let (time, map) = timed(|| renderer.render(&prepared, &settings));
        map?;
        render = render.min(time);
        turns += 1;
    }
    let ms = |time: Duration| time.as_secs_f64() * 1e3;
    println!(
        "{:7}  {:.4}  {:6}  {:7}  {:>9}  {:7.1}  {:8.1}  {:9.2}  {:7.0}",
        case.spheres,
        case.radius,
        case.lights,
        case.threads,
        if case.precision == Precision::Single { "single" } else { "double" },
        ms(read),
        ms(build),
        ms(render),
        peak_memory(),
    );
    Ok(())
}

fn timed<T>(work: impl FnOnce() -> T) -> (Duration, T) {
    let start = Instant::now();
    let result = work();
    (start.elapsed(), result)
}

/// Peak memory of the process in megabytes, as reported by Linux.
fn peak_memory() -> f64 {
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let line = status.lines().find_map(|line| line.strip_prefix("VmHWM:"));
    line.and_then(|line| line.trim().trim_end_matches("kB").trim().parse::<f64>().ok()).map_or(f64::NAN, |kb| kb / 1e3)
}

/// Uniform in [−2, 2] × [−1.5, 1.5] × [4, 7].
fn write_spheres(path: &Path, case: &Case) -> Result<(), Box<dyn Error>> {
    let mut file = BufWriter::new(File::create(path)?);
    let header = format!("{{'descr': '<f8', 'fortran_order': False, 'shape': ({}, 4), }}", case.spheres);
    let header = format!("{header:<117}\n");
    file.write_all(b"\x93NUMPY\x01\x00")?;
    file.write_all(&u16::try_from(header.len())?.to_le_bytes())?;
    file.write_all(header.as_bytes())?;
    let mut random = Random(1);
    for _ in 0..case.spheres {
        let numbers = [random.between(-2.0, 2.0), random.between(-1.5, 1.5), random.between(4.0, 7.0), case.radius];
        for number in numbers {
            file.write_all(&number.to_le_bytes())?;
        }
    }
    Ok(file.flush()?)
}

/// A full-HD view through the front of the box, with the lights in front of it.
fn scene_text(case: &Case) -> String {
    let mut text = String::from(
        "version = 1\nlength = \"m\"\nhandedness = \"left\"\nconvention = \"lab\"\nshadows = true
        [camera]\neye = [0, 0, 0]\nforward = [0, 0, 1]\nup = [0, 1, 0]\nresolution = [1920, 1080]
        screen = { distance = 4, x = [-2, 2], y = [-1.125, 1.125] }
        [material.clay]\ndiffuse = 0.7\nspecular = 0.3\nshininess = 20
        [[spheres]]\nfile = \"cloud.npy\"\nmaterial = \"clay\"\n",
    );
    let mut random = Random(2);
    for light in 0..case.lights {
        let position = match light {
            0 => [5.0, 5.0, -10.0],
            _ => [random.between(-8.0, 8.0), random.between(-8.0, 8.0), random.between(-10.0, 2.0)],
        };
        text.extend(["[[light]]\nposition = ", &format!("{position:?}"), "\nintensity = 100\n"]);
    }
    text
}

/// SplitMix64 by Steele and Vigna.
struct Random(u64);

impl Random {
    #[expect(clippy::cast_precision_loss, reason = "53 bits")]
    fn between(&mut self, low: f64, high: f64) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut bits = self.0;
        bits = (bits ^ (bits >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        bits = (bits ^ (bits >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        low + (high - low) * ((bits ^ (bits >> 31)) >> 11) as f64 / (1_u64 << 53) as f64
    }
}
