//! Pictures of a run, as SVG text.
//!
//! [`motion`] shows displacement and speed of every body against time;
//! [`aerial_view`] shows flow and bodies in a channel from above at about six instants, and
//! [`terrain_view`] what became of them on a terrain. Bodies have the same
//! colours and numbers in both, and no curve passes through a label.
//! Both are pure functions of the records of a run. The texts use the
//! generic sans-serif family and leave space for a wider font, so no font has to
//! be installed where the picture is drawn or shown.

mod aerial;
mod canvas;
mod chart;
#[cfg(test)]
mod fixtures;
mod format;
mod labels;
mod motion;
mod outline;
mod palette;
mod study;
mod style;
mod surface;
mod terrain;
#[cfg(test)]
mod tests;

pub use aerial::{aerial_view, shown_instants};
pub use canvas::PictureError;
pub use chart::{Axis, Chart, Curve, Scale};
pub use motion::motion;
pub use study::{Column, rest_map, scatter_matrix, tornado};
pub use terrain::{MapsSeen, terrain_view};
