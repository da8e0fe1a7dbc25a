//! Signals that end the program: nothing half-written is left.

/// Removes temporary files when the program is told to end, and lets it end as that signal does.
#[cfg(unix)]
pub(crate) fn clean_up() {
    use std::sync::Arc;

    use signal_hook::consts::{SIGHUP, SIGINT, SIGQUIT, SIGTERM, SIGXCPU, SIGXFSZ};
    use signal_hook::iterator::Signals;
    use signal_hook::low_level::emulate_default_handler;

    // Then a file that may not grow any more is an error of its writer.
    _ = signal_hook::flag::register(SIGXFSZ, Arc::default());
    // A signal that is ignored stays so: under nohup the program goes on after a hangup.
    let wanted =
        [SIGINT, SIGTERM, SIGHUP, SIGQUIT, SIGXCPU].into_iter().filter(|&signal| !is_ignored(signal));
    let Ok(mut signals) = Signals::new(wanted) else { return };
    let watch = move || {
        for signal in signals.forever() {
            delone_io::remove_unfinished();
            _ = emulate_default_handler(signal);
        }
    };
    // Without a thread for it, signals end the program as before.
    _ = std::thread::Builder::new().name("signals".to_owned()).spawn(watch);
}

/// Whether whoever started the program had this signal ignored, as Linux tells; elsewhere hangups are left alone.
#[cfg(unix)]
fn is_ignored(signal: i32) -> bool {
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let mask = status.lines().find_map(|line| line.strip_prefix("SigIgn:"));
    match mask.and_then(|mask| u64::from_str_radix(mask.trim(), 16).ok()) {
        Some(mask) => mask >> (signal - 1) & 1 == 1,
        None => signal == signal_hook::consts::SIGHUP,
    }
}

#[cfg(not(unix))]
pub(crate) fn clean_up() {}
