//! Points of files that are larger than memory: so many at a time.
//!
//! Readers push points into a [`Cloud`] and offer it to whoever takes them; for those who want all at once nobody does.

use crate::{Cloud, Error};

/// Takes points, and their heights where the file has them.
pub type Take<'a> = &'a mut dyn FnMut(&[[f64; 2]], Option<&[f64]>) -> Result<(), Error>;

/// Who takes points from a reader, and from how many on; by default nobody does.
#[derive(Default)]
pub(crate) struct Chunks<'a>(pub(crate) Option<(usize, Take<'a>)>);

impl Chunks<'_> {
    /// Whether nobody takes points.
    pub(crate) fn is_whole(&self) -> bool {
        self.0.is_none()
    }

    /// How many points to read before they are offered.
    pub(crate) fn most(&self) -> usize {
        self.0.as_ref().map_or(usize::MAX, |(most, _)| *most)
    }

    /// Gives the points away if they are enough, and says how many there were.
    #[inline]
    pub(crate) fn offer(&mut self, cloud: &mut Cloud) -> Result<usize, Error> {
        match &mut self.0 {
            Some((most, take)) if cloud.xy.len() >= *most => {
                take(&cloud.xy, cloud.z.as_deref())?;
                let count = cloud.xy.len();
                cloud.clear();
                Ok(count)
            }
            _ => Ok(0),
        }
    }
}
