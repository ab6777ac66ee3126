//! The documents that the service hands through without looking inside, as the
//! contract describes them: the solver must not know the service, so its types
//! can't describe themselves. A test holds these against what the solver reads
//! and writes.

mod accuracy;
mod outcome;
mod plan;
mod results;
mod scenario;

pub use accuracy::*;
pub use outcome::*;
pub use plan::*;
pub use results::*;
pub use scenario::*;
