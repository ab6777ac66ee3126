//! Parser from JSON to a validated scenario, with all violations at once.

use super::accuracy::{
    bands_can_be_made, body_is_there, cells_are_chosen_once, read_accuracy,
    target_is_about_something,
};
use super::agreement::{
    Course, flow_is_stiff_enough, samples_are_bounded, stiffness_is_given_once,
};
use super::body::read_bodies;
use super::duration::{WITHOUT_FLOW, default_duration};
use super::fit;
use super::node::Node;
use super::on_terrain;
use super::reader::Object;
use super::report::Report;
use super::rules::{
    DURATION, FLOW_SNAPSHOT_POINTS, FLOW_SNAPSHOTS, GRAVITY, SAMPLE_INTERVAL, VALUES,
};
use super::sections::{read_channel, read_flow, read_numerics, read_title};
use super::terrain_sections::{maps_named, read_releases, read_terrain};
use super::{
    Accuracy, Body, Flow, Ground, Maps, NamedMap, Numerics, Scenario, ScenarioError, Source,
};
use serde_json::Value;

impl Scenario {
    /// Reads a scenario from its JSON text.
    ///
    /// # Errors
    /// The text is no JSON, or violates rules of `docs/scenario.md`: then all
    /// violations are listed, in document order.
    pub fn from_json(text: &str) -> Result<Self, ScenarioError> {
        Self::from_json_with(text, &Maps::default())
    }

    /// Reads a scenario from its JSON text, with the maps that it may name.
    ///
    /// # Errors
    /// As for [`Self::from_json`], and a map that is not among these.
    pub fn from_json_with(text: &str, maps: &Maps) -> Result<Self, ScenarioError> {
        from_node(&Node::parse(text)?, maps)
    }

    /// The maps that a scenario's JSON text names, in its order; whatever else is wrong with it is
    /// left to [`Self::from_json_with`].
    ///
    /// # Errors
    /// The text is no JSON.
    pub fn maps_named(text: &str) -> Result<Vec<NamedMap>, ScenarioError> {
        Ok(maps_named(&Node::parse(text)?))
    }

    /// The scenario with these maps: one that was stored has their names alone.
    #[must_use]
    pub fn with_maps(mut self, maps: &Maps) -> Self {
        if let Ground::Terrain(terrain) = &mut self.ground {
            terrain.maps = maps.clone();
        }
        self
    }

    /// Reads a scenario from a JSON value. A [`Value`] keeps neither repeated
    /// keys nor, usually, the order of the document: [`Self::from_json`] does.
    ///
    /// # Errors
    /// As for [`Self::from_json`].
    pub fn from_value(value: &Value) -> Result<Self, ScenarioError> {
        Self::from_value_with(value, &Maps::default())
    }

    /// Reads a scenario from a JSON value, with the maps that it may name.
    ///
    /// # Errors
    /// As for [`Self::from_json_with`].
    pub fn from_value_with(value: &Value, maps: &Maps) -> Result<Self, ScenarioError> {
        from_node(&Node::from(value), maps)
    }

    /// The scenario as JSON with every default filled in; reading it gives the
    /// same scenario, bit for bit.
    pub fn to_json(&self) -> String {
        // Numbers, texts and lists have a JSON form; nothing here can fail.
        serde_json::to_string(self).expect("a scenario is JSON")
    }
}

fn from_node(document: &Node, maps: &Maps) -> Result<Scenario, ScenarioError> {
    let report = Report::default();
    let draft = if document.count() <= VALUES {
        Object::open(document, String::new(), &report).map(|object| Draft::read(&object, maps))
    } else {
        let allowed = format!("at most {VALUES} JSON values");
        report.refuse("", &allowed, None, "is too large to be one");
        None
    };
    if let Some(draft) = &draft {
        draft.check(&report);
    }
    let mut scenario = draft.and_then(Draft::finish);
    if let Some(scenario) = scenario.as_mut().filter(|_| report.is_empty()) {
        on_terrain::finish(&report, scenario, document.get(DURATION.key).is_some());
    }
    let violations = report.into_violations(document);
    match scenario {
        Some(scenario) if violations.is_empty() => Ok(scenario),
        _ => Err(ScenarioError::Invalid(violations)),
    }
}

/// Ground of a scenario: a terrain if there is one, else its channel.
fn read_ground(object: &Object<'_>, maps: &Maps) -> Option<Ground> {
    let channel = object.member("channel");
    let Some(terrain) = object.member("terrain") else {
        return read_channel(object).map(Ground::Channel);
    };
    if channel.is_some() {
        let why = "is given beside a terrain: a scenario has either";
        let allowed = "a channel, or a terrain, not both";
        object.report.refuse("/channel", allowed, None, why);
    }
    read_terrain(object, terrain, maps).map(Ground::Terrain)
}

