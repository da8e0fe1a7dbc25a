//! The names that Triangle gives to what it writes.

use std::path::{Path, PathBuf};

use crate::Format;
use crate::format::is_gzip;

/// The name of what Triangle makes of a file, without its last extension: of `x.poly` it is `x.1`, of `x.2.poly` it is `x.3`. The
/// folder stays, compression is not taken over, and an extension that names no format is a part of the name.
///
/// ```
/// use std::path::Path;
/// use delone_io::{next_file, next_stem};
///
/// assert_eq!(next_stem(Path::new("a/x.poly")), Path::new("a/x.1"));
/// assert_eq!(next_file(Path::new("a/x.2.poly"), "v.node"), Path::new("a/x.3.v.node"));
/// ```
pub fn next_stem(path: &Path) -> PathBuf {
    let mut stem = path.to_owned();
    if is_gzip(&stem) {
        stem.set_extension("");
    }
    if Format::of(&stem).is_ok() {
        stem.set_extension("");
    }
    let number = stem.extension().and_then(|extension| extension.to_str()).filter(|text| is_number(text));
    let next = number.and_then(|number| number.parse::<u64>().ok()?.checked_add(1));
    if next.is_some() {
        stem.set_extension("");
    }
    appended(stem, &next.unwrap_or(1).to_string())
}

/// The name of a file that Triangle makes of another, with an extension such as `node` or `v.edge`: see [`next_stem`].
pub fn next_file(path: &Path, extension: &str) -> PathBuf {
    appended(next_stem(path), extension)
}

fn is_number(text: &str) -> bool {
    text.bytes().all(|byte| byte.is_ascii_digit())
}

/// A name with an extension after all that it has.
fn appended(stem: PathBuf, extension: &str) -> PathBuf {
    let mut name = stem.into_os_string();
    name.push(".");
    name.push(extension);
    name.into()
}

#[cfg(test)]
mod tests {
    use super::{next_file, next_stem};
    use std::path::Path;

    #[test]
    fn iterations_are_counted() {
        for (path, stem) in [
            ("x.poly", "x.1"),
            ("x.1.poly", "x.2"),
            ("x.9.node", "x.10"),
            ("x.007.ele", "x.8"),
            ("a.b/x.2.poly", "a.b/x.3"),
            ("a.2/x.poly", "a.2/x.1"),
            ("/x.2.poly.gz", "/x.3"),
            ("x.2", "x.3"),
            ("x", "x.1"),
            ("x.part", "x.part.1"),
            ("x.2a.poly", "x.2a.1"),
            ("x.-2.poly", "x.-2.1"),
            ("x.+2.poly", "x.+2.1"),
            ("x.2.3.poly", "x.2.4"),
            ("x..poly", "x..1"),
            ("2.poly", "2.1"),
            (".poly", ".poly.1"),
            ("x.18446744073709551615.poly", "x.18446744073709551615.1"),
            ("x.99999999999999999999.poly", "x.99999999999999999999.1"),
        ] {
            assert_eq!(next_stem(Path::new(path)), Path::new(stem), "{path}");
        }
        assert_eq!(next_file(Path::new("x.1.poly"), "neigh"), Path::new("x.2.neigh"));
    }

    #[cfg(unix)]
    #[test]
    fn names_need_be_no_text() {
        use std::ffi::OsStr;
        use std::os::unix::ffi::OsStrExt;
        let name = Path::new(OsStr::from_bytes(b"\xff.1.poly"));
        assert_eq!(next_stem(name).as_os_str().as_bytes(), b"\xff.2");
    }
}
