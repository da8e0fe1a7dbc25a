//! Limits of a run: memory, as much as there is when it begins or as the user says; points and bytes of output, as the user says.

use std::fs;
use std::path::Path;
use std::sync::atomic::{AtomicUsize, Ordering};

use crate::memory;
use crate::message::{Failure, grouped};

/// Points that the input may have.
static MOST_POINTS: AtomicUsize = AtomicUsize::new(usize::MAX);

/// Sets the limits: bytes of memory, points, bytes of outputs.
pub(crate) fn start(memory: Option<u64>, points: Option<usize>, output: Option<u64>) {
    if let Some(bytes) = memory.or_else(available) {
        memory::limit(bytes, memory.is_some());
    }
    // Who says how much memory there is says so of what is inflated too.
    delone_io::trust_compressed(memory.is_some());
    output.into_iter().for_each(delone_io::limit_output);
    MOST_POINTS.store(points.unwrap_or(usize::MAX), Ordering::Relaxed);
}

/// Refuses more points than the limit.
pub(crate) fn check_points(count: usize, from: &Path) -> Result<(), Failure> {
    let most = MOST_POINTS.load(Ordering::Relaxed);
    if count <= most {
        return Ok(());
    }
    let what = format!(
        "{}: {} points so far, and --max-points allows {}",
        from.display(),
        grouped(count as u64),
        grouped(most as u64)
    );
    Err(Failure::new(what, "allow more, or give fewer points"))
}

/// Bytes that the system has left, swap included, and that the control groups of this process may have. None on other systems than Linux.
fn available() -> Option<u64> {
    let about = fs::read_to_string("/proc/meminfo").ok()?;
    let machine = field(&about, "MemAvailable:")?.saturating_add(field(&about, "SwapFree:").unwrap_or(0));
    let groups = fs::read_to_string("/proc/self/cgroup").unwrap_or_default();
    Some(groups.lines().filter_map(group_limit).fold(machine, u64::min))
}

/// A field of `/proc/meminfo`, which is in units of 1,024 bytes.
fn field(about: &str, name: &str) -> Option<u64> {
    let rest = about.lines().find_map(|line| line.strip_prefix(name))?;
    rest.trim().strip_suffix("kB")?.trim().parse::<u64>().ok()?.checked_mul(1024)
}

/// The least that a control group and those around it may have: of version 2, a line `0::/path`, or of version 1, `N:memory:/path`.
fn group_limit(line: &str) -> Option<u64> {
    let (controllers, path) = line.split_once(':')?.1.split_once(':')?;
    let (root, file) = match controllers {
        "" => ("/sys/fs/cgroup", "memory.max"),
        _ if controllers.split(',').any(|name| name == "memory") => {
            ("/sys/fs/cgroup/memory", "memory.limit_in_bytes")
        }
        _ => return None,
    };
    let limit = |group: &Path| {
        let at = Path::new(root).join(group).join(file);
        fs::read_to_string(at).ok()?.trim().parse::<u64>().ok()
    };
    Path::new(path.trim_start_matches('/')).ancestors().filter_map(limit).min()
}

#[cfg(test)]
mod tests {
    use super::{available, field};

    #[test]
    fn fields_are_read() {
        let about = "MemTotal:       16384 kB\nMemAvailable:    2048 kB\nSwapFree:              0 kB\n";
        assert_eq!((field(about, "MemAvailable:"), field(about, "SwapFree:")), (Some(2 << 20), Some(0)));
        assert_eq!((field(about, "Swap:"), field("MemAvailable: x kB", "MemAvailable:")), (None, None));
        if cfg!(target_os = "linux") {
            assert!(available().is_some_and(|bytes| bytes > 1 << 24));
        }
    }
}
