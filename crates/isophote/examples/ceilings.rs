//! The machine's peak rates: fused multiply-adds and stores per second, on one thread and on two. `validation/speed`
//! measures them in the same run as the renderers, so that results can be stated as a share of the peak.
//!
//! Prints one line of JSON: the SIMD level, GFLOP/s (an FMA counts as two) and GB/s.

#![expect(clippy::cast_precision_loss, reason = "counts of operations and bytes, far below 2^53")]

use std::hint::black_box;
use std::time::Instant;

use fearless_simd::{Level, dispatch, prelude::*};

/// Independent chains of FMAs. An FMA takes 4 cycles and two can start in each, so 8 would do on x86-64; 12 also hide
/// the loop overhead, and still fit into the 16 registers of AVX2.
const CHAINS: usize = 12;
const STEPS: u32 = 1_000_000;
/// A 3840×2160 frame of 32-bit numbers, 33 MB: more than a core's own caches hold.
const FRAME: usize = 3840 * 2160;
const FRAMES: u32 = 4;
/// Many short runs, so that the best one is undisturbed.
const REPEATS: usize = 60;

fn main() {
    let level = Level::new();
    let report = serde_json::json!({
        "level": level_name(level),
        "gflops": {
            "f32": { "1": fma_f32(level, 1), "2": fma_f32(level, 2) },
            "f64": { "1": fma_f64(level, 1), "2": fma_f64(level, 2) },
        },
        "store_gb_per_s": { "1": stores(level, 1), "2": stores(level, 2) },
    });
    println!("{report}");
}

/// The name of the SIMD level, without its features.
fn level_name(level: Level) -> String {
    let name = format!("{level:?}");
    name.split(['(', ' ']).next().unwrap_or(&name).to_owned()
}

/// The best of several runs, in units of 10⁹ per second.
fn best(rate: impl FnMut() -> f64) -> f64 {
    std::iter::repeat_with(rate).take(REPEATS).fold(0.0, f64::max)
}

/// Runs the closures in parallel, each on its own thread, and returns their joint rate.
fn rate<W: FnOnce() -> f64 + Send>(works: impl Iterator<Item = W>) -> f64 {
    let start = Instant::now();
    let done: f64 = std::thread::scope(|scope| {
        let threads: Vec<_> = works.map(|work| scope.spawn(work)).collect();
        threads.into_iter().map(|thread| thread.join().expect("nothing in it panics")).sum()
    });
    done / start.elapsed().as_secs_f64() / 1e9
}

/// GFLOP/s of FMAs in single precision.
fn fma_f32(level: Level, threads: usize) -> f64 {
    best(|| rate((0..threads).map(|_| || dispatch!(level, simd => chains_f32(simd)))))
}

/// GFLOP/s of FMAs in double precision.
fn fma_f64(level: Level, threads: usize) -> f64 {
    best(|| rate((0..threads).map(|_| || dispatch!(level, simd => chains_f64(simd)))))
}

#[inline(always)]
fn chains_f32<S: Simd>(simd: S) -> f64 {
    chains::<S, S::f32s>(simd, 0.999, 0.001)
}

#[inline(always)]
fn chains_f64<S: Simd>(simd: S) -> f64 {
    chains::<S, S::f64s>(simd, 0.999, 0.001)
}

/// Runs the chains and returns the number of floating-point operations.
#[inline(always)]
fn chains<S: Simd, V: SimdFloat<S>>(simd: S, factor: V::Element, addend: V::Element) -> f64 {
    let factor = V::simd_from(simd, black_box(factor));
    let addend = V::simd_from(simd, black_box(addend));
    let mut chains = [addend; CHAINS];
    for _ in 0..STEPS {
        for chain in &mut chains {
            *chain = chain.mul_add(factor, addend);
        }
    }
    black_box(chains.map(|chain| chain.as_slice()[0]));
    2.0 * f64::from(STEPS) * (CHAINS * V::LEN) as f64
}

/// GB/s of plain stores, with a frame divided equally among the threads.
fn stores(level: Level, threads: usize) -> f64 {
    let mut frame = vec![1.0_f32; FRAME];
    best(|| {
        let parts = frame.chunks_mut(FRAME / threads);
        rate(parts.map(|part| move || dispatch!(level, simd => store(simd, part))))
    })
}

/// Writes a part of a frame repeatedly and returns the number of bytes written.
#[inline(always)]
fn store<S: Simd>(simd: S, part: &mut [f32]) -> f64 {
    let mut value = S::f32s::simd_from(simd, black_box(1.0));
    for _ in 0..FRAMES {
        // A new value for each frame, so that the compiler cannot drop the stores of one frame in favour of the next.
        value += 1.0;
        for vector in part.chunks_exact_mut(S::f32s::LEN) {
            value.store_slice(vector);
        }
        black_box(&mut *part);
    }
    f64::from(FRAMES) * size_of_val(part) as f64
}
