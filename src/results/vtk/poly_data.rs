//! VTK's XML format of surfaces and points (.vtp), in binary: a head in XML that describes the
//! arrays, and their numbers behind it, in little endian.

use std::fmt::Write as _;

/// A number of an array.
pub(super) trait Number: Copy {
    /// VTK's name of its type.
    const TYPE: &'static str;

    /// Appends it.
    fn put(self, out: &mut Vec<u8>);
}

macro_rules! numbers {
    ($($kind:ty = $name:literal),+) => {
        $(impl Number for $kind {
            const TYPE: &'static str = $name;

            fn put(self, out: &mut Vec<u8>) {
                out.extend(self.to_le_bytes());
            }
        })+
    };
}

numbers!(
    u8 = "UInt8",
    i32 = "Int32",
    f32 = "Float32",
    f64 = "Float64"
);

/// Kind of cells.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Cells {
    /// One at each point.
    Vertices,
    /// Polygons.
    Polygons,
}

/// Part of a file that arrays belong to, in the order of the file.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Section {
    /// The whole.
    Field,
    /// Each point.
    Point,
    /// Each cell.
    Cell,
}

/// A file under construction.
#[derive(Debug, Default)]
pub(super) struct PolyData {
    /// Descriptions of the arrays of each section.
    heads: [String; 3],
    /// All arrays, each after its length.
    numbers: Vec<u8>,
}

impl PolyData {
    /// A file without points, of this simulated time [s].
    pub(super) fn at(time_s: f64) -> Self {
        let mut data = Self::default();
        data.add(Section::Field, "TimeValue", 1, [time_s]);
        data
    }

    /// Adds an array; of several components, those of one entry follow each other.
    pub(super) fn add<T: Number>(
        &mut self,
        section: Section,
        name: &str,
        components: usize,
        numbers: impl IntoIterator<Item = T>,
    ) {
        let count = match section {
            Section::Field => Some(components),
            Section::Point | Section::Cell => None,
        };
        let head = self.append(name, (components, count), numbers);
        self.heads[section as usize].push_str(&head);
    }

    /// The file with these points [m] and cells, by the points of each.
    pub(super) fn finish(
        mut self,
        points: impl ExactSizeIterator<Item = [f32; 3]>,
        kind: Cells,
        cells: &[impl AsRef<[i32]>],
    ) -> Vec<u8> {
        let count = points.len();
        let points = self.append("position_m", (3, None), points.flatten());
        let corners = cells.iter().flat_map(|cell| cell.as_ref()).copied();
        let corners = self.append("connectivity", (1, None), corners);
        let mut end = 0;
        let ends = cells.iter().map(|cell| {
            end += cell.as_ref().len() as i32;
            end
        });
        let ends = self.append("offsets", (1, None), ends);
        let (vertices, polygons, element) = match kind {
            Cells::Vertices => (cells.len(), 0, "Verts"),
            Cells::Polygons => (0, cells.len(), "Polys"),
        };
        let [field, point, cell] = &self.heads;
        let mut file = format!(
            "<?xml version=\"1.0\"?>\n\
             <VTKFile type=\"PolyData\" version=\"1.0\" byte_order=\"LittleEndian\" header_type=\"UInt32\">\n\
             <PolyData>\n<FieldData>\n{field}</FieldData>\n\
             <Piece NumberOfPoints=\"{count}\" NumberOfVerts=\"{vertices}\" NumberOfLines=\"0\" \
             NumberOfStrips=\"0\" NumberOfPolys=\"{polygons}\">\n\
             <PointData>\n{point}</PointData>\n<CellData>\n{cell}</CellData>\n\
             <Points>\n{points}</Points>\n<{element}>\n{corners}{ends}</{element}>\n\
             </Piece>\n</PolyData>\n<AppendedData encoding=\"raw\">\n_"
        )
        .into_bytes();
        file.append(&mut self.numbers);
        file.extend(b"\n</AppendedData>\n</VTKFile>\n");
        file
    }

    /// Appends an array, and returns its description.
    fn append<T: Number>(
        &mut self,
        name: &str,
        (components, tuples): (usize, Option<usize>),
        numbers: impl IntoIterator<Item = T>,
    ) -> String {
        let start = self.numbers.len();
        self.numbers.extend([0; 4]);
        for number in numbers {
            number.put(&mut self.numbers);
        }
        let bytes = self.numbers.len() - start - 4;
        self.numbers[start..start + 4].copy_from_slice(&(bytes as u32).to_le_bytes());
        let mut head = format!("<DataArray type=\"{}\" Name=\"{name}\" ", T::TYPE);
        // Writing into a string can't fail.
        let _ = match tuples {
            Some(_) => write!(
                head,
                "NumberOfTuples=\"{}\" ",
                bytes / size_of::<T>() / components
            ),
            None => Ok(()),
        };
        let _ = writeln!(
            head,
            "NumberOfComponents=\"{components}\" format=\"appended\" offset=\"{start}\"/>"
        );
        head
    }
}
