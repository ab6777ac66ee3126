//! Shapes of bodies. All that a scenario says of a shape stands here: its variant of [`Shape`],
//! its entry in [`SHAPES`] (name, fields, reader, texts of the contract), and in `sharp_shape.rs` its
//! size and solid.

use super::node::Node;
use super::range::{Rule, rounded_up, short};
use super::reader::{Object, Several};
use super::rules::metres;
use super::sharp_shape::SharpShape;
use crate::shape::RegularSolid;
use serde::{Deserialize, Serialize};
use std::fmt;
use std::ops::RangeInclusive;

/// Shape of a body before it is rounded, as JSON `{"cube": {"side_m": 0.04}}`. The flats are
/// where its faces were. A ball and a capsule are round by themselves.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
#[non_exhaustive]
pub enum Shape {
    /// A cube.
    Cube {
        /// Distance between opposite flats, rounding included [m].
        side_m: f64,
    },
    /// A box, its faces along the axes.
    Box {
        /// Distances between opposite flats, rounding included [m].
        sides_m: [f64; 3],
    },
    /// A regular solid, lying on a face with an edge along y.
    Regular {
        /// The solid.
        solid: RegularSolid,
        /// Length of its edges before they are rounded [m].
        size_m: f64,
    },
    /// The convex hull of some points.
    Polyhedron {
        /// The points, in body axes with any origin [m].
        vertices_m: Vec<[f64; 3]>,
    },
    /// A ball.
    Ball {
        /// Radius [m].
        radius_m: f64,
    },
    /// A capsule along x: a cylinder with a half ball on either end.
    Capsule {
        /// Radius of cylinder and ends [m].
        radius_m: f64,
        /// Length from tip to tip [m].
        length_m: f64,
    },
}

