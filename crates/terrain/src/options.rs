//! How heights between points come about.

use std::fmt;
use std::str::FromStr;

use delone::surface::{Border, Duplicates};

/// How heights between points come about.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
pub enum Method {
    /// Linear in each triangle.
    #[default]
    Linear,
    /// Natural neighbors: the area that the cell of a place takes from the cells of its neighbors (Sibson).
    Natural,
    /// Natural neighbors: the size of facets over distances (Laplace).
    Laplace,
    /// The height of the nearest point.
    Nearest,
    /// Natural neighbors with gradients: smooth at the points too (Sibson).
    Smooth,
    /// Smooth at the points too, by a cubic (Farin).
    Farin,
}

impl Method {
    /// All of them.
    pub const ALL: [Self; 6] =
        [Self::Linear, Self::Natural, Self::Laplace, Self::Nearest, Self::Smooth, Self::Farin];

    /// Whether it needs gradients, which are of all points.
    pub fn needs_gradients(self) -> bool {
        matches!(self, Self::Smooth | Self::Farin)
    }

    /// Its name, in small letters.
    pub fn name(self) -> &'static str {
        match self {
            Self::Linear => "linear",
            Self::Natural => "natural",
            Self::Laplace => "laplace",
            Self::Nearest => "nearest",
            Self::Smooth => "smooth",
            Self::Farin => "farin",
        }
    }
}

impl fmt::Display for Method {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

impl FromStr for Method {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        Self::ALL.into_iter().find(|method| method.name() == text).ok_or_else(|| {
            let names: Vec<&str> = Self::ALL.iter().map(|method| method.name()).collect();
            format!("there is no method {text:?}, but {}", names.join(", "))
        })
    }
}

/// How a surface is made of points.
///
/// ```
/// use delone::surface::{Border, Duplicates};
/// use delone_terrain::{Method, Options};
///
/// let options = Options::new()
///     .method(Method::Natural)
///     .duplicates(Duplicates::Mean)
///     .border(Border::long_edges(Some(50.0)));
/// assert!(!options.method.needs_gradients());
/// ```
#[derive(Clone, Debug, Default)]
#[non_exhaustive]
pub struct Options {
    /// How heights between points come about.
    pub method: Method,
    /// Which height counts where points have the same x and y.
    pub duplicates: Duplicates,
    /// Which triangles are left out for their long edges.
    pub border: Border,
}

impl Options {
    /// Linear, with the lowest height of each place, and all triangles.
    pub fn new() -> Self {
        Self::default()
    }

    /// Sets [`Self::method`].
    #[must_use]
    pub fn method(self, method: Method) -> Self {
        Self { method, ..self }
    }

    /// Sets [`Self::duplicates`].
    #[must_use]
    pub fn duplicates(self, duplicates: Duplicates) -> Self {
        Self { duplicates, ..self }
    }

    /// Sets [`Self::border`].
    #[must_use]
    pub fn border(self, border: Border) -> Self {
        Self { border, ..self }
    }
}
