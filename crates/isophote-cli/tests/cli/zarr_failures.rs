//! Killed, interrupted, out of space: what was done stays, and the bytes become those of one uninterrupted run.
#![cfg(unix)]

use std::hash::{BuildHasher, RandomState};
use std::process::{Child, Command, Stdio};
use std::thread::sleep;
use std::time::{Duration, Instant};

use crate::common::{Folder, LAB, PROGRAM, names_in};
use crate::zarr::tree;

/// Three channels in many shards: most of the time goes into files, where a kill hurts.
const RENDER: &str = "render lab.toml --size 400x300 --shard-side 20 -c brightness -c shape -c normal --quiet";

fn start(folder: &Folder, arguments: &str) -> Child {
    let mut command = Command::new(PROGRAM);
    command.current_dir(folder.path("")).args(arguments.split(' '));
    command.stdin(Stdio::null()).stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap()
}

#[test]
fn killed_at_ten_random_moments_it_resumes_to_the_same_bytes() {
    let folder = Folder::with("lab.toml", LAB);
    folder.ok(&format!("{RENDER} -o whole.zarr"));
    let whole = tree(&folder.path("whole.zarr"));
    let shards = records(&folder, "whole.zarr");
    let random = RandomState::new();
    let mut halfway = 0;
    for number in 0..10_u64 {
        let name = format!("killed{number}.zarr");
        // By progress and not by the clock: how long the work takes on a busy machine is not known beforehand.
        let done = usize::try_from(random.hash_one(number) % 200).unwrap();
        let mut child = start(&folder, &format!("{RENDER} --threads 1 -o {name}"));
        while records(&folder, &name) < done && child.try_wait().unwrap().is_none() {
            sleep(Duration::from_micros(200));
        }
        // SIGKILL: no handler runs, nothing is cleaned up.
        child.kill().unwrap();
        child.wait().unwrap();
        let left = records(&folder, &name);
        halfway += u32::from((1..shards).contains(&left));
        folder.ok(&format!("{RENDER} -o {name} --resume"));
        assert!(tree(&folder.path(&name)) == whole, "killed after {left} of {shards} shards");
        assert!(names_in(&folder.path(&name).join(".isophote/unfinished")).is_empty());
    }
    assert!(halfway > 0, "all ten were killed before or after the work");
}

/// How many shards of a store are recorded as done.
fn records(folder: &Folder, store: &str) -> usize {
    let rows = std::fs::read_dir(folder.path(store).join(".isophote/shards")).into_iter().flatten();
    rows.map(|row| std::fs::read_dir(row.unwrap().path()).unwrap().count()).sum()
}

#[test]
fn ctrl_c_stops_soon_and_says_how_to_go_on() {
    let folder = Folder::with("lab.toml", LAB);
    let mut child = start(&folder, "render lab.toml --size 32000x24000 -o map.zarr");
    sleep(Duration::from_millis(1500));
    let since = Instant::now();
    assert!(Command::new("kill").arg("-INT").arg(child.id().to_string()).status().unwrap().success());
    while child.try_wait().unwrap().is_none() {
        assert!(since.elapsed() < Duration::from_secs(20), "still running");
        sleep(Duration::from_millis(2));
    }
    let took = since.elapsed();
    let output = child.wait_with_output().unwrap();
    let said = String::from_utf8(output.stderr).unwrap();
    assert_eq!(output.status.code(), Some(130), "{said}");
    assert!(took < Duration::from_secs(2), "{took:?}");
    assert!(said.starts_with("interrupted; ") && said.ends_with(": --resume goes on from there\n"), "{said}");
    assert!(said.contains("done and stay") || said.contains("that are done stay"), "{said}");
}

/// Every system has a limit on the size of files, and a file beyond it cannot be written.
#[test]
fn a_file_that_cannot_be_written_is_a_clear_error_and_what_is_done_stays() {
    let folder = Folder::with("lab.toml", LAB);
    let render = "render lab.toml --size 400x300 --shard-side 100 --threads 1";
    folder.ok(&format!("{render} -o whole.zarr"));
    // In blocks of 512 bytes: more than a description has, less than a shard. Without the trap the signal would kill.
    let script = format!("trap '' XFSZ; ulimit -f 40; exec '{PROGRAM}' {render} -o map.zarr");
    let output = Command::new("sh").args(["-c", &script]).current_dir(folder.path("")).output().unwrap();
    let said = String::from_utf8(output.stderr).unwrap();
    assert_eq!(output.status.code(), Some(1), "{said}");
    assert!(said.starts_with("error: cannot write ‘map.zarr/.isophote/shards/0/1.json’: File too large (os"), "{said}");
    assert!(said.ends_with("); 1 of 12 shards are done and stay usable: --resume goes on\n"), "{said}");
    assert!(names_in(&folder.path("map.zarr/.isophote/unfinished")).is_empty());
    folder.ok(&format!("{render} -o map.zarr --resume"));
    assert_eq!(tree(&folder.path("map.zarr")), tree(&folder.path("whole.zarr")));
}

/// A file system of 300 KiB, mounted for this one script alone, where the system lets us: the disk is really full.
#[cfg(target_os = "linux")]
#[test]
fn a_full_disk_is_a_clear_error_and_what_is_done_stays() {
    let folder = Folder::with("lab.toml", LAB);
    std::fs::create_dir(folder.path("small")).unwrap();
    let may_mount = "mount -t tmpfs -o size=300k tmpfs small";
    let unshare = |script: &str| {
        let mut command = Command::new("unshare");
        command.args(["--user", "--map-root-user", "--mount", "sh", "-c", script]).current_dir(folder.path(""));
        command.output()
    };
    if !unshare(may_mount).is_ok_and(|output| output.status.success()) {
        eprintln!("skipped: no file system can be mounted here; the limit on the size of files is tested instead");
        return;
    }
    let render = "render lab.toml --size 400x300 --shard-side 50";
    folder.ok(&format!("{render} -o whole.zarr"));
    let script = format!(
        "{may_mount} && ! '{PROGRAM}' {render} -o small/map.zarr && ls -A small/map.zarr/.isophote/unfinished && \
         mount -o remount,size=9m small && '{PROGRAM}' {render} -o small/map.zarr --resume && cp -r small/map.zarr ."
    );
    let output = unshare(&script).unwrap();
    let said = String::from_utf8(output.stderr).unwrap();
    assert!(output.status.success(), "{said}");
    assert!(said.starts_with("error: cannot write ‘small/map.zarr/"), "{said}");
    assert!(said.contains("No space left on device"), "{said}");
    assert!(said.contains(" of 48 shards are done and stay usable: --resume goes on\n"), "{said}");
    let listed = String::from_utf8(output.stdout).unwrap();
    assert!(listed.starts_with("Lab 4"), "nothing half-written stays: {listed}");
    assert_eq!(tree(&folder.path("map.zarr")), tree(&folder.path("whole.zarr")));
}
