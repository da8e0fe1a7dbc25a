//! The C interface, called as C calls it.
