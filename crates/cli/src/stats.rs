//! Statistics: counts and times, as JSON.

use std::io::Write;
use std::path::Path;
use std::time::Instant;

use delone::{Coordinates, Counters, Dimension, Triangulation, Work};
use serde_json::{Map, Value, json};

use crate::files;
use crate::message::{Failure, grouped, say};

/// Collects numbers while a command works.
pub struct Stats {
    started: Instant,
    seconds: Map<String, Value>,
    facts: Map<String, Value>,
}

impl Stats {
    pub fn start() -> Self {
        Self { started: Instant::now(), seconds: Map::new(), facts: Map::new() }
    }

    /// Ends a phase: everything since the last one. Times of phases of one name add up.
    pub fn phase(&mut self, name: &str) {
        let now = Instant::now();
        let before = self.seconds.get(name).and_then(Value::as_f64).unwrap_or(0.0);
        let seconds = before + now.duration_since(self.started).as_secs_f64();
        self.seconds.insert(name.to_owned(), json!(seconds));
        self.started = now;
    }

    /// Notes a fact.
    pub fn set(&mut self, name: &str, value: impl Into<Value>) {
        self.facts.insert(name.to_owned(), value.into());
    }

    /// A fact noted before.
    pub(crate) fn get(&self, name: &str) -> Value {
        self.facts.get(name).cloned().unwrap_or(Value::Null)
    }

    /// Notes what a triangulation has, and what its construction did.
    pub fn triangulation(&mut self, d: &impl Triangulation, counters: Counters) {
        self.set("points", d.ids_given());
        self.set("duplicates", d.duplicates().count());
        self.set("vertices", d.vertex_count());
        self.set("simplices", d.simplex_count());
        self.set("hull", hull(d));
        self.set("dimension", format!("{:?}", d.dimension()).to_lowercase());
        let counters = match counters {
            Counters::DivideAndConquer(c) => {
                json!({ "leaves": c.leaves, "merges": c.merges, "connected": c.connected, "removed": c.removed })
            }
            Counters::Incremental(work) => work_done(&work),
            Counters::ConflictLists { work, moved } => {
                let mut counters = work_done(&work);
                counters["moved"] = json!(moved);
                counters
            }
            _ => json!({}),
        };
        self.set("counters", counters);
    }

    /// Says in one line what was done; `simplices` are called so, one and many.
    pub(crate) fn tell(&self, quiet: bool, simplices: [&str; 2]) {
        let names = [
            ("polygons", ["polygon", "polygons"]),
            ("refused", ["left out", "left out"]),
            ("points", ["point", "points"]),
            ("simplices", simplices),
            ("left_out", ["left out", "left out"]),
            ("hull", ["on the hull", "on the hull"]),
            ("cells", ["cell", "cells"]),
            ("edges", ["edge", "edges"]),
            ("queries", ["query", "queries"]),
        ];
        let counts = names.iter().filter_map(|(name, [one, many])| {
            let count = self.get(name).as_u64()?;
            Some(format!("{} {}", grouped(count), if count == 1 { one } else { many }))
        });
        say(quiet, format_args!("{} ({:.2} s)", counts.collect::<Vec<_>>().join(", "), self.total()));
    }

    /// The seconds of all phases.
    pub(crate) fn total(&self) -> f64 {
        self.seconds.values().filter_map(Value::as_f64).sum()
    }

    /// Writes all of it, if a file was named.
    pub fn write(mut self, path: Option<&Path>) -> Result<(), Failure> {
        let Some(path) = path else { return Ok(()) };
        // The same keys from every command: null where nothing was counted, zero where nothing was done.
        for key in ["points", "duplicates", "simplices", "hull"] {
            self.facts.entry(key).or_insert(Value::Null);
        }
        self.facts.entry("counters").or_insert(json!({}));
        // What goes on one thread alone says so itself.
        self.facts.entry("threads").or_insert(json!(rayon::current_num_threads()));
        for phase in ["read", "build", "write"] {
            self.seconds.entry(phase).or_insert(json!(0.0));
        }
        self.facts.insert("seconds".to_owned(), Value::Object(self.seconds));
        let text = format!("{:#}\n", Value::Object(self.facts));
        files::write(path, |out| Ok(out.write_all(text.as_bytes())?))
    }
}

/// The size of the hull: its facets, and in the plane, where there are none, all vertices of a line.
fn hull<T: Triangulation>(d: &T) -> usize {
    match d.dimension() {
        Dimension::Empty | Dimension::Point | Dimension::Line if T::Point::COUNT == 2 => d.vertex_count(),
        _ => d.hull_facets().count(),
    }
}

/// Work by name.
pub fn work_done(work: &Work) -> Value {
    json!({
        "visited": work.visited,
        "compared": work.compared,
        "orientations": work.orientations,
        "in_circles": work.in_circles,
        "created": work.created,
        "destroyed": work.destroyed,
    })
}
