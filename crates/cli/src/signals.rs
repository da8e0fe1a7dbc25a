//! Signals that end the program: nothing half-written is left.

/// Removes temporary files when the program is told to end, and lets it end as that signal does.
#[cfg(unix)]
pub(crate) fn clean_up() {
    use signal_hook::consts::{SIGHUP, SIGINT, SIGTERM};
    use signal_hook::iterator::Signals;
    use signal_hook::low_level::emulate_default_handler;

    // Whoever asked to ignore hangups (nohup) is not asked again: the program would end where it should go on.
    let Ok(mut signals) = Signals::new([SIGINT, SIGTERM, SIGHUP]) else { return };
    let watch = move || {
        for signal in signals.forever() {
            delone_io::remove_unfinished();
            _ = emulate_default_handler(signal);
        }
    };
    // Without a thread for it, signals end the program as before.
    _ = std::thread::Builder::new().name("signals".to_owned()).spawn(watch);
}

#[cfg(not(unix))]
pub(crate) fn clean_up() {}
