//! Drawings in DXF, as text: points, lines, polylines and the edges of faces, with their layers; blocks are put where they are inserted.
//!
//! Arcs and circles are chords of at most 11.25 degrees, with their centers for meshes that follow them; ellipses and splines are arcs. Closed polylines and circles are lines that end where they begin: contours are such lines, and
//! would leave out what is inside of them as borders. Where polygons are asked for, they are polygons. What else a drawing has is counted.
//!
//! Source: Autodesk's "DXF Reference", 2012. Read by hand: a drawing is pairs of lines, a code and a value.

mod blocks;
mod curves;
mod entity;
mod splines;

use std::collections::BTreeMap;

use self::blocks::{Block, Blocks};
use self::curves::Path;
use self::entity::{Entity, Item, What};
use super::lines::Lines;
use super::shapes::{Purpose, Shapes};
use crate::error::{excerpt, listed};
use crate::{Error, ReadOptions, Source, Value};

/// The pairs of a drawing.
struct Pairs {
    lines: Lines,
}

/// A code, its value, and the line that this is in.
struct Pair {
    code: i32,
    value: String,
    line: usize,
}

impl Pairs {
    fn next(&mut self) -> Result<Option<Pair>, Error> {
        let Some(line) = self.lines.next_any()? else { return Ok(None) };
        let code = line.text.trim().parse().map_err(|_| {
            line.error(format!("{:?} stands where the code of a group is expected", excerpt(line.text)))
        })?;
        let value = self.lines.next_any()?;
        let value = value.ok_or_else(|| Error::Truncated("between a code and its value".to_owned()))?;
        Ok(Some(Pair { code, value: value.text.trim().to_owned(), line: value.number }))
    }
}

/// A drawing as it is gathered.
struct Drawing {
    shapes: Shapes,
    closed_are_polygons: bool,
    blocks: Blocks,
    /// The block that is being read.
    block: Option<Block>,
    /// A polyline whose vertices follow.
    polyline: Option<Entity>,
    /// How many entities of each kind were left out, and why.
    left_out: BTreeMap<String, usize>,
    /// Arcs, ellipses and splines, and how many of them are not parts of circles: of blocks that are stretched, and with numbers that are no circle.
    arcs: usize,
    curves: usize,
    stretched: usize,
    lost: usize,
}

/// How a part of a drawing is read.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Section {
    /// Between two of them.
    Outside,
    /// Blocks and entities.
    Entities,
    Other,
}

/// Reads all entities, in their order.
pub(crate) fn read(
    mut source: Box<dyn Source>,
    options: &ReadOptions,
    purpose: Purpose,
) -> Result<Shapes, Error> {
    const BINARY: &[u8] = b"AutoCAD Binary DXF";
    if source.fill_buf()?.starts_with(BINARY) {
        return Err(Error::content("DXF: it is binary: save it as text, as ASCII DXF"));
    }
    let mut drawing = Drawing {
        shapes: Shapes::new(options.attributes),
        closed_are_polygons: purpose == Purpose::Polygons,
        blocks: Blocks::default(),
        block: None,
        polyline: None,
        left_out: BTreeMap::new(),
        arcs: 0,
        curves: 0,
        stretched: 0,
        lost: 0,
    };
    drawing.shapes.attribute("layer", Value::Null);
    let mut pairs = Pairs { lines: Lines::new(source) };
    let mut section = Section::Outside;
    let mut entity: Option<Entity> = None;
    let mut is_ended = false;
    let mut bytes = 0_u64;
    let mut any = false;
    while let Some(Pair { code, value, line }) = pairs.next()? {
        bytes += value.len() as u64 + 3;
        drawing.blocks.allow(bytes);
        if section == Section::Outside {
            match (code, value.as_str()) {
                (0, "EOF") => {
                    is_ended = true;
                    break;
                }
                (2, "ENTITIES" | "BLOCKS") => section = Section::Entities,
                (2, _) => section = Section::Other,
                (0, "SECTION") | (999, _) => any = true,
                _ if any => {}
                _ => return Err(Error::content("DXF: it does not begin with a section")),
            }
        } else if code == 0 {
            if let Some(done) = entity.take() {
                drawing.take(done)?;
            }
            match value.as_str() {
                "ENDSEC" => section = Section::Outside,
                _ if section == Section::Entities => entity = Some(Entity::new(value)),
                _ => {}
            }
        } else if let Some(entity) = &mut entity {
            entity.group(code, value, line)?;
        }
    }
    if !is_ended {
        return Err(Error::Truncated("before the group that ends it, EOF".to_owned()));
    }
    drawing.end_polyline()?;
    let mut shapes = drawing.shapes;
    if drawing.arcs > 0 {
        let what = "arcs and circles, as chords of at most 11.25 degrees that meshes follow";
        shapes.remarks.push(format!("{what}: {}", drawing.arcs));
    }
    if drawing.curves > 0 {
        let what = "ellipses and splines, as arcs within a ten-thousandth of their extent";
        shapes.remarks.push(format!("{what}: {}", drawing.curves));
    }
    if drawing.stretched > 0 {
        shapes.losses.push(format!("arcs that blocks stretch are chords alone: {}", drawing.stretched));
    }
    if drawing.lost > 0 {
        let why = "whose numbers are too large, too small or none";
        shapes.losses.push(format!("arcs {why} are straight: {}", drawing.lost));
    }
    if !drawing.left_out.is_empty() {
        let kinds: Vec<String> =
            drawing.left_out.iter().map(|(kind, count)| format!("{count} {kind}")).collect();
        shapes.losses.push(format!("entities were left out: {}", listed(kinds.iter().map(String::as_str))));
    }
    Ok(shapes)
}