/// One kind of shape, as scenarios name and describe it.
#[derive(Debug, Clone, Copy)]
pub struct ShapeKind {
    /// Its key in a scenario.
    pub name: &'static str,
    /// Description in the contract.
    pub about: &'static str,
    /// Fields of the value under its key.
    pub fields: &'static [ShapeField],
    read: fn(&Object<'_>) -> Option<SharpShape>,
}

/// A field of a shape.
#[derive(Debug, Clone, Copy)]
pub struct ShapeField {
    /// Description in the contract.
    pub about: &'static str,
    /// Type of the value.
    pub value: FieldValue,
    name: FieldName,
}

/// Key of a field: that of its rule, or of a word.
#[derive(Debug, Clone, Copy)]
enum FieldName {
    Ruled(Rule),
    Word(&'static str),
}

/// Type of the value of a shape's field.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum FieldValue {
    /// A number.
    Number,
    /// Three numbers.
    Vector,
    /// From so many to so many points of three numbers.
    Points(usize, usize),
    /// The name of a regular solid.
    RegularSolid,
}

/// Number of points of a polyhedron: rounding may make twice as many faces of them, and four
/// times as many vertices.
pub(super) const POLYHEDRON_VERTICES: RangeInclusive<usize> = 4..=32;
/// Diameter of the smallest ball a polyhedron must contain [m]: a default sphero radius is then
/// not below the smallest allowed.
const LEAST_THICKNESS: f64 = 2e-5;

const CUBE_SIDE: Rule = metres("side_m", 1e-4, 1e2);
const BOX_SIDES: Rule = metres("sides_m", 1e-4, 1e2);
const SOLID: &str = "solid";
const REGULAR_SIZE: Rule = metres("size_m", 1e-4, 1e2);
const VERTICES: Rule = metres("vertices_m", -1e2, 1e2);
const RADIUS: Rule = metres("radius_m", 5e-5, 50.0);
const LENGTH: Rule = metres("length_m", 1e-4, 1e2);

/// All kinds of shapes.
pub const SHAPES: [ShapeKind; 6] = [
    ShapeKind {
        name: "cube",
        about: "A cube.",
        fields: &[ShapeField {
            about: "Distance between opposite faces [m]; rounding does not move them.",
            value: FieldValue::Number,
            name: FieldName::Ruled(CUBE_SIDE),
        }],
        read: |object| {
            let side_m = object.number(&CUBE_SIDE)?;
            sound(Shape::Cube { side_m })
        },
    },
    ShapeKind {
        name: "box",
        about: "A box with its faces along the axes.",
        fields: &[ShapeField {
            about: "Distances between opposite faces [x, y, z] [m]; rounding does not move them.",
            value: FieldValue::Vector,
            name: FieldName::Ruled(BOX_SIDES),
        }],
        read: |object| {
            let sides_m = object.vector(&BOX_SIDES)?;
            sound(Shape::Box { sides_m })
        },
    },
    ShapeKind {
        name: "regular",
        about: "A regular solid that lies on a face, one edge of which runs along y.",
        fields: &[
            ShapeField {
                about: "Kind of solid.",
                value: FieldValue::RegularSolid,
                name: FieldName::Word(SOLID),
            },
            ShapeField {
                about: "Length of its edges before they are rounded [m].",
                value: FieldValue::Number,
                name: FieldName::Ruled(REGULAR_SIZE),
            },
        ],
        read: read_regular,
    },
    ShapeKind {
        name: "polyhedron",
        about: "The convex hull of 4 to 32 points.",
        fields: &[ShapeField {
            about: "Points [x, y, z] whose convex hull is the body before rounding, in body axes with any origin [m].",
            value: FieldValue::Points(*POLYHEDRON_VERTICES.start(), *POLYHEDRON_VERTICES.end()),
            name: FieldName::Ruled(VERTICES),
        }],
        read: read_polyhedron,
    },
    ShapeKind {
        name: "ball",
        about: "A ball. It has no other sphero radius than its own.",
        fields: &[ShapeField {
            about: "Radius [m].",
            value: FieldValue::Number,
            name: FieldName::Ruled(RADIUS),
        }],
        read: |object| {
            let radius_m = object.number(&RADIUS)?;
            sound(Shape::Ball { radius_m })
        },
    },
    ShapeKind {
        name: "capsule",
        about: "A capsule along x: a cylinder with a half ball on either end. It has no other \
                sphero radius than its own.",
        fields: &[
            ShapeField {
                about: "Radius of the cylinder and of its round ends [m].",
                value: FieldValue::Number,
                name: FieldName::Ruled(RADIUS),
            },
            ShapeField {
                about: "Length from tip to tip, along the body's x axis [m]; above twice the radius.",
                value: FieldValue::Number,
                name: FieldName::Ruled(LENGTH),
            },
        ],
        read: read_capsule,
    },
];

/// Names of the regular solids.
pub const REGULAR_SOLIDS: [(&str, RegularSolid); 5] = [
    ("tetrahedron", RegularSolid::Tetrahedron),
    ("cube", RegularSolid::Cube),
    ("octahedron", RegularSolid::Octahedron),
    ("dodecahedron", RegularSolid::Dodecahedron),
    ("icosahedron", RegularSolid::Icosahedron),
];

impl ShapeField {
    /// Its key in a scenario.
    pub fn key(&self) -> &'static str {
        match self.name {
            FieldName::Ruled(rule) => rule.key,
            FieldName::Word(key) => key,
        }
    }

    /// The rule of its numbers; of a word none.
    #[cfg(feature = "schema")]
    pub(super) fn rule(&self) -> Option<Rule> {
        match self.name {
            FieldName::Ruled(rule) => Some(rule),
            FieldName::Word(_) => None,
        }
    }
}

impl Shape {
    /// Radius of a shape that is round by itself [m]; others are rounded by any.
    pub fn own_radius_m(&self) -> Option<f64> {
        match self {
            Self::Ball { radius_m } | Self::Capsule { radius_m, .. } => Some(*radius_m),
            Self::Cube { .. }
            | Self::Box { .. }
            | Self::Regular { .. }
            | Self::Polyhedron { .. } => None,
        }
    }
}

