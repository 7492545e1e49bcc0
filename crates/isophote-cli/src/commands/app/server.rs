//! A server of one page: it answers GET for it, and nothing else.

use std::io::{self, BufRead, BufReader, Read, Write};
use std::net::{TcpListener, TcpStream};
use std::thread;
use std::time::Duration;

/// How often the server looks whether it is to end, and for new visitors.
const PAUSE: Duration = Duration::from_millis(50);
/// How long a visitor may take to say what it wants, or to take its answer.
const PATIENCE: Duration = Duration::from_secs(10);
/// The longest request that is read, in bytes.
const LONGEST_REQUEST: u64 = 16 << 10;

/// Serves a page, packed by gzip, until it is to end.
pub fn serve(listener: &TcpListener, page: &'static [u8], is_to_end: impl Fn() -> bool) -> io::Result<()> {
    listener.set_nonblocking(true)?;
    while !is_to_end() {
        match listener.accept() {
            Ok((stream, _)) => {
                // One visitor cannot keep the others waiting. What goes wrong with it concerns nobody else.
                thread::spawn(move || drop(answer(stream, page)));
            }
            Err(_) => thread::sleep(PAUSE),
        }
    }
    Ok(())
}

fn answer(stream: TcpStream, page: &[u8]) -> io::Result<()> {
    stream.set_nonblocking(false)?;
    stream.set_read_timeout(Some(PATIENCE))?;
    stream.set_write_timeout(Some(PATIENCE))?;
    let mut reader = BufReader::new(stream.try_clone()?.take(LONGEST_REQUEST));
    let mut request = String::new();
    reader.read_line(&mut request)?;
    // The rest is read so that the connection can be closed in order; nothing in it matters.
    let mut line = String::new();
    while reader.read_line(&mut line)? > 2 {
        line.clear();
    }
    let (status, body) = response(&request, page);
    let kind =
        if body.is_empty() { "" } else { "Content-Type: text/html; charset=utf-8\r\nContent-Encoding: gzip\r\n" };
    let allow = if status.starts_with("405") { "Allow: GET\r\n" } else { "" };
    let head = format!(
        "HTTP/1.1 {status}\r\n{kind}{allow}Content-Length: {}\r\nCache-Control: no-cache\r\n\
         X-Content-Type-Options: nosniff\r\nReferrer-Policy: no-referrer\r\nConnection: close\r\n\r\n",
        body.len()
    );
    let mut stream = stream;
    stream.write_all(head.as_bytes())?;
    stream.write_all(body)?;
    stream.flush()
}

/// The status and the body for the first line of a request.
fn response<'p>(request: &str, page: &'p [u8]) -> (&'static str, &'p [u8]) {
    let mut words = request.split_ascii_whitespace();
    let (method, path, protocol) = (words.next(), words.next(), words.next());
    match (method, path.map(|path| path.split('?').next().unwrap_or(path)), protocol) {
        (Some("GET"), Some("/" | "/index.html"), Some(protocol)) if protocol.starts_with("HTTP/1.") => ("200 OK", page),
        (Some("GET"), Some(_), Some(protocol)) if protocol.starts_with("HTTP/1.") => ("404 Not Found", &[]),
        (Some(_), Some(_), Some(protocol)) if protocol.starts_with("HTTP/1.") => ("405 Method Not Allowed", &[]),
        _ => ("400 Bad Request", &[]),
    }
}

#[cfg(test)]
mod tests {
    use std::net::Ipv4Addr;
    use std::sync::atomic::{AtomicBool, Ordering};

    use super::*;

    #[test]
    fn nothing_but_get_for_the_page_is_answered() {
        let page: &[u8] = b"page";
        for request in ["GET / HTTP/1.1\r\n", "GET /index.html HTTP/1.0\r\n", "GET /?x=1 HTTP/1.1\r\n"] {
            assert_eq!(response(request, page), ("200 OK", page), "{request}");
        }
        for request in ["GET /../etc/passwd HTTP/1.1\r\n", "GET //x HTTP/1.1\r\n", "GET /favicon.ico HTTP/1.1\r\n"] {
            assert_eq!(response(request, page), ("404 Not Found", &b""[..]), "{request}");
        }
        for request in ["POST / HTTP/1.1\r\n", "get / HTTP/1.1\r\n", "OPTIONS * HTTP/1.1\r\n"] {
            assert_eq!(response(request, page), ("405 Method Not Allowed", &b""[..]), "{request}");
        }
        for request in ["", "GET", "GET /", "\u{1}\r\n", "GET / SPDY/3\r\n"] {
            assert_eq!(response(request, page).0, "400 Bad Request", "{request}");
        }
    }

    #[test]
    fn a_silent_visitor_keeps_nobody_waiting_and_the_server_ends_when_told() {
        static PAGE: &[u8] = b"packed";
        let listener = TcpListener::bind((Ipv4Addr::LOCALHOST, 0)).unwrap();
        let address = listener.local_addr().unwrap();
        let is_over = AtomicBool::new(false);
        thread::scope(|scope| {
            let server = scope.spawn(|| serve(&listener, PAGE, || is_over.load(Ordering::Relaxed)));
            let silent = TcpStream::connect(address).unwrap();
            let mut visitor = TcpStream::connect(address).unwrap();
            visitor.write_all(b"GET / HTTP/1.1\r\nHost: here\r\n\r\n").unwrap();
            let mut answer = String::new();
            visitor.read_to_string(&mut answer).unwrap();
            assert!(answer.starts_with("HTTP/1.1 200 OK\r\n") && answer.ends_with("\r\n\r\npacked"), "{answer}");
            drop(silent);
            is_over.store(true, Ordering::Relaxed);
            server.join().unwrap().unwrap();
        });
    }
}
