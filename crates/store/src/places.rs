//! Where the files of a folder are.

use std::path::{Path, PathBuf};

use delone::tiles::Node;

/// Where a folder's file of a kind is for a node.
pub(crate) fn place(folder: &Path, kind: &str, node: Node, extension: &str) -> PathBuf {
    folder.join(format!("{kind}-{:05}.{extension}", node.number()))
}
