//! Attributes of the input go to the outputs that have room for them, or a line says which do not.

use std::sync::{Mutex, PoisonError};

use delone_io::{Cloud, Contents, Format};

use super::systems::outputs;
use crate::message::lost;

/// The attributes of this run.
struct Known {
    /// With which contents they are written, if the command does so.
    with: Option<Contents>,
    /// The names of all that were read.
    names: Vec<String>,
    /// The one that is the name of regions and boundaries.
    naming: Option<String>,
    /// Some were asked for by name.
    are_asked: bool,
    have_infinities: bool,
    unshown: Unshown,
}

/// Whether things of an input have attributes that triangles do not show.
#[derive(Clone, Copy)]
pub(crate) struct Unshown {
    /// Lines; true if some are on no edge of a triangle, or on those of other lines alone.
    pub(crate) lines: Option<bool>,
    /// Polygons that have no triangle to themselves.
    pub(crate) hidden_polygons: bool,
    /// Points that are on no line.
    pub(crate) points: bool,
}

static KNOWN: Mutex<Known> = Mutex::new(Known {
    with: None,
    names: Vec::new(),
    naming: None,
    are_asked: false,
    have_infinities: false,
    unshown: Unshown { lines: None, hidden_polygons: false, points: false },
});

/// Names that a message lists; more are `...`.
const MOST_NAMES: usize = 12;

/// The command writes attributes with such contents, where a format has room for them: they are read from now on.
pub(crate) fn keep_attributes(with: Contents) {
    KNOWN.lock().unwrap_or_else(PoisonError::into_inner).with = Some(with);
}

/// Whether attributes are read: the command writes them, and not only where there is no room for them. Polygons that are regions are told
/// apart by them.
pub(crate) fn are_kept() -> bool {
    let with = KNOWN.lock().unwrap_or_else(PoisonError::into_inner).with;
    let have_room = |with| outputs().iter().any(|(_, format)| format.keeps_attributes(with));
    with.is_some_and(|with| with == Contents::Triangles || have_room(with))
}

/// The outputs of the command are triangles; they are said to be without attributes of lines and points, if these have any.
pub(crate) fn heed_unshown(unshown: Unshown) {
    KNOWN.lock().unwrap_or_else(PoisonError::into_inner).unshown = unshown;
}

/// An attribute is the name of regions and boundaries: formats that have such names have it.
pub(crate) fn heed_naming(name: &str) {
    KNOWN.lock().unwrap_or_else(PoisonError::into_inner).naming = Some(name.to_owned());
}

/// Some attributes are asked for by name: outputs of every kind that have none of them are told.
pub(super) fn ask() {
    KNOWN.lock().unwrap_or_else(PoisonError::into_inner).are_asked = true;
}

/// Keeps the names of the attributes of an input.
pub(super) fn heed(cloud: &Cloud) {
    let mut known = KNOWN.lock().unwrap_or_else(PoisonError::into_inner);
    known.have_infinities |= cloud.features.table.has_infinities();
    let names = &mut known.names;
    for name in cloud.features.table.names() {
        if names.len() <= MOST_NAMES && !names.contains(name) {
            names.push(name.clone());
        }
    }
}

/// Says which outputs are without the attributes of the input. Indices and pictures need none that were not asked for.
pub(super) fn tell(quiet: bool) {
    let known = KNOWN.lock().unwrap_or_else(PoisonError::into_inner);
    let mut names: Vec<&str> = known.names.iter().map(String::as_str).collect();
    if names.is_empty() {
        return;
    }
    if names.len() > MOST_NAMES {
        *names.last_mut().expect("there are more") = "...";
    }
    let whose = |format: Format| {
        if !known.are_asked && !has_places(format) {
            return String::new();
        }
        if known.with.is_none_or(|with| !format.keeps_attributes(with)) {
            return "the input".to_owned();
        }
        let Unshown { lines, hidden_polygons, points } = known.unshown;
        let has_lines = format.keeps_attributes(Contents::Lines);
        let all = [
            (hidden_polygons, "polygons without a triangle"),
            (lines.is_some() && !has_lines, "lines"),
            (lines == Some(true) && has_lines, "lines without an edge"),
            (points, "points"),
        ];
        let unshown: Vec<&str> = all.into_iter().filter_map(|(is_so, what)| is_so.then_some(what)).collect();
        unshown.join(", of ")
    };
    for (path, format) in outputs() {
        let whose = whose(format);
        let is_kept = |name: &str| format.keeps_names() && known.naming.as_deref() == Some(name);
        let names: Vec<&str> = names.iter().copied().filter(|name| !is_kept(name)).collect();
        if !whose.is_empty() && !names.is_empty() {
            let what = format!("the attributes of {whose} are left out: {}", names.join(", "));
            lost(quiet, format_args!("{}: {what}", path.display()));
        } else if known.have_infinities && matches!(format, Format::GeoJson | Format::Json) {
            lost(quiet, format_args!("{}: infinite values are null in it", path.display()));
        }
    }
}

/// Whether files of a format have the places of things, not their indices in the input alone.
fn has_places(format: Format) -> bool {
    !matches!(
        format,
        Format::Text
            | Format::Npy
            | Format::Npz
            | Format::Ele
            | Format::Neigh
            | Format::Edge
            | Format::Tiff
            | Format::Asc
            | Format::Svg
            | Format::Png
    )
}
