//! Pictures of a run, as SVG text: what a person looks at before the numbers.
//!
//! [`motion`] shows displacement and speed of every body against time;
//! [`aerial_view`] shows flow and bodies from above at about six instants.
//! Both are pure functions of what a run recorded. The texts ask for the
//! generic sans-serif family and leave room for a wider one, so no font has to
//! be installed where the picture is drawn or shown.

mod aerial;
mod canvas;
mod chart;
#[cfg(test)]
mod fixtures;
mod format;
mod motion;
mod outline;
mod palette;
mod surface;
#[cfg(test)]
mod tests;

pub use aerial::aerial_view;
pub use canvas::PictureError;
pub use chart::{Axis, Chart, Curve, Scale};
pub use motion::motion;
