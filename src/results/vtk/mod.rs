//! Export for ParaView, in VTK's XML formats: at each instant points of the flow and surfaces of the
//! bodies (.vtp), and the channel; one set of blocks an instant (.vtm), and the collection that
//! assigns times to these (.pvd).

mod bodies;
mod channel;
mod poly_data;
mod surface;
mod terrain;

use super::interpolation::BodyState;
use bodies::Surfaces;
use poly_data::{Cells, PolyData, Section};
use scree_solver::record::FlowSnapshot;
use scree_solver::scenario::{Ground, Scenario};
use std::fmt::Write as _;

/// A file of the export.
#[derive(Debug)]
pub struct VtkFile {
    /// Its name.
    pub name: String,
    /// Its bytes.
    pub bytes: Vec<u8>,
}

impl VtkFile {
    fn new(name: impl Into<String>, bytes: impl Into<Vec<u8>>) -> Self {
        Self {
            name: name.into(),
            bytes: bytes.into(),
        }
    }
}

/// Scene of an export: what is the same at every instant.
#[derive(Debug)]
pub struct VtkScene {
    surfaces: Surfaces,
    /// Name and surface of the ground.
    ground: (&'static str, Vec<u8>),
}

impl VtkScene {
    /// The scene of a scenario.
    ///
    /// # Panics
    /// If the scenario was not made by the parser.
    pub fn new(scenario: &Scenario) -> Self {
        Self {
            surfaces: Surfaces::of(scenario),
            ground: match &scenario.ground {
                Ground::Channel(channel) => ("channel", channel::channel(scenario, channel)),
                Ground::Terrain(terrain) => ("terrain", terrain::terrain(terrain)),
            },
        }
    }

    /// The files of the whole: the collection of instants at these times [s], and the ground.
    pub fn head(&self, times_s: &[f64]) -> [VtkFile; 2] {
        [
            VtkFile::new("flow.pvd", collection(times_s)),
            VtkFile::new(self.ground_file(), self.ground.1.as_slice()),
        ]
    }

    fn ground_file(&self) -> String {
        format!("{}.vtp", self.ground.0)
    }

    /// The files of the `index`-th instant.
    pub fn instant(
        &self,
        index: usize,
        snapshot: &FlowSnapshot,
        states: &[BodyState],
    ) -> [VtkFile; 3] {
        let [flow, bodies] = ["flow", "bodies"].map(|block| format!("{block}-{index:04}.vtp"));
        let bodies_at = self.surfaces.at(snapshot.time_s, states);
        [
            VtkFile::new(
                instant_name(index),
                blocks(&flow, &bodies, (self.ground.0, &self.ground_file())),
            ),
            VtkFile::new(flow, points(snapshot)),
            VtkFile::new(bodies, bodies_at),
        ]
    }
}

fn instant_name(index: usize) -> String {
    format!("instant-{index:04}.vtm")
}

/// The collection of instants at these times [s].
fn collection(times_s: &[f64]) -> String {
    let mut text = "<?xml version=\"1.0\"?>\n\
                    <VTKFile type=\"Collection\" version=\"1.0\">\n<Collection>\n"
        .to_owned();
    for (index, time_s) in times_s.iter().enumerate() {
        let file = instant_name(index);
        // Writing into a string can't fail.
        let _ = writeln!(
            text,
            "<DataSet timestep=\"{time_s:?}\" part=\"0\" file=\"{file}\"/>"
        );
    }
    text.push_str("</Collection>\n</VTKFile>\n");
    text
}

/// The blocks of an instant.
fn blocks(flow: &str, bodies: &str, ground: (&str, &str)) -> String {
    let block = |(index, (name, file)): (usize, (&str, &str))| {
        format!("<DataSet index=\"{index}\" name=\"{name}\" file=\"{file}\"/>\n")
    };
    let all = [("flow", flow), ("bodies", bodies), ground];
    let all: String = all.into_iter().enumerate().map(block).collect();
    format!(
        "<?xml version=\"1.0\"?>\n\
         <VTKFile type=\"vtkMultiBlockDataSet\" version=\"1.0\">\n<vtkMultiBlockDataSet>\n\
         {all}</vtkMultiBlockDataSet>\n</VTKFile>\n"
    )
}

/// Points of the flow as poly data, each a vertex, with their speed.
fn points(snapshot: &FlowSnapshot) -> Vec<u8> {
    let mut data = PolyData::at(snapshot.time_s);
    let speeds = snapshot.speed_m_s.iter().copied();
    data.add(Section::Point, "speed_m_s", 1, speeds);
    let points = snapshot.position_m.iter().copied();
    let vertices: Vec<_> = (0..points.len() as i32).map(|point| [point]).collect();
    data.finish(points, Cells::Vertices, &vertices)
}
