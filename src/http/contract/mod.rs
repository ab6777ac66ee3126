//! Schemas of the documents that the service passes through without reading them: the solver
//! must not know the service, so its types can't describe themselves. A test checks these
//! schemas against the documents that the solver reads and writes.

mod accuracy;
mod outcome;
mod plan;
mod results;
mod scenario;
mod shape;

pub use accuracy::*;
pub use outcome::*;
pub use plan::*;
pub use results::*;
pub use scenario::*;
pub use shape::*;
