//! GPX: waypoints, and the lines of tracks and routes, in longitude and latitude.
//!
//! Source: <https://www.topografix.com/GPX/1/1/>.

use roxmltree::{Document, Node};

use super::shapes::Shapes;
use crate::{Crs, Error, ReadOptions, Source, Value, xml};

/// Longitude and latitude of WGS 84, which all files have.
const EPSG: u32 = 4326;

/// Reads waypoints, and the lines of tracks and routes.
pub(crate) fn read(mut source: Box<dyn Source>, options: &ReadOptions) -> Result<Shapes, Error> {
    let mut bytes = Vec::new();
    source.read_to_end(&mut bytes)?;
    let text = str::from_utf8(&bytes).map_err(|_| Error::content("GPX: it is not text"))?;
    let document = xml::parse(text)?;
    if !is(&document.root_element(), "gpx") {
        return Err(Error::content("GPX: its root is not gpx"));
    }
    let mut shapes = Shapes::new(options.attributes);
    shapes.crs = Some(Crs::of_epsg(EPSG));
    for node in document.descendants() {
        if is(&node, "wpt") {
            shapes.feature();
            attributes(&node, &mut shapes);
            position(&document, &node, &mut shapes)?;
        } else if is(&node, "trkseg") || is(&node, "rte") {
            shapes.feature();
            attributes(&if is(&node, "rte") { node } else { node.parent().unwrap_or(node) }, &mut shapes);
            let start = shapes.len();
            for point in node.children().filter(|node| is(node, "trkpt") || is(node, "rtept")) {
                position(&document, &point, &mut shapes)?;
            }
            shapes.line(start);
        }
    }
    Ok(shapes)
}

/// Whether it is an element of this name, in whatever version of the format.
fn is(node: &Node, name: &str) -> bool {
    node.is_element() && node.tag_name().name() == name
}

/// Takes the texts of a waypoint, a track or a route: its name, a description, the time.
fn attributes(node: &Node, shapes: &mut Shapes) {
    const TEXTS: [&str; 8] = ["name", "cmt", "desc", "src", "time", "sym", "type", "number"];
    for child in node.children().filter(Node::is_element) {
        let name = child.tag_name().name();
        if let Some(text) = child.text().filter(|_| TEXTS.contains(&name)) {
            shapes.attribute(name, Value::Text(text));
        }
    }
}

/// Takes a point: longitude, latitude, and its elevation if there is one.
fn position(document: &Document, node: &Node, shapes: &mut Shapes) -> Result<(), Error> {
    let number = |name: &str, text: Option<&str>| {
        let text = text.unwrap_or_default().trim();
        text.parse::<f64>().map_err(|_| Error::Line {
            line: document.text_pos_at(node.range().start).row as usize,
            what: format!("{name} of a point is not a number: {text:?}"),
        })
    };
    let mut numbers = vec![number("lon", node.attribute("lon"))?, number("lat", node.attribute("lat"))?];
    if let Some(elevation) = node.children().find(|node| is(node, "ele")) {
        numbers.push(number("ele", elevation.text())?);
    }
    shapes.position(&numbers);
    Ok(())
}
