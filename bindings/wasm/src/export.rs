//! How functions are exported, and how they answer.

/// Exports functions by their names.
macro_rules! export {
    ($($(#[$meta:meta])* fn $name:ident($($arg:ident: $kind:ty),* $(,)?) -> $out:ty $body:block)*) => {$(
        $(#[$meta])*
        #[expect(unsafe_code, reason = "an exported name; there is one such crate in a module")]
        #[unsafe(no_mangle)]
        pub extern "C" fn $name($($arg: $kind),*) -> $out $body
    )*};
}
