//! A fence around decoders that others wrote: what they panic about becomes an error.
//!
//! Lengths are checked before a decoder sees them; this is for what remains.

use std::any::Any;
use std::cell::Cell;
use std::panic::{self, AssertUnwindSafe};
use std::sync::Once;

use crate::Error;

thread_local! {
    /// Whether a panic on this thread is caught here, and nobody needs to hear of it.
    static FENCED: Cell<bool> = const { Cell::new(false) };
}

/// Runs a decoder; its panics are errors of the file.
pub(crate) fn decode<T>(format: &str, work: impl FnOnce() -> Result<T, Error>) -> Result<T, Error> {
    static HOOK: Once = Once::new();
    HOOK.call_once(|| {
        let before = panic::take_hook();
        panic::set_hook(Box::new(move |about| {
            if !FENCED.get() {
                before(about);
            }
        }));
    });
    let outer = FENCED.replace(true);
    let outcome = panic::catch_unwind(AssertUnwindSafe(work));
    FENCED.set(outer);
    outcome.unwrap_or_else(|panic| {
        let what = message(panic.as_ref());
        Err(Error::content(format!("{format}: the data contradict themselves ({what})")))
    })
}

fn message(panic: &(dyn Any + Send)) -> &str {
    let text = panic.downcast_ref::<&str>().copied();
    text.or_else(|| panic.downcast_ref::<String>().map(String::as_str)).unwrap_or("the decoder gave up")
}

#[cfg(test)]
mod tests {
    use super::decode;
    use crate::Error;

    #[test]
    fn panics_become_errors_and_values_pass() {
        assert_eq!(decode("X", || Ok(7)).expect("a value"), 7);
        let broken: Result<(), Error> = decode("X", || panic!("index {}", 3));
        assert_eq!(broken.unwrap_err().to_string(), "X: the data contradict themselves (index 3)");
    }
}
