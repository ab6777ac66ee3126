//! Scenarios from code. What a builder is told becomes the JSON of the scenario, which is then
//! read like any other: defaults, ranges and refusals are the same.

use super::{Motion, Precision, Scenario, ScenarioError, Shape};
use serde::Serialize;
use serde_json::{Value, json};

/// A scenario in the making.
///
/// ```
/// use scree_solver::scenario::{BodyBuilder, Scenario};
///
/// let scenario = Scenario::builder(40.0, 1.0, 2.0)
///     .flow(0.01)
///     .body(BodyBuilder::cube(0.04).at(0.3, 0.0).density(2600.0))
///     .body(BodyBuilder::ball(0.03).at(0.6, 0.05))
///     .duration(2.0)
///     .build()?;
/// assert_eq!(scenario.bodies.len(), 2);
/// assert_eq!(scenario.channel().map(|channel| channel.width_m), Some(0.2));
/// # Ok::<(), scree_solver::ScenarioError>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
#[must_use = "a builder makes nothing before `build`"]
pub struct ScenarioBuilder {
    document: Value,
}

/// A body in the making.
#[derive(Debug, Clone, PartialEq)]
#[must_use = "a body is part of a scenario once `ScenarioBuilder::body` is given it"]
pub struct BodyBuilder {
    document: Value,
}

impl Scenario {
    /// A builder with a channel: inclination \[°\], and horizontal lengths of incline and floor
    /// [m]. There is no flow and no body yet.
    pub fn builder(
        inclination_deg: f64,
        incline_length_m: f64,
        runout_length_m: f64,
    ) -> ScenarioBuilder {
        ScenarioBuilder {
            document: json!({
                "channel": {
                    "inclination_deg": inclination_deg,
                    "incline_length_m": incline_length_m,
                    "runout_length_m": runout_length_m,
                },
                "flow": null,
                "bodies": [],
            }),
        }
    }
}

impl ScenarioBuilder {
    /// Distance between the side walls [m].
    pub fn width(self, width_m: f64) -> Self {
        self.set("/channel/width_m", width_m)
    }

    /// A flow of this volume [m³].
    pub fn flow(self, volume_m3: f64) -> Self {
        self.set("/flow/volume_m3", volume_m3)
    }

    /// Thickness of the release and distance of its front from the foot of the incline [m].
    pub fn release(self, height_m: f64, toe_distance_m: f64) -> Self {
        self.set("/flow/release/height_m", height_m)
            .set("/flow/release/toe_distance_m", toe_distance_m)
    }

    /// Friction of the granular material at rest and at large inertial number.
    pub fn flow_friction(self, at_rest: f64, limiting: f64) -> Self {
        self.set("/flow/material/static_friction", at_rest)
            .set("/flow/material/limiting_friction", limiting)
    }

    /// A further body.
    pub fn body(mut self, body: BodyBuilder) -> Self {
        if let Some(Value::Array(bodies)) = self.document.get_mut("bodies") {
            bodies.push(body.document);
        }
        self
    }

    /// Simulated time [s].
    pub fn duration(self, duration_s: f64) -> Self {
        self.set("/duration_s", duration_s)
    }

    /// Cell size [m].
    pub fn cell_size(self, cell_size_m: f64) -> Self {
        self.set("/numerics/cell_size_m", cell_size_m)
    }

    /// Precision of points and grid.
    pub fn precision(self, precision: Precision) -> Self {
        self.set("/numerics/precision", precision)
    }

    /// Every quantity of the outcome with an uncertainty interval.
    pub fn error_bars(self) -> Self {
        self.set("/accuracy/error_bars", true)
    }

    /// Any field, by its JSON pointer: `"/flow/material/grain_diameter_m"`. Objects on the way are
    /// made.
    pub fn set(mut self, pointer: &str, value: impl Serialize) -> Self {
        set(&mut self.document, pointer, value);
        self
    }

    /// The scenario, with every default filled in.
    ///
    /// # Errors
    /// All values outside their ranges and all that don't go together, each by its field.
    pub fn build(&self) -> Result<Scenario, ScenarioError> {
        Scenario::from_value(&self.document)
    }

    /// The JSON document told so far, as the service takes it.
    pub fn document(&self) -> &Value {
        &self.document
    }
}

impl BodyBuilder {
    /// A body of any shape.
    pub fn new(shape: &Shape) -> Self {
        let document = json!({});
        Self { document }.set("/shape", shape)
    }

    /// A cube with flats this far apart [m].
    pub fn cube(side_m: f64) -> Self {
        Self::new(&Shape::Cube { side_m })
    }

    /// A box with flats this far apart along x, y and z [m].
    pub fn cuboid(sides_m: [f64; 3]) -> Self {
        Self::new(&Shape::Box { sides_m })
    }

    /// A ball of this radius [m].
    pub fn ball(radius_m: f64) -> Self {
        Self::new(&Shape::Ball { radius_m })
    }

    /// The convex hull of some points [m].
    pub fn hull(vertices_m: Vec<[f64; 3]>) -> Self {
        Self::new(&Shape::Polyhedron { vertices_m })
    }

    /// x and y of the centre of mass [m]; the body lies on the bed there.
    pub fn at(self, downstream_m: f64, lateral_m: f64) -> Self {
        self.set("/position/downstream_m", downstream_m)
            .set("/position/lateral_m", lateral_m)
    }

    /// z of the centre of mass [m], for a body that does not start on the bed.
    pub fn elevation(self, elevation_m: f64) -> Self {
        self.set("/position/elevation_m", elevation_m)
    }

    /// Density [kg/m³].
    pub fn density(self, density_kg_m3: f64) -> Self {
        self.set("/density_kg_m3", density_kg_m3)
    }

    /// Coulomb friction with walls and other bodies, and with the flow.
    pub fn friction(self, with_walls: f64, with_flow: f64) -> Self {
        self.set("/friction", with_walls)
            .set("/flow_friction", with_flow)
    }

    /// Velocity of the centre at the start [m/s].
    pub fn velocity(self, velocity_m_s: [f64; 3]) -> Self {
        self.set("/velocity_m_s", velocity_m_s)
    }

    /// A fixed body: a barrier.
    pub fn fixed(self) -> Self {
        self.set("/fixed", true)
    }

    /// Prescribed motion.
    pub fn motion(self, motion: &Motion) -> Self {
        self.set("/motion", motion)
    }

    /// Any field, by its JSON pointer within the body.
    pub fn set(mut self, pointer: &str, value: impl Serialize) -> Self {
        set(&mut self.document, pointer, value);
        self
    }
}

/// Sets a field. A value that has no JSON, such as NaN, becomes null, and an entry that is not
/// there an unknown field: both are refused by `build`.
fn set(document: &mut Value, pointer: &str, value: impl Serialize) {
    let value = serde_json::to_value(value).unwrap_or(Value::Null);
    let keys: Vec<&str> = pointer.split('/').skip(1).collect();
    match place(document, &keys) {
        Some(place) => *place = value,
        None => document[pointer] = value,
    }
}

/// The place of a field; objects on the way are made, entries of lists are not.
fn place<'a>(here: &'a mut Value, keys: &[&str]) -> Option<&'a mut Value> {
    let Some((key, rest)) = keys.split_first() else {
        return Some(here);
    };
    let next = match here {
        Value::Array(items) => items.get_mut(key.parse::<usize>().ok()?)?,
        Value::Object(members) => members.entry(*key).or_insert(Value::Null),
        other => {
            *other = json!({ *key: null });
            other.get_mut(*key)?
        }
    };
    place(next, rest)
}
