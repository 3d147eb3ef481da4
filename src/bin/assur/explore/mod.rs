//! The explorer: a page in the browser, served by this program to this machine only.
//!
//! The page asks over one WebSocket and draws what it is told; each question carries the whole model, so that the server keeps nothing between two of
//! them: tabs do not disturb each other, and a page outlives a server that was stopped. [`server`] decides who may ask, [`socket`] keeps one
//! conversation, [`question`] is what can be said, the others answer by one call of the library each.

mod address;
mod assets;
mod drawing;
mod handles;
mod linkages;
mod manipulator;
mod question;
mod server;
mod socket;
mod workspace;

use std::path::Path;
use std::sync::Arc;

use address::Address;
use assur::exchange::{AngleUnit, ModelFile};
use question::{Opened, families};

use crate::output::{self, Failure};

/// What a page is shown first.
pub(crate) struct Start {
    opened: Opened,
}

/// Serves the explorer until it is stopped. `model` is a file, or the address of an explorer that was stopped, to take it up again.
pub(crate) fn run(model: Option<&str>, inputs: &[f64], port: Option<u16>, open: bool) -> Result<(), Failure> {
    let again = model.and_then(Address::parse);
    let opened = match model.filter(|_| again.is_none()) {
        Some(file) => {
            let path = Path::new(file);
            let text = assur::exchange::read_problem(path)?;
            let opened = Opened::read(&text, file).map_err(|error| Failure::About(file.to_owned(), error))?;
            opened.with_inputs(inputs)
        }
        None => first_family(),
    };
    let address = again.unwrap_or_else(Address::random);
    let address = Address { port: port.unwrap_or(address.port), ..address };
    let runtime = tokio::runtime::Builder::new_current_thread().enable_all().build();
    let failed = |error: std::io::Error| Failure::About("explorer".to_owned(), error.to_string());
    runtime.map_err(failed)?.block_on(async {
        let listener = tokio::net::TcpListener::bind(("127.0.0.1", address.port)).await.map_err(failed)?;
        let port = listener.local_addr().map_err(failed)?.port();
        let address = Address { port, ..address };
        output::print(&format!("{address}\n"))?;
        if open {
            open_browser(&address.to_string());
        }
        server::serve(listener, address, Arc::new(Start { opened })).await.map_err(failed)
    })
}

/// The 3-RPR of the README, with all six modes.
fn first_family() -> Opened {
    const TEXT: &str = include_str!("../../../../examples/3-rpr.toml");
    const INPUTS: [f64; 3] = [14.98, 15.38, 12.0];
    match ModelFile::parse(TEXT, "3-rpr.toml") {
        Ok(model) => Opened::manipulator(model, Some(INPUTS.to_vec())),
        // The file ships with the program; should it not, any family will do.
        Err(_) => Opened::family(families()[0], AngleUnit::Deg).expect("a family of the catalogue"),
    }
}

/// Hands the address to the desktop; it is printed too, so that nothing is lost where there is none.
fn open_browser(address: &str) {
    let (program, first): (&str, &[&str]) = if cfg!(target_os = "macos") {
        ("open", &[])
    } else if cfg!(windows) {
        ("cmd", &["/c", "start", ""])
    } else {
        ("xdg-open", &[])
    };
    let mut command = std::process::Command::new(program);
    command.args(first).arg(address);
    let null = std::process::Stdio::null;
    let _ = command.stdin(null()).stdout(null()).stderr(null()).spawn();
}
