//! The index of a layer: the extension `gpkg_rtree_index`, a table `rtree` of SQLite with the boxes of the features, and the triggers
//! that keep it true in programs that change the layer.
//!
//! Source: OGC 12-128r17 (version 1.3), Annex F.3; the nodes are those of SQLite's `ext/rtree/rtree.c`. They are packed by the method
//! of Leutenegger, Lopez and Edgington (STR, 1997): features one by one take several times as long.

use rusqlite::{Connection, params};

use super::read::quoted;

/// The number of the root, which SQLite expects.
const ROOT: i64 = 1;

const REGISTER: &str = "INSERT INTO gpkg_extensions
 VALUES (?, ?, 'gpkg_rtree_index', 'http://www.geopackage.org/spec120/#extension_rtree', 'write-only')";

/// The boxes of the features so far.
#[derive(Default)]
pub(super) struct Index {
    entries: Vec<Entry>,
}

/// A feature or a node, and its box, rounded outwards.
#[derive(Clone, Copy)]
struct Entry {
    id: i64,
    low: [f32; 2],
    high: [f32; 2],
}

impl Index {
    /// Takes the box of a feature.
    pub(super) fn add(&mut self, id: i64, [low, high]: [[f64; 2]; 2]) {
        self.entries.push(Entry { id, low: low.map(rounded_down), high: high.map(|x| -rounded_down(-x)) });
    }

    /// Writes the index of a table that is complete, where `key` and `geometry` are its columns.
    pub(super) fn write(
        self,
        connection: &Connection,
        table: &str,
        [key, geometry]: [&str; 2],
    ) -> rusqlite::Result<()> {
        let name = format!("rtree_{table}_{geometry}");
        let tree = quoted(&name);
        connection
            .execute_batch(&format!("CREATE VIRTUAL TABLE {tree} USING rtree(id, minx, maxx, miny, maxy)"))?;
        self.pack(connection, &name)?;
        let trigger = |which: &str| quoted(&format!("{name}_{which}"));
        let (table_name, geometry_name) = (table, geometry);
        let (table, t, i) = (quoted(table), quoted(geometry), quoted(key));
        let has = |row: &str| format!("({row}.{t} NOTNULL AND NOT ST_IsEmpty({row}.{t}))");
        let has_none = format!("(NEW.{t} ISNULL OR ST_IsEmpty(NEW.{t}))");
        let put = format!(
            "INSERT OR REPLACE INTO {tree} VALUES (NEW.{i}, ST_MinX(NEW.{t}), ST_MaxX(NEW.{t}), ST_MinY(NEW.{t}), ST_MaxY(NEW.{t}));"
        );
        let take = format!("DELETE FROM {tree} WHERE id = OLD.{i};");
        let (same, other) = (format!("OLD.{i} = NEW.{i}"), format!("OLD.{i} != NEW.{i}"));
        let (one, new) = (format!("UPDATE OF {t}"), has("NEW"));
        for (which, event, when, what) in [
            ("insert", "INSERT", new.clone(), put.clone()),
            ("update1", &one, format!("{same} AND {new}"), put.clone()),
            ("update2", &one, format!("{same} AND {has_none}"), take.clone()),
            ("update3", "UPDATE", format!("{other} AND {new}"), format!("{take} {put}")),
            (
                "update4",
                "UPDATE",
                format!("{other} AND {has_none}"),
                format!("DELETE FROM {tree} WHERE id IN (OLD.{i}, NEW.{i});"),
            ),
            ("delete", "DELETE", format!("OLD.{t} NOT NULL"), take),
        ] {
            connection.execute_batch(&format!(
                "CREATE TRIGGER {} AFTER {event} ON {table} WHEN {when} BEGIN {what} END",
                trigger(which)
            ))?;
        }
        connection.execute(REGISTER, params![table_name, geometry_name]).map(|_| ())
    }

