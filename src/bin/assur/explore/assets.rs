//! The page's files, as they stand in `web/`.

macro_rules! assets {
    ($($name:literal: $kind:literal),* $(,)?) => {
        &[$(($name, $kind, include_str!(concat!("../../../../web/", $name)))),*]
    };
}

const HTML: &str = "text/html; charset=utf-8";

const ASSETS: &[(&str, &str, &str)] = assets! {
    "index.html": "text/html; charset=utf-8",
    "page.css": "text/css; charset=utf-8",
    "stage.css": "text/css; charset=utf-8",
    "icon.svg": "image/svg+xml",
    "main.js": "text/javascript; charset=utf-8",
    "types.js": "text/javascript; charset=utf-8",
    "connection.js": "text/javascript; charset=utf-8",
    "queue.js": "text/javascript; charset=utf-8",
    "history.js": "text/javascript; charset=utf-8",
    "svg.js": "text/javascript; charset=utf-8",
    "stage.js": "text/javascript; charset=utf-8",
    "marks.js": "text/javascript; charset=utf-8",
    "page.js": "text/javascript; charset=utf-8",
    "manipulator.js": "text/javascript; charset=utf-8",
    "panels.js": "text/javascript; charset=utf-8",
    "circle.js": "text/javascript; charset=utf-8",
    "plane.js": "text/javascript; charset=utf-8",
    "fourbar.js": "text/javascript; charset=utf-8",
    "truss.js": "text/javascript; charset=utf-8",
    "exporting.js": "text/javascript; charset=utf-8",
};

/// The type and text of a file; the page itself for the empty name.
pub(crate) fn find(name: &str) -> Option<(&'static str, &'static str)> {
    let name = if name.is_empty() { "index.html" } else { name };
    ASSETS.iter().find(|asset| asset.0 == name).map(|asset| (asset.1, asset.2))
}

/// The page that says why there is none.
pub(crate) fn refusal(reason: &str) -> (&'static str, String) {
    (HTML, format!("<!doctype html><meta charset=utf-8><title>assur</title><p>{reason}\n"))
}
