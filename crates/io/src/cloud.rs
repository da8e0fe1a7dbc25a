//! Points as they come from a file.

/// Points in the order of their file: the coordinates that are triangulated, and the heights beside them.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Cloud {
    /// x and y.
    pub xy: Vec<[f64; 2]>,
    /// z, where the file has it: one a point.
    pub z: Option<Vec<f64>>,
}

impl Cloud {
    /// Room for `n` points, with or without heights.
    pub(crate) fn with_capacity(n: usize, with_heights: bool) -> Self {
        // What a file claims is not believed beyond a point: memory grows with what is really there.
        let n = n.min(1 << 24);
        Self { xy: Vec::with_capacity(n), z: with_heights.then(|| Vec::with_capacity(n)) }
    }

    /// Appends a point; `z` is ignored by a cloud without heights.
    pub(crate) fn push(&mut self, [x, y]: [f64; 2], z: f64) {
        self.xy.push([x, y]);
        if let Some(heights) = &mut self.z {
            heights.push(z);
        }
    }
}