/// The shape in words, for people.
impl fmt::Display for Shape {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Cube { side_m } => write!(f, "cube of {side_m} m"),
            Self::Box { sides_m: [x, y, z] } => write!(f, "box of {x} by {y} by {z} m"),
            Self::Regular { solid, size_m } => {
                let solid = format!("{solid:?}").to_lowercase();
                write!(f, "{solid} with edges of {size_m} m")
            }
            Self::Polyhedron { vertices_m } => {
                write!(f, "polyhedron round {} points", vertices_m.len())
            }
            Self::Ball { radius_m } => write!(f, "ball of {radius_m} m in radius"),
            Self::Capsule { radius_m, length_m } => {
                write!(f, "capsule of {length_m} m, {radius_m} m in radius")
            }
        }
    }
}

/// The shape of a body: an object with the name of one kind.
pub(super) fn read_shape(parent: &Object<'_>) -> Option<SharpShape> {
    let allowed = format!(
        "exactly one of: {}",
        SHAPES.map(|kind| kind.name).join(", ")
    );
    let node = parent.required("shape", &allowed)?;
    let object = parent.object(node, "shape")?;
    if object.members().len() != 1 {
        let why = "must name exactly one shape";
        object.report.refuse(&object.pointer, &allowed, None, why);
        return None;
    }
    let given: Vec<(&ShapeKind, &Node)> = SHAPES
        .iter()
        .filter_map(|kind| Some((kind, object.member(kind.name)?)))
        .collect();
    object.refuse_unknown();
    let (kind, node) = given.into_iter().next()?;
    let object = object.object(node, kind.name)?;
    let shape = (kind.read)(&object);
    object.refuse_unknown();
    shape
}

/// A shape that encloses a volume whatever its numbers are, as long as they are in range.
fn sound(shape: Shape) -> Option<SharpShape> {
    SharpShape::of(shape).ok()
}

fn read_regular(object: &Object<'_>) -> Option<SharpShape> {
    let solid = object.choice(SOLID, &REGULAR_SOLIDS, None);
    let size_m = object.number(&REGULAR_SIZE);
    sound(Shape::Regular {
        solid: solid?,
        size_m: size_m?,
    })
}

/// A polyhedron that encloses something.
fn read_polyhedron(object: &Object<'_>) -> Option<SharpShape> {
    let points = Several::new(POLYHEDRON_VERTICES, ["point", "points"]);
    let vertices_m = object.vectors(&VERTICES, &points)?;
    let why = match SharpShape::of(Shape::Polyhedron { vertices_m }) {
        Ok(sharp) if sharp.size().thickness_m >= LEAST_THICKNESS => return Some(sharp),
        Ok(sharp) => format!(
            "enclose no more than a ball of {} m in diameter",
            short(rounded_up(sharp.size().thickness_m))
        ),
        Err(_) => {
            "enclose nothing: they lie in one plane or line, within 1e-5 of their size".to_owned()
        }
    };
    let pointer = object.pointer_to(VERTICES.key);
    let allowed = format!(
        "points whose convex hull holds a ball of {} m in diameter",
        short(LEAST_THICKNESS)
    );
    object
        .report
        .refuse(&pointer, &allowed, VERTICES.unit, &why);
    None
}

/// A capsule longer than a ball of its radius.
fn read_capsule(object: &Object<'_>) -> Option<SharpShape> {
    let (radius_m, length_m) = (object.number(&RADIUS), object.number(&LENGTH));
    let (radius_m, length_m) = (radius_m?, length_m?);
    let diameter = 2.0 * radius_m;
    if length_m > diameter {
        return sound(Shape::Capsule { radius_m, length_m });
    }
    let why = format!(
        "is {}, not above twice the radius ({}): it includes the round ends",
        short(length_m),
        short(diameter)
    );
    let allowed = format!("{} < x <= 100", short(diameter));
    let pointer = object.pointer_to(LENGTH.key);
    object.report.refuse(&pointer, &allowed, LENGTH.unit, &why);
    None
}
