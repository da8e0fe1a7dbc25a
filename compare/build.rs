//! Builds the shims of CGAL and Voro++ where their headers are installed (Debian: `libcgal-dev`, `voro++-dev`), and says so to the program.

use std::path::Path;

fn main() {
    println!("cargo::rustc-check-cfg=cfg(cgal)");
    println!("cargo::rerun-if-changed=src/cgal.cpp");
    println!("cargo::rerun-if-changed=/usr/include/CGAL");
    if Path::new("/usr/include/CGAL/Delaunay_triangulation_2.h").exists() {
        println!("cargo::rerun-if-changed=src/cgal_constrained.cpp");
        println!("cargo::rerun-if-changed=src/cgal_mesh.cpp");
        println!("cargo::rerun-if-changed=src/cgal_periodic.cpp");
        println!("cargo::rerun-if-changed=src/cgal_weights.cpp");
        cc::Build::new()
            .cpp(true)
            .std("c++17")
            .opt_level(3)
            .define("NDEBUG", None)
            .warnings(false)
            .file("src/cgal.cpp")
            .file("src/cgal_constrained.cpp")
            .file("src/cgal_mesh.cpp")
            .file("src/cgal_periodic.cpp")
            .file("src/cgal_weights.cpp")
            .compile("cgal_shim");
        println!("cargo::rustc-cfg=cgal");
        println!("cargo::rustc-link-lib=gmp");
        println!("cargo::rustc-link-lib=mpfr");
    }
    println!("cargo::rustc-check-cfg=cfg(voro)");
    println!("cargo::rerun-if-changed=src/voro.cpp");
    println!("cargo::rerun-if-changed=/usr/include/voro++");
    if Path::new("/usr/include/voro++/voro++.hh").exists() {
        cc::Build::new().cpp(true).opt_level(3).warnings(false).file("src/voro.cpp").compile("voro_shim");
        println!("cargo::rustc-cfg=voro");
        println!("cargo::rustc-link-lib=voro++");
    }
}
