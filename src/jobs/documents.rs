//! Documents that the service stores and passes on: their types, from which the contract is made.

pub use super::forecast::PlannedRefinementRun;
pub use scree_solver::plan::Plan;
pub use scree_solver::record::Outcome;
pub use scree_solver::scenario::Scenario;
pub use scree_solver::schema::complete;
