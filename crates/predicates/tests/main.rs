//! All tests of the predicates from outside, in one program.

mod clear;
mod lines;
mod lunes;
mod moved;
mod oracle;
mod orthosphere;
mod power;
mod small_floats;
mod solid;
mod within;
mod within3;
