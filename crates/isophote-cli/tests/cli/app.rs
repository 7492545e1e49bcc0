//! `isophote app`: the page on this machine.

use std::io::{BufRead, BufReader, Read, Write};
use std::net::TcpStream;
use std::process::{Command, Stdio};

use crate::common::{Folder, LAB, PROGRAM};

#[test]
fn a_link_holds_the_scene() {
    let link = Folder::with("lab.toml", LAB).ok("app lab.toml --link").stdout;
    let [begin, data, sum] = *link.trim_end().split('.').collect::<Vec<_>>() else { panic!("{link}") };
    assert_eq!((begin, sum.len()), ("#s1", 8));
    assert!(data.bytes().all(|byte| byte.is_ascii_alphanumeric() || byte == b'-' || byte == b'_'), "{data}");
}

#[test]
fn a_scene_that_reads_files_has_no_link() {
    let folder = Folder::with("a.obj", "v 0 0 5\nv 1 0 5\nv 0 1 5\nf 1 2 3\n");
    folder.write("mesh.toml", format!("{LAB}\n[[mesh]]\nfile = \"a.obj\"\nmaterial = \"clay\"\n"));
    folder.run("app mesh.toml --link").failed(2, &["this one reads a.obj"]);
    folder.run("app mesh.toml --link --lang ru").failed(2, &["ошибка: приложение показывает", "эта читает файл a.obj"]);
}

/// Where the app was built before the program, it is served; otherwise the program says what is missing.
#[test]
fn the_page_is_served_or_said_to_be_missing() {
    let mut server = Command::new(PROGRAM)
        .args(["app", "--no-browser", "--quiet"])
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    let mut line = String::new();
    BufReader::new(server.stdout.as_mut().unwrap()).read_line(&mut line).unwrap();
    let Some(address) = line.trim().strip_prefix("http://").and_then(|rest| rest.strip_suffix('/')) else {
        let output = server.wait_with_output().unwrap();
        assert_eq!(output.status.code(), Some(2));
        let message = String::from_utf8(output.stderr).unwrap();
        assert!(message.contains("run `make app`"), "{message}");
        return;
    };
    let answer = |request: &str| {
        let mut stream = TcpStream::connect(address).unwrap();
        write!(stream, "{request} HTTP/1.1\r\nHost: {address}\r\n\r\n").unwrap();
        let mut bytes = Vec::new();
        stream.read_to_end(&mut bytes).unwrap();
        bytes
    };
    let page = answer("GET /");
    assert!(page.starts_with(b"HTTP/1.1 200 OK\r\n"));
    // Packed by gzip.
    let body = page.windows(4).position(|window| window == b"\r\n\r\n").unwrap() + 4;
    assert_eq!(page[body..body + 2], [0x1f, 0x8b]);
    assert!(answer("GET /../Cargo.toml").starts_with(b"HTTP/1.1 404 "));
    assert!(answer("POST /").starts_with(b"HTTP/1.1 405 "));
    server.kill().unwrap();
    server.wait().unwrap();
}
