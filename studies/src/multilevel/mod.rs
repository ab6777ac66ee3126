//! Multilevel estimates (Giles 2008, 2015) with nested levels (Peherstorfer, Willcox & Gunzburger
//! 2016): all members on the coarsest level, the first of them on finer ones, too. What a member
//! would have been on the finest level follows from its own finest run and from how the pairs of
//! neighbouring levels differ.

mod allocation;
mod correction;
mod estimate;
mod forecast;
mod known;
mod next;
mod regression;
mod selection;
mod student;

pub(crate) use correction::Corrected;
pub(crate) use estimate::{LevelMeans, MeanError};
pub use forecast::{Forecast, ForecastLevel};
pub(crate) use known::Known;
pub use next::{Needed, NextStep};
pub(crate) use next::{Progress, costs};
