//! More points than memory: triangulated in tiles, the same triangles to the last tie.
//!
//! [`Cuts`] divide the plane into regions, a tree of them, and each point belongs to the tile whose region it is in. A [`Tile`]
//! tells by itself which of its triangles are *final*: those whose circle stays inside of its region (their *certificate*), because no
//! point of another tile can be there. The few others, near the cuts and along the outline, are *open*; their corners and those of
//! the hull are the tile's [`Border`], and all that others need of it. [`join`] triangulates the borders of the parts of a region
//! together, and keeps a triangle if its corners are of different parts, or if it was open in its part. Of those kept some are
//! final now, the *seam*; the rest is the border of the region. At the root all are final.
//!
//! In space it is the same with spheres and tetrahedra: `Cuts<3>`, `Region<3>`, [`Tile3`], [`Border3`], [`join3`].
//!
//! `Tile::new` and `join` are pure functions of points and a region: they use no file, no clock, and no messages between tiles. One process can walk
//! the tree, many machines can share it.
//!
//! Source: the certificate is the one by which Isenburg, Liu, Shewchuk & Snoeyink finalize triangles ("Streaming computation of
//! Delaunay triangulations", SIGGRAPH 2006); that the triangulation of the borders fits, from Funke & Sanders ("Parallel d-d
//! Delaunay triangulations in shared and distributed memory", ALENEX 2017).
//!
//! Cost: that of the triangulation of each tile, and O(b log b) for the b points of borders: of evenly spread points as many as lie along the
//! cuts, 0.3% of a billion in 256 tiles; in space as many as lie along planes, so that tiles should be larger. Where no circle is small (all points on one circle, or on a line) nothing is final before
//! the root, and all points travel.
//!
//! # Why it is right
//!
//! Say P are all points, P_X those in region X, T(Q) the canonical triangulation of Q with its ghosts. It is unique, and the
//! perturbation of a point depends on the point alone, so decisions agree between subsets.
//!
//! *A final triangle of T(P_X) is in T(P).* The points of P that are not in P_X are outside of X, and its closed circle is inside: none
//! of them is in or on the circle.
//!
//! *A search from the ghosts through triangles without certificate meets all that are not in T(P).* A point q outside of X is in conflict
//! with triangles of T(P_X) that hang together, a ghost among them, and the circles of all of them reach q, so none has a certificate.
//!
//! *What a join keeps is right.* Let F be the triangles final below X, and those of part j be F_j and U_j: its open triangles and
//! all its ghosts. Let B_j be the corners of U_j, and B all of them. (a) A vertex that is not in B has only final triangles
//! around it, which close a cycle, so its star in T(P_X) is the same. (b) Hence a triangle of T(P_X) that is not in F has all corners in
//! B, and is in T(B), because it is empty of B; if all its corners are of part j it is in T(P_j), so in U_j. (c) An edge between F_j and
//! U_j has both ends in B and is an edge of T(P_X), so of T(B): each triangle of T(B) is inside of the area of F or outside. Outside, T(B)
//! and T(P_X) without F cover the same area, and all triangles of the latter are in T(B): they are the same. (d) Final triangles of
//! different parts share no corner, so a connected piece of F is of one part j, and a triangle of T(B) inside of it has all corners in j and
//! is not in U_j, which lies outside of F_j. Outside of F it has corners of different parts or is in U_j, by (b). So the test of a join
//! keeps exactly the triangles outside of F.
//!
//! All of this holds in space, with tetrahedra and spheres, and facets for edges.
//!
//! ```
//! use delone::tiles::{Cuts, Fingerprint, Node, Tile, join};
//! use delone::Delaunay2;
//!
//! let points: Vec<[f64; 2]> = (0..5000).map(|i| [f64::from(i * 37 % 1009), f64::from(i * i % 907)]).collect();
//! let cuts = Cuts::from_sample(&points, 8)?;
//! let (mut found, mut borders) = (Fingerprint::default(), Vec::new());
//! for node in cuts.tiles() {
//!     let mine: Vec<usize> = (0..points.len()).filter(|&i| cuts.tile_of(points[i]) == node).collect();
//!     let its: Vec<[f64; 2]> = mine.iter().map(|&i| points[i]).collect();
//!     let tile = Tile::new(&its, &cuts.region(node))?;
//!     tile.finals().for_each(|t| found.add(t.map(|v| tile.points()[v as usize])));
//!     borders.push(tile.border(|v| mine[tile.order()[v as usize] as usize] as u64));
//! }
//! let seam = join(&borders, &cuts.region(Node::ROOT))?;
//! seam.triangles.iter().for_each(|t| found.add(t.map(|i| points[i as usize])));
//! assert_eq!(found, Fingerprint::of(&Delaunay2::from_points(&points)?));
//! # Ok::<(), delone::Error>(())
//! ```

mod along;
mod border;
mod bytes;
mod cuts;
mod fingerprint;
mod join;
mod region;
mod tile;
mod tile3;
mod window;

pub use border::{Border, Border3, BorderOf};
pub use cuts::{Cut, Cuts, Node};
pub use fingerprint::{Fingerprint, NoFingerprint};
pub use join::{Seam, Seam3, join, join3};
pub use region::Region;
pub use tile::Tile;
pub use tile3::Tile3;