impl Drawing {
    /// Takes an entity that is complete.
    fn take(&mut self, mut entity: Entity) -> Result<(), Error> {
        if let Some(polyline) = &mut self.polyline {
            if entity.kind == "VERTEX" {
                polyline.vertex(&entity);
                return Ok(());
            }
            self.end_polyline()?;
            if entity.kind == "SEQEND" {
                return Ok(());
            }
        }
        match entity.kind.as_str() {
            "BLOCK" => self.block = Some(Block::new(&mut entity)),
            "ENDBLK" => self.block.take().into_iter().for_each(|block| self.blocks.add(block)),
            "POLYLINE" => self.polyline = Some(entity),
            "SEQEND" => {}
            _ => self.put(entity)?,
        }
        Ok(())
    }

    fn end_polyline(&mut self) -> Result<(), Error> {
        self.polyline.take().map_or(Ok(()), |polyline| self.put(polyline))
    }

    /// Puts an entity into the block that is being read, or into the drawing.
    fn put(&mut self, entity: Entity) -> Result<(), Error> {
        let item = match entity.item() {
            What::Is(item) => item,
            What::IsNot(why) => {
                *self.left_out.entry(why).or_default() += 1;
                return Ok(());
            }
        };
        if let Some(block) = &mut self.block {
            block.items.push(item);
            return Ok(());
        }
        let Self { shapes, blocks, left_out, arcs, curves, stretched, lost, .. } = self;
        let closed_are_polygons = self.closed_are_polygons;
        blocks.expand(&item, &mut |layer, item, path| match item {
            None => *left_out.entry("INSERT of what is no block".to_owned()).or_default() += 1,
            Some(item) => {
                *curves += path.curves;
                *arcs += if path.curves > 0 { 0 } else { path.arcs };
                *lost += path.lost;
                *stretched += if path.centers.is_empty() { path.arcs } else { 0 };
                draw(shapes, layer, item, path, closed_are_polygons);
            }
        })
    }
}

/// Takes an item of a layer along its path.
fn draw(shapes: &mut Shapes, layer: &str, item: &Item, path: &Path, closed_are_polygons: bool) {
    shapes.feature();
    shapes.attribute("layer", Value::Text(layer));
    let start = shapes.len();
    let ends = item.is_closed().then(|| path.points.first()).flatten();
    path.centers.iter().for_each(|&(segment, [x, y, _])| shapes.center(segment, [x, y]));
    for point in path.points.iter().chain(ends) {
        shapes.position(if item.is_high() { point } else { &point[..2] });
    }
    match item {
        Item::Point { .. } | Item::Insert { .. } => {}
        Item::Line { .. } if closed_are_polygons && ends.is_some() => {
            shapes.polygon();
            shapes.ring(start, true);
        }
        Item::Line { .. } => shapes.line(start),
    }
}

#[cfg(test)]
mod tests;
