//! Files of a study: members as a table, resting places as maps, pictures.

mod geojson;
mod geotiff;
mod table;

pub use geojson::rest_as_geojson;
pub use geotiff::density_as_geotiff;
pub use table::{MemberTable, members_as_csv, members_as_npz};

use crate::pictures::{self, PictureError};
use scree_solver::scenario::Scenario;
use scree_studies::answers::{Answer, Measures, RestDistribution, RestingPlaces};
use scree_studies::{Answers, Ensemble, Member, Question, Study};
use thiserror::Error;

/// A file that can't be made.
#[derive(Debug, Error)]
pub enum ExportError {
    /// A picture.
    #[error(transparent)]
    Picture(#[from] PictureError),
    /// An image.
    #[error("the density can't be written as TIFF: {0}")]
    Tiff(#[from] tiff::TiffError),
}

/// All files of a study by name: `members.csv`, `members.npz`, and for each question about a
/// resting place or sensitivity a picture and a map, numbered by the question.
///
/// # Errors
/// A picture or an image can't be made.
pub fn files(
    ensemble: &Ensemble,
    members: &[Member],
    answers: &Answers,
) -> Result<Vec<(String, Vec<u8>)>, ExportError> {
    let table = MemberTable::of(ensemble, members);
    let mut files = vec![
        ("members.csv".to_owned(), members_as_csv(&table).into()),
        ("members.npz".to_owned(), members_as_npz(&table)),
        ("scatter.svg".to_owned(), scatter(ensemble, members)?.into()),
    ];
    for (place, answer) in answers.answers.iter().enumerate() {
        match answer {
            Answer::Rest(rest) => {
                let geojson = rest_as_geojson(rest).to_string();
                files.push((format!("rest-{place}.geojson"), geojson.into()));
                if let Some(density) = &rest.density {
                    let image = density_as_geotiff(density)?;
                    files.push((format!("rest-{place}.tif"), image));
                }
                let map = map(ensemble, members, (place, rest))?;
                files.push((format!("rest-{place}.svg"), map.into()));
            }
            Answer::Sensitivity(Some(measures)) => {
                let picture = tornado(ensemble.study(), (place, measures))?;
                files.push((format!("sensitivity-{place}.svg"), picture.into()));
            }
            _ => {}
        }
    }
    Ok(files)
}

/// Quantities that are drawn against the inputs: of the run, and of the first body.
const DRAWN: [&str; 4] = [
    "runout_m",
    "body0.displacement_m",
    "body0.rest_y_m",
    "body0.peak_speed_m_s",
];

/// Picture of quantities of the members, each on its finest level, against their inputs.
///
/// # Errors
/// The picture can't be drawn.
pub fn scatter(ensemble: &Ensemble, members: &[Member]) -> Result<String, PictureError> {
    let table = MemberTable::on_finest(ensemble, members);
    let inputs = table.inputs.iter().enumerate();
    let inputs: Vec<_> = inputs
        .map(|(place, name)| (name.clone(), table.input(place)))
        .collect();
    let drawn = DRAWN.iter().filter_map(|name| {
        let place = table.quantities.iter().position(|other| other == name)?;
        Some(((*name).to_owned(), table.quantity(place)))
    });
    let title = &ensemble.study().title;
    pictures::scatter_matrix(title, &inputs, &drawn.collect::<Vec<_>>())
}

/// Map of the resting places of a question, on the finest level.
///
/// # Errors
/// The picture can't be drawn.
pub fn map(
    ensemble: &Ensemble,
    members: &[Member],
    (place, rest): (usize, &RestDistribution),
) -> Result<String, PictureError> {
    let study = ensemble.study();
    let body = match study.questions.get(place) {
        Some(Question::Rest(question)) => question.body,
        _ => 0,
    };
    let places = RestingPlaces::of(ensemble, members, body).places_m;
    let scenario = Scenario::from_value(&study.scenario).ok();
    pictures::rest_map(&study.title, scenario.as_ref(), body, (rest, &places))
}

/// Picture of the sensitivities of a question.
///
/// # Errors
/// The picture can't be drawn.
pub fn tornado(
    study: &Study,
    (place, measures): (usize, &Measures),
) -> Result<String, PictureError> {
    let quantity = match study.questions.get(place) {
        Some(Question::Sensitivity(question)) => question.quantity.as_str(),
        _ => "",
    };
    let inputs: Vec<&str> = study
        .inputs
        .iter()
        .map(|input| input.pointer.as_str())
        .collect();
    pictures::tornado((&study.title, quantity), &inputs, measures)
}
