//! Folders of tiles: Delaunay triangulations of more points than memory.
//!
//! A run ([`Build`]) reads its files twice, cuts the plane into tiles, triangulates each by itself and joins what is undecided. The
//! triangles are those of all points at once, to the last tie, whatever the memory. A run that was stopped, at any moment, goes on with
//! [`Build::resume`].
//!
//! ```
//! use delone::tiles::Region;
//! use delone_store::{Build, Files, Store};
//!
//! let place = tempfile::tempdir()?;
//! let path = place.path().join("points.csv");
//! let text: String = (0..3000).map(|i| format!("{},{},{}\n", i * 7919 % 3001, i * 6007 % 2999, i % 10)).collect();
//! std::fs::write(&path, text)?;
//!
//! let folder = place.path().join("tiles");
//! let build = Build::new().memory(64 << 20).tile(500).heights(true);
//! let (store, _) = build.run(&Files::new([&path])?, &folder, &())?;
//! assert!(store.summary().tiles > 5);
//!
//! // Anybody may prove that these are the triangles of all points.
//! let store = Store::open(&folder)?;
//! store.verify(&())?;
//! let part = store.window(&Region { low: [0.0, 0.0], high: [100.0, 100.0] }, &())?;
//! assert!(part.triangle_count() > 0);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! | file | contents |
//! | --- | --- |
//! | `tiles.json` | count, triangles, fingerprint, cuts, and what each node has |
//! | `points-NNNNN.npy` | the points of tile N that differ, along a curve: float64 (n, 2), with heights (n, 3) |
//! | `ids-NNNNN.npy` | for each of them its index in the input, from 0: uint64 (n,) |
//! | `triangles-NNNNN.npy` | its triangles, counter-clockwise, as indices of its points: uint32 (t, 3) |
//! | `seam-NNNNN.npy` | triangles between tiles, uint64 (t, 3): the number of the tile times 2^32, and the index there |
//! | `neighbors-NNNNN.npy` | the triangle of the same file across each edge |
//! | `across-NNNNN.npy` | the triangles across edges to other nodes |
//! | `points-NNNNN.parquet`, `triangles-NNNNN.parquet` | the points and the triangles as tables, where they were asked for |
//! | `border-NNNNN.bin`, `bucket-NNNNN.bin` | while work goes on |
//!
//! Nothing is printed, and no option is read: [`Watch`] hears of progress, and may end the work.

#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;

mod buckets;
mod budget;
mod build;
mod bytes;
mod error;
mod input;
mod locate;
mod manifest;
mod neighbors;
mod node;
mod own;
mod places;
mod seams;
mod shards;
mod store;
mod sums;
mod surface;
#[cfg(feature = "parquet")]
mod tables;
mod triangulate;
mod trust;
mod verify;
mod watch;
mod window;

pub use build::{Build, keep_out};
pub use error::{Difference, Error};
pub use input::Files;
pub use manifest::NAME as MANIFEST;
pub use store::{Corner, Description, State, Store, Summary, describe};
pub use surface::Surface;
pub use watch::Watch;
pub use window::Part;
