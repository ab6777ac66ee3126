//! The command line as a client of a service elsewhere, which needs nothing here but the binary.

mod address;
mod answer;
mod breakage;
mod client_file;
mod connection;
mod dismiss;
mod get;
mod indented;
mod job;
mod job_files;
mod listing;
mod maps;
mod parting;
mod patience;
mod refusal;
mod secret_file;
mod study;
mod study_files;
mod study_run;
mod submit;
mod terrain;
mod transport;
mod watch;

pub(super) use dismiss::dismiss;
pub(super) use get::get;
pub(super) use study_run::study;
pub(super) use submit::submit;
pub(super) use terrain::put;
pub(super) use watch::watch;
