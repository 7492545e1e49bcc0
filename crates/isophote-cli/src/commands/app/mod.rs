//! `isophote app`: the app in the browser, served from this program.

mod link;
mod server;

use std::io::Write;
use std::net::{Ipv4Addr, TcpListener};

use anyhow::Result;
use isophote::message;
use isophote::scene::Scene;
use isophote::text::Message;

use crate::args::AppArguments;
use crate::failure::{self, Failed, Usage};
use crate::{load, progress};

/// The page, packed by gzip, if the app was built before this program was.
pub static PAGE: Option<&[u8]> = include!(concat!(env!("OUT_DIR"), "/page.rs"));

/// Serves the page until Ctrl-C is pressed, or prints the end of a link.
pub fn run(arguments: &AppArguments) -> Result<String> {
    let language = arguments.language.lang;
    if arguments.link {
        return Ok(format!("{}\n", fragment(&load::scene(&arguments.scene, arguments.quiet, language)?)?));
    }
    let Some(page) = PAGE else {
        let message = message!(
            "this program was built without the app: run `make app` in its source, then build it again; or open the file isophote.html of a release in a browser"
        );
        return Err(Usage(message).into());
    };
    let fragment = match arguments.scene.scene {
        Some(_) => fragment(&load::scene(&arguments.scene, arguments.quiet, language)?)?,
        // Without a scene, the page begins where it was left the last time.
        None => String::new(),
    };
    let port = arguments.port;
    let listener = TcpListener::bind((Ipv4Addr::LOCALHOST, port)).map_err(|error| {
        let error = error.to_string();
        Failed(message!("cannot serve the app on port {port} of 127.0.0.1: {error}", port, error))
    })?;
    let address = format!("http://{}/", listener.local_addr()?);
    tell(&address);
    if !arguments.quiet {
        let note = message!("the app is at this address as long as this program runs; Ctrl-C ends it");
        failure::note(&note.in_language(language));
    }
    if !arguments.no_browser && open::that_detached(format!("{address}{fragment}")).is_err() {
        let note = message!("no browser could be started: open the address in one");
        failure::note(&note.in_language(language));
    }
    progress::end_in_order();
    server::serve(&listener, page, || progress::check().is_err())?;
    Ok(String::new())
}

/// The address goes to standard output at once: another program may be waiting for it.
fn tell(address: &str) {
    let mut stdout = std::io::stdout().lock();
    // The reader may have closed the pipe, and still use the page.
    let _ = writeln!(stdout, "{address}").and_then(|()| stdout.flush());
}

/// The part of the address that holds a scene.
fn fragment(scene: &Scene) -> Result<String, Usage> {
    if let Some(file) = scene.files().first() {
        let message = message!(
            "the app shows scenes whose shapes are in the scene itself; this one reads {file}",
            file = file.name
        );
        return Err(Usage(message));
    }
    let fragment = link::fragment(scene.source()).map_err(|error| Usage(Message::verbatim(error.to_string())))?;
    if fragment.len() > LONGEST_FRAGMENT {
        let message = message!("the scene is too large to be handed to a browser; open its file in the app instead");
        return Err(Usage(message));
    }
    Ok(fragment)
}

/// Starting a browser takes an argument of at most 128 KiB on Linux.
const LONGEST_FRAGMENT: usize = 120_000;
