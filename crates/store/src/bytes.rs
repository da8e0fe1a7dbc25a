//! Bytes in words.

/// Bytes as `--memory` takes them, rounded up.
pub(crate) fn in_words(bytes: u64) -> String {
    if bytes < 1 << 20 {
        return format!("{}K", bytes.div_ceil(1 << 10));
    }
    let megabytes = bytes.div_ceil(1 << 20);
    if megabytes < 10_000 { format!("{megabytes}M") } else { format!("{}G", megabytes.div_ceil(1 << 10)) }
}

#[cfg(test)]
mod tests {
    use super::in_words;

    #[test]
    fn bytes_are_rounded_up() {
        assert_eq!([1, 64 << 20, 20 << 30].map(in_words), ["1K", "64M", "20G"]);
    }
}