/// A scenario parts of which may have been refused (`None`).
struct Draft {
    title: Option<String>,
    ground: Option<Ground>,
    flow: Option<Option<Flow>>,
    bodies: Option<Vec<Option<Body>>>,
    gravity_m_s2: Option<f64>,
    duration_s: Option<f64>,
    sample_interval_s: Option<f64>,
    flow_snapshots: Option<u32>,
    flow_snapshot_points: Option<u32>,
    numerics: Option<Numerics>,
    accuracy: Option<Accuracy>,
}

impl Draft {
    fn read(object: &Object<'_>, maps: &Maps) -> Self {
        let title = read_title(object);
        let on_terrain = object.has("terrain");
        let ground = read_ground(object, maps);
        let terrain = match &ground {
            Some(Ground::Terrain(terrain)) => Some(terrain),
            _ => None,
        };
        let releases = on_terrain.then_some(|flow: &Object<'_>| read_releases(flow, terrain, maps));
        let flow = read_flow(object, releases);
        let bodies = read_bodies(object, on_terrain);
        let gravity_m_s2 = object.number(&GRAVITY);
        let lasts = match (&ground, &flow, gravity_m_s2) {
            (Some(Ground::Channel(channel)), Some(flow), Some(gravity)) => {
                let bodies = bodies.as_deref().unwrap_or(&[]);
                Some(default_duration((channel, flow.as_ref()), bodies, gravity))
            }
            // Known once the whole scenario is.
            (Some(Ground::Terrain(_)), ..) => Some(WITHOUT_FLOW),
            _ => None,
        };
        let draft = Self {
            title,
            ground,
            flow,
            bodies,
            gravity_m_s2,
            duration_s: object.number_or(&DURATION, lasts),
            sample_interval_s: object.number(&SAMPLE_INTERVAL),
            flow_snapshots: object.count(&FLOW_SNAPSHOTS),
            flow_snapshot_points: object.count(&FLOW_SNAPSHOT_POINTS),
            numerics: read_numerics(object),
            accuracy: read_accuracy(object),
        };
        object.refuse_unknown();
        draft
    }

    /// The rules between fields, as far as the fields are valid.
    fn check(&self, report: &Report) {
        let flow = self.flow.as_ref().and_then(Option::as_ref);
        let bodies = self.bodies.as_deref().unwrap_or(&[]);
        if let (Some(duration), Some(interval)) = (self.duration_s, self.sample_interval_s) {
            samples_are_bounded(report, duration, interval, bodies.len());
        }
        if let (Some(flow), Some(numerics)) = (flow, &self.numerics) {
            stiffness_is_given_once(report, flow, numerics);
        }
        self.check_accuracy(report);
        let Some(Ground::Channel(channel)) = &self.ground else {
            return;
        };
        if let (Some(flow), Some(numerics), Some(gravity)) =
            (flow, &self.numerics, self.gravity_m_s2)
            && let Source::Channel { volume_m3, release } = &flow.source
        {
            let course = Course {
                thickness: release.height_m,
                fastest: channel.fastest_flow((*volume_m3, release), gravity),
            };
            flow_is_stiff_enough(report, flow, &course, bodies, numerics, gravity);
        }
        if let Some(flow) = flow {
            fit::release_fits(report, channel, flow);
        }
        if let Some(numerics) = &self.numerics {
            fit::cells_fit(report, channel, numerics);
        }
        fit::bodies_fit(report, channel, bodies);
        if let Some(gravity) = self.gravity_m_s2 {
            fit::contacts_carry(report, channel, bodies, gravity);
        }
    }

    fn check_accuracy(&self, report: &Report) {
        let Some(accuracy) = &self.accuracy else {
            return;
        };
        target_is_about_something(report, accuracy);
        if let Some(flow) = &self.flow {
            bands_can_be_made(report, accuracy, flow.as_ref());
        }
        if let Some(bodies) = &self.bodies {
            body_is_there(report, accuracy, bodies.len());
        }
        if let Some(numerics) = &self.numerics {
            cells_are_chosen_once(report, accuracy, numerics);
        }
    }

    fn finish(self) -> Option<Scenario> {
        Some(Scenario {
            title: self.title?,
            ground: self.ground?,
            flow: self.flow?,
            bodies: self.bodies?.into_iter().collect::<Option<_>>()?,
            gravity_m_s2: self.gravity_m_s2?,
            duration_s: self.duration_s?,
            sample_interval_s: self.sample_interval_s?,
            flow_snapshots: self.flow_snapshots?,
            flow_snapshot_points: self.flow_snapshot_points?,
            numerics: self.numerics?,
            accuracy: self.accuracy?,
        })
    }
}
