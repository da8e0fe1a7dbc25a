//! The name that programs are linked with, and no unloading: threads of the library live as long as the process.

fn main() {
    println!("cargo:rerun-if-changed=build.rs");
    let of = |name: &str| std::env::var(name).unwrap_or_default();
    if of("CARGO_CFG_TARGET_OS") == "linux" {
        println!("cargo:rustc-cdylib-link-arg=-Wl,-soname,libdelone.so.0");
        println!("cargo:rustc-cdylib-link-arg=-Wl,-z,nodelete");
    } else if of("CARGO_CFG_TARGET_VENDOR") == "apple" {
        println!("cargo:rustc-cdylib-link-arg=-Wl,-install_name,@rpath/libdelone.0.dylib");
    }
}
