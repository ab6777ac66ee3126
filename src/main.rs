//! Scree: service and command line.
fn main() {}
