//! Points as they come from a file.

use crate::cell::UnitCell;
use crate::error::listed;
use crate::{Crs, Error, Features};

/// Points in the order of their file: the coordinates that are triangulated, the heights beside them, and what else
/// the file tells.
///
/// Fields may be added: a literal ends with `..` and a value to take the rest from.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Cloud {
    /// x and y.
    pub xy: Vec<[f64; 2]>,
    /// z, where the file has it: one a point.
    pub z: Option<Vec<f64>>,
    /// The system of coordinates, where the file tells.
    pub crs: Option<Crs>,
    /// The number of the first point where the file numbers them: 0 or 1.
    pub base: usize,
    /// LAS classes and how many points of the file have them, those left out included.
    pub classes: Vec<(u8, u64)>,
    /// How many points of LAS files have each flag ([`LasFlag::ALL`](crate::LasFlag::ALL)), those left out included.
    pub flags: [u64; 4],
    /// The extra bytes of LAS files: names, and types in words.
    pub dimensions: Vec<(String, String)>,
    /// The box of a periodic set.
    pub cell: Option<UnitCell>,
    /// The attributes of the points, by the features that they are of.
    pub features: Features,
    /// Remarks on how the file was read: which columns were taken, what was left out.
    pub remarks: Vec<String>,
    /// Contents of the file that these points lack.
    pub losses: Vec<String>,
}

impl Cloud {
    /// Room for `n` points, with or without heights.
    pub(crate) fn with_capacity(n: usize, with_heights: bool) -> Self {
        // What a file claims is not believed beyond a point: memory grows with what is really there.
        let n = n.min(1 << 24);
        let z = with_heights.then(|| Vec::with_capacity(n));
        Self { xy: Vec::with_capacity(n), z, ..Self::default() }
    }

    /// Appends a point; `z` is ignored by a cloud without heights.
    pub(crate) fn push(&mut self, [x, y]: [f64; 2], z: f64) {
        self.xy.push([x, y]);
        if let Some(heights) = &mut self.z {
            heights.push(z);
        }
    }

    /// Tells that values of these names are left out; coordinates are none.
    pub(crate) fn lose_values<'a>(&mut self, names: impl Iterator<Item = &'a str>) {
        let names: Vec<&str> = names.filter(|name| !["x", "y", "z"].contains(name)).collect();
        if !names.is_empty() {
            self.losses.push(format!("values of points are left out: {}", listed(names.into_iter())));
        }
    }

    /// Makes room for so many points more.
    pub(crate) fn reserve(&mut self, n: usize) {
        self.xy.reserve(n);
        self.z.iter_mut().for_each(|z| z.reserve(n));
    }

    /// Forgets the points and their heights.
    pub(crate) fn clear(&mut self) {
        self.xy.clear();
        self.z.iter_mut().for_each(Vec::clear);
    }

    /// Appends the points of another cloud of the same kind.
    pub(crate) fn append(&mut self, mut other: Self) {
        self.xy.append(&mut other.xy);
        if let (Some(heights), Some(more)) = (&mut self.z, &mut other.z) {
            heights.append(more);
        }
    }

    /// Adds dimensions of another file to those that are known.
    pub(crate) fn add_dimensions(&mut self, others: &[(String, String)]) {
        for other in others {
            if !self.dimensions.contains(other) {
                self.dimensions.push(other.clone());
            }
        }
    }

    /// Makes one set of two files. Heights stay where both have them; systems of coordinates, and of heights that stay, must agree
    /// where both name one.
    pub fn join(&mut self, other: Self) -> Result<(), Error> {
        if let (Some(ours), Some(theirs)) = (&self.crs, &other.crs) {
            if !ours.agrees(theirs) {
                let [ours, theirs] = [ours, theirs].map(ToString::to_string);
                return Err(Error::Systems { what: "coordinates", ours, theirs });
            }
            let heights =
                ours.vertical.zip(theirs.vertical).filter(|_| self.z.is_some() && other.z.is_some());
            if let Some((ours, theirs)) = heights.filter(|(ours, theirs)| ours != theirs) {
                let [ours, theirs] = [ours, theirs].map(|number| format!("EPSG:{number}"));
                return Err(Error::Systems { what: "heights", ours, theirs });
            }
        }
        self.crs = self.crs.take().or_else(|| other.crs.clone());
        if let (Some(ours), Some(theirs)) = (self.cell, other.cell)
            && ours != theirs
        {
            return Err(Error::content("its box is another one than that of the files before it"));
        }
        self.cell = self.cell.or(other.cell);
        for &(class, count) in &other.classes {
            match self.classes.binary_search_by_key(&class, |entry| entry.0) {
                Ok(i) => self.classes[i].1 += count,
                Err(i) => self.classes.insert(i, (class, count)),
            }
        }
        self.flags.iter_mut().zip(other.flags).for_each(|(sum, count)| *sum += count);
        self.add_dimensions(&other.dimensions);
        self.remarks.extend(other.remarks.iter().cloned());
        self.losses.extend(other.losses.iter().cloned());
        self.features.join(self.xy.len(), &other.features, other.xy.len());
        if self.xy.is_empty() {
            (self.xy, self.z, self.base) = (other.xy, other.z, other.base);
        } else if !other.xy.is_empty() {
            if self.z.is_some() != other.z.is_some() {
                self.losses.push("heights are left out: not all files have them".to_owned());
                self.z = None;
            }
            self.append(other);
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::Cloud;
    use crate::Crs;

    fn cloud(n: usize, z: bool, epsg: Option<u32>) -> Cloud {
        let mut cloud = Cloud::with_capacity(n, z);
        (0..n).for_each(|i| cloud.push([i as f64, 1.0], 2.0));
        cloud.crs = epsg.map(Crs::of_epsg);
        cloud
    }

    #[test]
    fn files_join() {
        let mut both = cloud(2, true, Some(25832));
        both.classes = vec![(2, 2)];
        let mut second = cloud(3, true, None);
        second.classes = vec![(1, 1), (2, 2)];
        both.join(second).expect("one system");
        assert_eq!((both.xy.len(), both.z.as_ref().map(Vec::len)), (5, Some(5)));
        assert_eq!(both.classes, [(1, 1), (2, 4)]);
        assert!(both.join(cloud(1, true, Some(25833))).is_err());
        both.join(cloud(0, false, None)).expect("empty files change nothing");
        assert!(both.z.is_some() && both.losses.is_empty());
        both.join(cloud(1, false, None)).expect("no heights");
        assert_eq!((both.xy.len(), both.z, both.losses.len()), (6, None, 1));
    }
}