    /// Writes the nodes of the tree from the leaves to the root, and in which node each feature and each node is.
    fn pack(self, connection: &Connection, name: &str) -> rusqlite::Result<()> {
        let part = |part: &str| quoted(&format!("{name}_{part}"));
        let (node, parent, leaf) = (part("node"), part("parent"), part("rowid"));
        let find = format!("SELECT length(data) FROM {node} WHERE nodeno = {ROOT}");
        let length = connection.query_row(&find, [], |row| row.get::<_, u32>(0))? as usize;
        let most = (length - Entry::HEAD) / Entry::LENGTH;
        let mut put_node = connection.prepare(&format!("INSERT OR REPLACE INTO {node} VALUES (?, ?)"))?;
        let mut put_leaf = connection.prepare(&format!("INSERT INTO {leaf} VALUES (?, ?)"))?;
        let mut put_parent = connection.prepare(&format!("INSERT INTO {parent} VALUES (?, ?)"))?;
        let mut level = self.entries;
        let mut next = ROOT;
        for depth in 0.. {
            let is_root = level.len() <= most;
            arrange(&mut level, most);
            let mut above = Vec::new();
            let mut places = Vec::with_capacity(level.len());
            // A tree without features has an empty root.
            let nodes = if level.is_empty() { vec![&level[..]] } else { level.chunks(most).collect() };
            for entries in nodes {
                next += i64::from(!is_root);
                let number = if is_root { ROOT } else { next };
                put_node.execute(params![number, Entry::node(entries, depth, length)])?;
                places.extend(entries.iter().map(|entry| (entry.id, number)));
                above.extend(
                    entries.iter().copied().reduce(Entry::around).map(|all| Entry { id: number, ..all }),
                );
            }
            places.sort_unstable();
            let put_place = if depth == 0 { &mut put_leaf } else { &mut put_parent };
            for (id, number) in places {
                put_place.execute([id, number])?;
            }
            if is_root {
                break;
            }
            level = above;
        }
        Ok(())
    }
}

impl Entry {
    /// Bytes of an entry, and before the entries of a node.
    const LENGTH: usize = 24;
    const HEAD: usize = 4;

    /// The smallest box around both.
    fn around(self, other: Self) -> Self {
        let pick = |a: [f32; 2], b: [f32; 2], better: fn(f32, f32) -> f32| [0, 1].map(|k| better(a[k], b[k]));
        Self {
            id: self.id,
            low: pick(self.low, other.low, f32::min),
            high: pick(self.high, other.high, f32::max),
        }
    }

    /// A node of a tree of so many levels below its root. SQLite reads that number in the root alone.
    fn node(entries: &[Self], depth: u16, length: usize) -> Vec<u8> {
        let mut bytes = Vec::with_capacity(length);
        bytes.extend(depth.to_be_bytes());
        bytes.extend((entries.len() as u16).to_be_bytes());
        for entry in entries {
            bytes.extend(entry.id.to_be_bytes());
            for k in [0, 1] {
                bytes.extend(entry.low[k].to_be_bytes());
                bytes.extend(entry.high[k].to_be_bytes());
            }
        }
        bytes.resize(length, 0);
        bytes
    }

    /// Twice the middle.
    fn middle(&self, k: usize) -> f64 {
        f64::from(self.low[k]) + f64::from(self.high[k])
    }
}

/// Puts entries in an order in which runs of `most` are close together: upright strips, from below in each.
fn arrange(entries: &mut [Entry], most: usize) {
    let nodes = entries.len().div_ceil(most);
    let strips = nodes.isqrt().max(1);
    let by = |k: usize| {
        move |a: &Entry, b: &Entry| a.middle(k).total_cmp(&b.middle(k)).then_with(|| a.id.cmp(&b.id))
    };
    entries.sort_unstable_by(by(0));
    for strip in entries.chunks_mut(nodes.div_ceil(strips).max(1) * most) {
        strip.sort_unstable_by(by(1));
    }
}

/// The largest number of single precision that is not above.
fn rounded_down(x: f64) -> f32 {
    let near = x as f32;
    if f64::from(near) > x { near.next_down() } else { near }
}
