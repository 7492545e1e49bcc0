//! A user who changes his mind: Ctrl-C, and readers that stop listening.
#![cfg(unix)]

use std::io::Read;
use std::process::{Child, Command, ExitStatus, Stdio};
use std::time::{Duration, Instant};

use crate::common::{Folder, LAB, PROGRAM};

fn start(folder: &Folder, arguments: &str) -> Child {
    let mut command = Command::new(PROGRAM);
    command.current_dir(folder.path("")).args(arguments.split(' '));
    command.stdin(Stdio::piped()).stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap()
}

fn interrupt(child: &Child) {
    assert!(Command::new("kill").arg("-INT").arg(child.id().to_string()).status().unwrap().success());
}

/// Waits, but not for ever; gives how it ended and what it said.
fn end_of(mut child: Child) -> (ExitStatus, String) {
    let since = Instant::now();
    let status = loop {
        if let Some(status) = child.try_wait().unwrap() {
            break status;
        }
        if since.elapsed() > Duration::from_secs(20) {
            child.kill().unwrap();
            panic!("still running 20 s after the interrupt");
        }
        std::thread::sleep(Duration::from_millis(10));
    };
    let mut said = String::new();
    child.stderr.take().unwrap().read_to_string(&mut said).unwrap();
    (status, said)
}

#[test]
fn ctrl_c_during_a_render_ends_it_with_130_and_leaves_nothing() {
    let folder = Folder::new();
    folder.write("old.png", "old");
    let child =
        start(&folder, "render --size 8000x6000 --samples 64 --threads 1 -o old.png -o new.csv --figure new.svg");
    std::thread::sleep(Duration::from_millis(500));
    interrupt(&child);
    let since = Instant::now();
    let (status, said) = end_of(child);
    assert_eq!(status.code(), Some(130), "{said}");
    assert!(since.elapsed() < Duration::from_secs(5), "{:?}", since.elapsed());
    assert_eq!(said, "interrupted; nothing was left half-written\n");
    assert_eq!(folder.text("old.png"), "old");
    assert_eq!(folder.names(), ["old.png"]);
}

#[test]
fn ctrl_c_while_a_file_is_written_removes_the_half_of_it() {
    let folder = Folder::new();
    folder.write("map.csv", "old");
    let child = start(&folder, "render --size 2400x1800 -o map.csv");
    // The hidden file appears when the writing begins.
    let since = Instant::now();
    while folder.names().len() < 2 {
        assert!(since.elapsed() < Duration::from_secs(30), "nothing is written");
        std::thread::sleep(Duration::from_millis(2));
    }
    interrupt(&child);
    let (status, said) = end_of(child);
    assert_eq!(status.code(), Some(130), "{said}");
    assert_eq!(folder.names(), ["map.csv"]);
    assert_eq!(folder.text("map.csv"), "old");
}

/// Thousands of lights and probes: the listing of the probes takes much longer than the map, and asks nobody.
fn busy(folder: &Folder) {
    let light = "[[light]]\nposition = [5, 5, -10]\nintensity = 1\n";
    let probe = "[[probe]]\nat = [0, 0, 4]\n";
    folder.write("busy.toml", LAB.to_owned() + &light.repeat(2000) + &probe.repeat(20_000));
}

#[test]
fn ctrl_c_ends_a_phase_that_asks_nobody() {
    let folder = Folder::new();
    busy(&folder);
    let child = start(&folder, "render busy.toml --size 8x6 -o map.csv --quiet");
    std::thread::sleep(Duration::from_secs(3));
    interrupt(&child);
    let (status, said) = end_of(child);
    assert_eq!(status.code(), Some(130), "{said}");
    // On a busy computer it may still have been reading.
    let ended = ["interrupted; nothing was left half-written\n", "interrupted; nothing was written\n"];
    assert!(ended.contains(&said.as_str()), "{said}");
    assert!(folder.names().iter().all(|name| !name.contains(".part")), "{:?}", folder.names());
}

#[test]
fn the_second_ctrl_c_ends_at_once() {
    let folder = Folder::new();
    busy(&folder);
    let mut child = start(&folder, "render busy.toml --size 8x6 -o map.csv --quiet");
    std::thread::sleep(Duration::from_secs(3));
    interrupt(&child);
    std::thread::sleep(Duration::from_millis(50));
    if child.try_wait().unwrap().is_none() {
        interrupt(&child);
    }
    let (status, said) = end_of(child);
    assert_eq!(status.code(), Some(130), "{said}");
    assert!(said.starts_with("interrupted; nothing was "), "{said}");
}

#[test]
fn ctrl_c_ends_a_program_that_waits_for_its_input() {
    let folder = Folder::new();
    let mut child = start(&folder, "render - -o map.png");
    let input = child.stdin.take();
    std::thread::sleep(Duration::from_millis(300));
    interrupt(&child);
    let (status, said) = end_of(child);
    assert_eq!((status.code(), said.as_str()), (Some(130), "interrupted; nothing was written\n"));
    assert!(folder.names().is_empty());
    drop(input);
}

#[test]
fn a_reader_who_stops_listening_to_the_results_is_no_failure() {
    let folder = Folder::new();
    for arguments in ["section --horizontal 0", "probe --explain", "schema", "man render", "check", "new lab -o -"] {
        let mut child = start(&folder, arguments);
        drop(child.stdout.take());
        let (status, said) = end_of(child);
        assert_eq!((status.code(), said.as_str()), (Some(0), ""), "{arguments}");
    }
}

#[test]
fn a_reader_who_stops_listening_to_the_notes_loses_only_the_notes() {
    let folder = Folder::with("bad.toml", "version = 2");
    let mut child = start(&folder, "render --size 40x30 -o map.csv");
    drop(child.stderr.take());
    let output = child.wait_with_output().unwrap();
    assert_eq!(output.status.code(), Some(0));
    assert!(String::from_utf8(output.stdout).unwrap().contains("0.316677297547093"));
    for (arguments, code) in [("check bad.toml", 3), ("render --channel foo", 2), ("show bad.toml", 1)] {
        let mut child = start(&folder, arguments);
        drop(child.stderr.take());
        assert_eq!(child.wait().unwrap().code(), Some(code), "{arguments}");
    }
}
