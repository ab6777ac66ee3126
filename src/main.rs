//! The command line of Scree.

fn main() {}
