//! Terrain models of points with heights: rasters, breaklines, level water, contours, hillshades, clipping.
//!
//! A [`Terrain`] is a [`Surface`] over the cells of a raster. Its heights depend on the set of points and lines alone. The order
//! of the points shows only under [`delone::surface::Duplicates::First`], the number of threads never. Rows are made in bands, so a raster may be larger than memory.
//!
//! ```
//! use std::ops::ControlFlow;
//! use delone_io::{Cloud, Format, read_raster};
//! use delone_terrain::{Cells, Lines, Method, Options, Product, Terrain};
//!
//! // A hill, measured at 400 places.
//! let xy: Vec<[f64; 2]> = (0..400).map(|i| [f64::from(i % 20), f64::from(i / 20)]).collect();
//! let z = xy.iter().map(|[x, y]| 50.0 - (x - 9.5).powi(2) - (y - 9.5).powi(2)).collect();
//! let cloud = Cloud { xy, z: Some(z), ..Cloud::default() };
//! let options = Options::new().method(Method::Natural);
//! let terrain = Terrain::new(&cloud, Lines::new(), &Cells::new().size(0.5), &options)?;
//! assert_eq!((terrain.grid().columns(), terrain.grid().rows()), (38, 38));
//!
//! // All files at once: a raster, its hillshade and contours every two units of height.
//! let folder = tempfile::tempdir()?;
//! let [dem, shade, map] = ["dem.tif", "shade.png", "contours.geojson"].map(|name| folder.path().join(name));
//! let files = [(dem.clone(), Format::Tiff), (shade, Format::Png), (map, Format::GeoJson)];
//! terrain.write(&files, &Product::new().interval(2.0), |_| ControlFlow::Continue(()))?;
//! let (source, format) = delone_io::open(&dem)?;
//! assert_eq!(read_raster(source, format)?.values[0], terrain.values()?[0] as f32 as f64);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! | wanted | how |
//! | --- | --- |
//! | points of files, of LAS files ground | [`Files::read`] |
//! | lines that are edges, water that is level | [`Lines`] |
//! | cells over an area, or those of another raster | [`Cells`] |
//! | the method, heights of equal points, long edges that go | [`Options`] |
//! | points in a folder of tiles, more than memory | [`Tiled`], [`Terrain::of_tiles`] |
//! | heights | [`Terrain::values`], [`Terrain::rows`], [`Surface::values`] |
//! | nothing outside of polygons | [`Terrain::clipped`], [`Clip`] |
//! | files | [`Terrain::write`], [`Sheets`] |
//! | remarks on what might surprise | [`Terrain::remarks`] |

#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;

mod cells;
mod clip;
mod error;
mod files;
mod level;
mod lines;
mod options;
mod points;
mod remark;
mod sheets;
mod surface;
mod terrain;
mod tiled;
pub mod values;

pub use cells::{Cells, bounds};
pub use clip::Clip;
pub use error::Error;
pub use files::{Files, GROUND, read_clip, read_lines, read_place, read_polygons};
pub use lines::Lines;
pub use options::{Method, Options};
pub use remark::Remark;
pub use sheets::{Fault, Product, Sheets};
pub use surface::{Counts, Surface, heights_of};
pub use terrain::{Terrain, is_map};
pub use tiled::Tiled;
