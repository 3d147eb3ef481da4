//! A drawing as pixels.

use resvg::tiny_skia::{Pixmap, Transform};
use resvg::usvg::{Options, Tree};

/// Pixels of the picture per unit of the drawing: sharp in print and on dense screens.
const SHARPNESS: f32 = 2.0;

/// Why a drawing has no picture.
#[derive(Debug, thiserror::Error)]
pub(crate) enum PictureError {
    #[error("drawing: {0}")]
    Drawing(#[from] resvg::usvg::Error),
    #[error("drawing: {0} by {1} is too large for a picture")]
    Size(f32, f32),
    #[error("drawing: {0}")]
    Encoding(String),
}

/// The drawing as a PNG file. Without any font on the machine its letters are missing, which is said on standard error.
pub(crate) fn render(svg: &str) -> Result<Vec<u8>, PictureError> {
    let mut options = Options::default();
    let fonts = options.fontdb_mut();
    fonts.load_system_fonts();
    // The drawing names common families; whatever is there stands in for them.
    let families = || fonts.faces().filter_map(|face| Some(face.families.first()?.0.as_str()));
    let preferred = ["Liberation Sans", "DejaVu Sans", "Noto Sans", "Arial", "Helvetica"];
    let usual = preferred.into_iter().find(|name| families().any(|family| family == *name));
    match usual.or_else(|| families().next()).map(str::to_owned) {
        Some(family) => fonts.set_sans_serif_family(family),
        None => eprintln!("warning: no font found on this machine, the PNG has no letters; the SVG has"),
    }
    let tree = Tree::from_str(svg, &options)?;
    let (width, height) = (tree.size().width() * SHARPNESS, tree.size().height() * SHARPNESS);
    let mut picture =
        Pixmap::new(width.ceil() as u32, height.ceil() as u32).ok_or(PictureError::Size(width, height))?;
    resvg::render(&tree, Transform::from_scale(SHARPNESS, SHARPNESS), &mut picture.as_mut());
    picture.encode_png().map_err(|error| PictureError::Encoding(error.to_string()))
}
