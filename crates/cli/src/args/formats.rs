//! The names of formats in help texts: from the table of formats.

use delone_io::{Contents, Direction, Format};

/// Outlines of the plane, or triangles of a shape.
pub(crate) const IN_THE_PLANE: &[Contents] = &[Contents::Lines, Contents::Patches];
/// Surfaces of space, or their triangles.
pub(crate) const IN_SPACE: &[Contents] = &[Contents::Surfaces, Contents::Indices];

/// Cells of the plane or of space.
pub(super) fn cells() -> String {
    let (flat, solid) = (written(&[Contents::Cells]), written(&[Contents::Polyhedra]));
    format!("Output file (in the plane {flat}; in space {solid}), or - for standard output; may be repeated")
}

/// The formats that one of these is written to.
pub fn written(any: &[Contents]) -> String {
    Format::with(any, Direction::Written)
}

/// The formats that these are read from.
pub fn read(contents: Contents) -> String {
    Format::with(&[contents], Direction::Read)
}

/// An output that may be given more than once.
pub(super) fn outputs(any: &[Contents]) -> String {
    format!("Output file ({}), or - for standard output; may be repeated", written(any))
}

/// A file of segments.
pub fn segments() -> String {
    format!(
        "File of segments between the points: two indices a line from 0, or a file that has them ({})",
        read(Contents::Segments)
    )
}
