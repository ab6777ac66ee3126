//! Snapshots of the flow for ParaView: VTK's XML format of points (.vtp), and
//! the collection that assigns times to them (.pvd).

use scree_solver::record::FlowSnapshot;
use std::fmt::{Display, Write as _};

/// Name of the `index`-th snapshot's file.
pub fn file_name(index: usize) -> String {
    format!("flow-{index:04}.vtp")
}

/// A snapshot as poly data: its points, each a vertex, with their speed.
pub fn vtp(snapshot: &FlowSnapshot) -> String {
    let count = snapshot.position_m.len();
    let mut text = format!(
        "<?xml version=\"1.0\"?>\n\
         <VTKFile type=\"PolyData\" version=\"1.0\" byte_order=\"LittleEndian\">\n<PolyData>\n\
         <FieldData>\n\
         <DataArray type=\"Float64\" Name=\"TimeValue\" NumberOfTuples=\"1\" format=\"ascii\">{:?}</DataArray>\n\
         </FieldData>\n\
         <Piece NumberOfPoints=\"{count}\" NumberOfVerts=\"{count}\" NumberOfLines=\"0\" \
         NumberOfStrips=\"0\" NumberOfPolys=\"0\">\n",
        snapshot.time_s
    );
    text.push_str("<PointData Scalars=\"speed_m_s\">\n");
    array(
        &mut text,
        "Float32\" Name=\"speed_m_s",
        snapshot.speed_m_s.iter(),
    );
    text.push_str("</PointData>\n<Points>\n");
    let coordinates = snapshot.position_m.iter().flatten();
    array(
        &mut text,
        "Float32\" Name=\"position_m\" NumberOfComponents=\"3",
        coordinates,
    );
    text.push_str("</Points>\n<Verts>\n");
    array(&mut text, "Int64\" Name=\"connectivity", 0..count);
    array(&mut text, "Int64\" Name=\"offsets", 1..=count);
    text.push_str("</Verts>\n</Piece>\n</PolyData>\n</VTKFile>\n");
    text
}

/// The collection of snapshots at these times [s], in files named by
/// [`file_name`].
pub fn pvd(times_s: &[f64]) -> String {
    let mut text = "<?xml version=\"1.0\"?>\n\
                    <VTKFile type=\"Collection\" version=\"1.0\">\n<Collection>\n"
        .to_owned();
    for (index, time_s) in times_s.iter().enumerate() {
        // Writing into a string can't fail.
        let _ = writeln!(
            text,
            "<DataSet timestep=\"{time_s:?}\" part=\"0\" file=\"{}\"/>",
            file_name(index)
        );
    }
    text.push_str("</Collection>\n</VTKFile>\n");
    text
}

fn array(text: &mut String, kind: &str, numbers: impl Iterator<Item = impl Display>) {
    let _ = write!(text, "<DataArray type=\"{kind}\" format=\"ascii\">");
    for number in numbers {
        let _ = write!(text, "{number} ");
    }
    text.push_str("</DataArray>\n");
}
