//! How an explorer begins: what it opens, at which address, and that the browser is told.

use std::path::Path;
use std::sync::Arc;

use assur::exchange::{AngleUnit, ModelFile};

use super::address::Address;
use super::question::{Opened, families};
use super::server;
use crate::output::{self, Failure};

/// What a page is shown first.
pub(crate) struct Start {
    pub(crate) opened: Opened,
}

/// Serves the explorer until it is stopped. `model` is a file, or the address of an explorer that was stopped, to take it up again; `inputs` are written as for the model's other
/// commands, angles in its unit.
pub(crate) fn run(model: Option<&str>, inputs: &[f64], port: Option<u16>, open: bool) -> Result<(), Failure> {
    let again = model.and_then(Address::parse);
    let about = |error: String| Failure::About(model.unwrap_or("--inputs").to_owned(), error);
    if again.is_some() && !inputs.is_empty() {
        return Err(about("the pages open there have inputs of their own; --inputs goes with a model".to_owned()));
    }
    let opened = match model.filter(|_| again.is_none()) {
        Some(file) => {
            let text = assur::exchange::read_problem(Path::new(file))?;
            Opened::read(&text, file).map_err(|error| Failure::About(file.to_owned(), error))?
        }
        None => first_family(),
    };
    let opened = opened.begun_at(inputs).map_err(about)?;
    let (address, view) = again.unwrap_or_else(|| (Address::random(), String::new()));
    let address = Address { port: port.unwrap_or(address.port), ..address };
    let runtime = tokio::runtime::Builder::new_current_thread().enable_all().build();
    let failed = |error: std::io::Error| Failure::About("explorer".to_owned(), error.to_string());
    runtime.map_err(failed)?.block_on(async {
        let listener = tokio::net::TcpListener::bind(("127.0.0.1", address.port)).await.map_err(failed)?;
        let port = listener.local_addr().map_err(failed)?.port();
        let address = Address { port, ..address };
        let link = format!("{address}{view}");
        output::print(&format!("{link}\n"))?;
        if open {
            open_browser(&link);
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
