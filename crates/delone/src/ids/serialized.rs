//! Ids as plain numbers of 32 bits, for `serde`. What is read is checked: no id is made that the library would not give.
//!
//! An id means nothing without its triangulation. That is not written itself: it is a function of its points, so points are enough.

use serde::de::{Error, Unexpected};
use serde::{Deserialize, Deserializer, Serialize, Serializer};

use super::{EdgeId, FacetId, MAX_POINTS, MAX_TETRAHEDRA, TetrahedronId, TriangleId, VertexId};

macro_rules! ids {
    ($($id:ident: $expected:literal, $is_one:expr;)+) => { $(
        impl Serialize for $id {
            fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
                serializer.serialize_u32(self.0)
            }
        }

        impl<'de> Deserialize<'de> for $id {
            fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
                let bits = u32::deserialize(deserializer)?;
                let is_one: fn(u32) -> bool = $is_one;
                let wrong = || D::Error::invalid_value(Unexpected::Unsigned(bits.into()), &$expected);
                is_one(bits).then_some(Self(bits)).ok_or_else(wrong)
            }
        }
    )+ };
}

ids! {
    // Beside indices of points the ghost, and what `VertexId::new` gives for too large ones.
    VertexId: "an index of a point below 2^29, 2^32 - 2 for none, or 2^32 - 1 for the ghost",
        |bits| (bits as usize) < MAX_POINTS || bits >= u32::MAX - 1;
    TriangleId: "an index of a triangle below 2^30", |bits| (bits as usize) < 2 * MAX_POINTS;
    EdgeId: "four times the index of a triangle, and 0, 1 or 2", |bits| bits % 4 < 3;
    TetrahedronId: "an index of a tetrahedron below 2^30", |bits| (bits as usize) < MAX_TETRAHEDRA;
    FacetId: "four times the index of a tetrahedron, and 0 to 3", |bits| Self::NONE.0 != bits;
}

#[cfg(test)]
mod tests {
    use std::fmt::Debug;

    use serde::{Serialize, de::DeserializeOwned};

    use super::{EdgeId, FacetId, TetrahedronId, TriangleId, VertexId};
    use crate::ids::{Duplicate, Inserted};
    use crate::{Bounds, Delaunay2, Delaunay3, Dimension, Location2, SegmentId, Triangulation};

    fn goes_through<T: Serialize + DeserializeOwned + PartialEq + Debug>(value: T, text: &str) {
        assert_eq!(serde_json::to_string(&value).expect("written"), text, "{value:?}");
        assert_eq!(serde_json::from_str::<T>(text).expect("read"), value);
    }

    #[test]
    fn what_is_written_is_read() {
        let d = Delaunay2::from_points(&[[0, 0], [1, 0], [0, 1], [1, 1]]).expect("finite");
        let mut last = (0, 0);
        for t in d.triangle_ids() {
            goes_through(t, &t.index().to_string());
            for e in [0, 1, 2].map(|k| t.edge(k)) {
                goes_through(e, &(4 * t.index() + e.corner()).to_string());
            }
            goes_through(Location2::Triangle(t), &format!("{{\"Triangle\":{}}}", t.index()));
            last = (t.index(), last.0);
        }
        assert!(last.0 != last.1);
        let space = Delaunay3::from_points(&[[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]]).expect("finite");
        for t in space.simplices() {
            goes_through(t, &t.index().to_string());
            (0..4).for_each(|k| goes_through(t.facet(k), &(4 * t.index() + k).to_string()));
        }
        goes_through(VertexId::GHOST, "4294967295");
        goes_through(VertexId::new(usize::MAX), "4294967294");
        goes_through([VertexId::new(0), VertexId::new((1 << 29) - 1)], "[0,536870911]");
        goes_through(SegmentId::new(7), "7");
        goes_through(Dimension::Space, "\"Space\"");
        goes_through(Inserted::New(VertexId::new(3)), "{\"New\":3}");
        goes_through(Duplicate { point: 5, vertex: VertexId::new(3) }, "{\"point\":5,\"vertex\":3}");
        goes_through(
            Bounds { low: [0.5, -1.0], high: [2.0, 0.1] },
            "{\"low\":[0.5,-1.0],\"high\":[2.0,0.1]}",
        );
        goes_through(
            Bounds { low: [0.0; 3], high: [1.5; 3] },
            "{\"low\":[0.0,0.0,0.0],\"high\":[1.5,1.5,1.5]}",
        );
    }

    #[test]
    fn what_is_no_id_is_not_read() {
        let refused = |text: &str| {
            [
                serde_json::from_str::<VertexId>(text).is_err(),
                serde_json::from_str::<TriangleId>(text).is_err(),
                serde_json::from_str::<EdgeId>(text).is_err(),
                serde_json::from_str::<TetrahedronId>(text).is_err(),
                serde_json::from_str::<FacetId>(text).is_err(),
            ]
        };
        assert_eq!(refused("0"), [false; 5]);
        assert_eq!(refused("3"), [false, false, true, false, false]);
        assert_eq!(refused("536870912"), [true, false, false, false, false]);
        assert_eq!(refused("1073741824"), [true, true, false, true, false]);
        assert_eq!(refused("4294967295"), [false, true, true, true, true]);
        for text in ["4294967296", "-1", "0.5", "\"0\"", "null"] {
            assert_eq!(refused(text), [true; 5], "{text}");
        }
        let message = serde_json::from_str::<EdgeId>("7").expect_err("no edge").to_string();
        assert!(message.contains("integer `7`, expected four times the index"), "{message}");
        assert!(serde_json::from_str::<Dimension>("\"Hyperspace\"").is_err());
        assert!(serde_json::from_str::<Bounds<2>>("{\"low\":[0.0],\"high\":[1.0,1.0]}").is_err());
    }
}
