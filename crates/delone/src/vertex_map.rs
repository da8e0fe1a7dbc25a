//! User data of vertices, beside the triangulation.

use std::ops::{Index, IndexMut};

use crate::ids::VertexId;

/// A value for each of some vertices: O(1) to find, as much memory as the largest id asks for.
///
/// It does not follow the triangulation: a vertex that is removed leaves its value here, and after
/// [`crate::Delaunay2::compact`] values are taken along by [`Self::compact`].
///
/// ```
/// use delone::{Delaunay2, VertexMap};
///
/// let mut d = Delaunay2::from_points(&[[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]])?;
/// let mut names: VertexMap<&str> = d.vertices().zip(["home", "east", "north"]).collect();
/// let v = d.insert([1.0, 1.0])?.vertex();
/// names.insert(v, "corner");
/// assert_eq!((names[v], names.len()), ("corner", 4));
///
/// let gone = d.vertices().next().expect("four");
/// d.remove(gone)?;
/// names.compact(&d.compact());
/// assert_eq!(names.iter().map(|(_, name)| *name).collect::<Vec<_>>(), ["east", "north", "corner"]);
/// # Ok::<(), delone::Error>(())
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct VertexMap<T> {
    values: Vec<Option<T>>,
    count: usize,
}

impl<T> Default for VertexMap<T> {
    fn default() -> Self {
        Self { values: Vec::new(), count: 0 }
    }
}

impl<T> VertexMap<T> {
    /// No values.
    pub fn new() -> Self {
        Self::default()
    }

    /// The number of values.
    pub fn len(&self) -> usize {
        self.count
    }

    /// Whether there is none.
    pub fn is_empty(&self) -> bool {
        self.count == 0
    }

    /// Gives a vertex a value, and returns the one that it had.
    ///
    /// # Panics
    /// For the ghost vertex, and for an id beyond [`crate::MAX_POINTS`], which is none of any triangulation.
    pub fn insert(&mut self, v: VertexId, value: T) -> Option<T> {
        assert!(v.index() < crate::MAX_POINTS, "{v:?} is no vertex of any triangulation");
        if self.values.len() <= v.index() {
            self.values.resize_with(v.index() + 1, || None);
        }
        let before = self.values[v.index()].replace(value);
        self.count += usize::from(before.is_none());
        before
    }

    /// Takes the value of a vertex away.
    pub fn remove(&mut self, v: VertexId) -> Option<T> {
        let before = self.values.get_mut(v.index())?.take();
        self.count -= usize::from(before.is_some());
        before
    }

    /// The value of a vertex.
    pub fn get(&self, v: VertexId) -> Option<&T> {
        self.values.get(v.index())?.as_ref()
    }

    /// The value of a vertex, to be changed.
    pub fn get_mut(&mut self, v: VertexId) -> Option<&mut T> {
        self.values.get_mut(v.index())?.as_mut()
    }

    /// The vertices that have a value, by increasing index, each with it.
    pub fn iter<'a>(&'a self) -> impl Iterator<Item = (VertexId, &'a T)> {
        let known = |(i, value): (usize, &'a Option<T>)| Some((VertexId::new(i), value.as_ref()?));
        self.values.iter().enumerate().filter_map(known)
    }

    /// Follows vertices that get new ids: `ids` has for each old one the new one, and none for what is no vertex, whose
    /// value is dropped.
    pub fn compact(&mut self, ids: &[Option<VertexId>]) {
        let values = std::mem::take(self).values;
        for (value, id) in values.into_iter().zip(ids) {
            if let (Some(value), Some(v)) = (value, *id) {
                self.insert(v, value);
            }
        }
    }
}

impl<T> FromIterator<(VertexId, T)> for VertexMap<T> {
    fn from_iter<I: IntoIterator<Item = (VertexId, T)>>(values: I) -> Self {
        let mut map = Self::new();
        values.into_iter().for_each(|(v, value)| _ = map.insert(v, value));
        map
    }
}

impl<T> Index<VertexId> for VertexMap<T> {
    type Output = T;

    /// The value of a vertex that has one.
    fn index(&self, v: VertexId) -> &T {
        self.get(v).expect("a vertex with a value")
    }
}

impl<T> IndexMut<VertexId> for VertexMap<T> {
    /// The value of a vertex that has one, to be changed.
    fn index_mut(&mut self, v: VertexId) -> &mut T {
        self.get_mut(v).expect("a vertex with a value")
    }
}

#[cfg(test)]
mod tests {
    use super::VertexMap;
    use crate::VertexId;

    #[test]
    fn values_come_and_go() {
        let [a, b, far] = [0, 3, usize::MAX].map(VertexId::new);
        let mut map = VertexMap::new();
        assert_eq!((map.insert(b, 1), map.insert(b, 2), map.insert(a, 3)), (None, Some(1), None));
        assert_eq!((map.len(), map[a], map[b]), (2, 3, 2));
        assert_eq!(map.remove(far), None);
        assert_eq!((map.get(far), map.get(VertexId::GHOST)), (None, None));
        map[a] += 1;
        assert_eq!(map.iter().collect::<Vec<_>>(), [(a, &4), (b, &2)]);
        map.compact(&[None, None, None, Some(a)]);
        assert_eq!((map.len(), map.get(a), map.get(b)), (1, Some(&2), None));
        assert_eq!((map.remove(a), map.remove(a), map.is_empty()), (Some(2), None, true));
    }

    #[test]
    #[should_panic(expected = "no vertex of any triangulation")]
    fn ids_of_nothing_take_no_memory() {
        VertexMap::new().insert(VertexId::new(1 << 32), ());
    }
}
