//! What a user waits for: the whole process, from start to the picture on disk.

use std::process::{Command, Stdio};

use criterion::{Criterion, criterion_group, criterion_main};

fn isophote(folder: &std::path::Path, arguments: &[&str]) {
    let status = Command::new(env!("CARGO_BIN_EXE_isophote"))
        .args(arguments)
        .current_dir(folder)
        .stdout(Stdio::null())
        .stderr(Stdio::null())
        .status()
        .expect("the program was built");
    assert!(status.success(), "{arguments:?}");
}

fn whole_job(criterion: &mut Criterion) {
    let folder = tempfile::tempdir().expect("a folder for what is written");
    let mut group = criterion.benchmark_group("whole process, lab scene");
    group.sample_size(40);
    for (name, arguments) in [
        ("no work: --version", ["--version"].as_slice()),
        ("800×600 to png", &[]),
        ("800×600 to exr, all channels", &["render", "-o", "lab.exr"]),
        (
            "3840×2160 to exr, brightness",
            &["render", "-o", "lab.exr", "--size", "3840x2160", "--channel", "brightness"],
        ),
        ("3840×2160 to png", &["render", "-o", "lab.png", "--size", "3840x2160"]),
        ("a probe, explained", &["probe", "--at", "0,0,4", "--explain"]),
    ] {
        group.bench_function(name, |bencher| bencher.iter(|| isophote(folder.path(), arguments)));
    }
    group.finish();
}

criterion_group!(job, whole_job);
criterion_main!(job);
