//! Every field of a scenario but those of shapes (`shape.rs`), with its range, unit and default.
//! The contract and the tables of `docs/scenario.md` are made from this table and from the doc
//! comments of the structs; a test holds the readers to it.

use super::accuracy::QUANTITIES;
use super::range::Rule;
use super::rules::*;
use super::sections::{APPROACHES, COUPLINGS, ENDINGS, PRECISIONS, SYMMETRIES};
use super::shape::SHAPES;
use super::terrain_sections::{COORDINATES, MAP_NAME};
use std::ops::RangeInclusive;

/// The fields of one struct of the scenario.
pub(super) struct Section {
    /// Name of the struct.
    pub(super) schema: &'static str,
    /// Start of the fields' names in `docs/scenario.md`.
    pub(super) path: &'static str,
    /// The fields, in the order of that document.
    pub(super) fields: &'static [Field],
}

/// Kind of ground.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum GroundKind {
    /// A channel.
    Channel,
    /// A terrain.
    Terrain,
}

/// A field: what its value may be, and what it is if it is left out.
pub(super) struct Field {
    /// Key in the JSON.
    pub(super) key: &'static str,
    /// Allowed values.
    pub(super) kind: Kind,
    /// Value of a field that is left out.
    pub(super) default: Default,
    /// Ground whose scenarios alone have it; `None`: as the struct.
    pub(super) ground: Option<GroundKind>,
    /// Further condition, in words that follow those of the kind.
    also: &'static str,
}

/// Allowed values of a field.
pub(super) enum Kind {
    /// A number.
    Number(Rule),
    /// A whole number.
    Whole(Rule),
    /// So many numbers.
    Vector(Rule, usize),
    /// A list of numbers, and the name of its entries.
    List(Rule, RangeInclusive<usize>, &'static str),
    /// So many lists of so many numbers, and the name of one of them.
    Table(Rule, usize, RangeInclusive<usize>, &'static str),
    /// The name of a map.
    Map,
    /// One of a few words.
    Words(fn() -> Vec<&'static str>),
    /// True or false.
    Flag,
    /// A text of at most so many characters.
    Text(usize),
    /// A list of at most so many objects.
    Items(usize),
    /// An object.
    Object,
    /// An object or null.
    ObjectOrNull,
    /// One of the shapes.
    Shape,
}

/// Value of a field that is left out.
#[derive(Clone, Copy, PartialEq)]
pub(super) enum Default {
    /// None: the field must be given.
    Required,
    /// The default of the field's rule.
    OfRule,
    /// A JSON text.
    Json(&'static str),
    /// Null: the solver chooses.
    Automatic,
    /// A value that follows from other fields, in words.
    Words(&'static str),
}

impl Field {
    const fn new(key: &'static str, kind: Kind, default: Default) -> Self {
        Self {
            key,
            kind,
            default,
            ground: None,
            also: "",
        }
    }

    const fn required(self) -> Self {
        self.with(Default::Required)
    }

    const fn automatic(self) -> Self {
        self.with(Default::Automatic)
    }

    const fn null(self) -> Self {
        self.with(Default::Json("null"))
    }

    const fn json(self, text: &'static str) -> Self {
        self.with(Default::Json(text))
    }

    const fn otherwise(self, words: &'static str) -> Self {
        self.with(Default::Words(words))
    }

    const fn with(mut self, default: Default) -> Self {
        self.default = default;
        self
    }

    const fn in_channel(mut self) -> Self {
        self.ground = Some(GroundKind::Channel);
        self
    }

    const fn on_terrain(mut self) -> Self {
        self.ground = Some(GroundKind::Terrain);
        self
    }

    const fn also(mut self, words: &'static str) -> Self {
        self.also = words;
        self
    }

    /// The rule of its numbers, if it has any.
    pub(super) fn rule(&self) -> Option<&Rule> {
        match &self.kind {
            Kind::Number(rule)
            | Kind::Whole(rule)
            | Kind::Vector(rule, _)
            | Kind::List(rule, ..)
            | Kind::Table(rule, ..) => Some(rule),
            _ => None,
        }
    }

    /// Allowed values in words, with Markdown's marks.
    pub(super) fn allowed(&self) -> String {
        let quoted = |words: Vec<&str>| words.iter().map(|word| format!("`\"{word}\"`")).collect();
        let of_kind = match &self.kind {
            Kind::Number(rule) => rule.range.words(),
            Kind::Whole(rule) => format!("{}, whole", rule.range.words()),
            Kind::Vector(rule, _) => format!("{} each", rule.range.words()),
            Kind::List(rule, count, entries) => {
                let (least, most) = (count.start(), count.end());
                format!("{} each, {least} to {most} {entries}", rule.range.words())
            }
            Kind::Table(rule, _, count, entries) => {
                let (least, most) = (count.start(), count.end());
                format!("{} each, {least} to {most} {entries}", rule.range.words())
            }
            Kind::Map => MAP_NAME.to_owned(),
            Kind::Words(words) => {
                let words: Vec<String> = quoted(words());
                words.join(" or ")
            }
            Kind::Flag => "true or false".to_owned(),
            Kind::Text(most) => format!("at most {most} characters"),
            Kind::Items(most) => format!("at most {most}"),
            Kind::Object => "an object".to_owned(),
            Kind::ObjectOrNull => "an object or null".to_owned(),
            Kind::Shape => {
                let names = SHAPES.map(|kind| kind.name);
                format!("exactly one of: {}", names.join(", "))
            }
        };
        let automatic = match self.default {
            Default::Automatic => ", automatic",
            _ => "",
        };
        format!("{of_kind}{}{automatic}", self.also)
    }
}

const fn number(rule: &Rule) -> Field {
    Field::new(rule.key, Kind::Number(*rule), Default::OfRule)
}

const fn whole(rule: &Rule) -> Field {
    Field::new(rule.key, Kind::Whole(*rule), Default::OfRule)
}

const fn vector(rule: &Rule, length: usize) -> Field {
    Field::new(rule.key, Kind::Vector(*rule, length), Default::OfRule)
}

const fn list(rule: &Rule, count: RangeInclusive<usize>, entries: &'static str) -> Field {
    Field::new(
        rule.key,
        Kind::List(*rule, count, entries),
        Default::Required,
    )
}

const fn words(key: &'static str, words: fn() -> Vec<&'static str>) -> Field {
    Field::new(key, Kind::Words(words), Default::Required)
}

const fn flag(key: &'static str) -> Field {
    Field::new(key, Kind::Flag, Default::Required)
}

const fn text(key: &'static str, most: usize) -> Field {
    Field::new(key, Kind::Text(most), Default::Required)
}

const fn items(key: &'static str, most: usize) -> Field {
    Field::new(key, Kind::Items(most), Default::Required)
}

const fn map(key: &'static str) -> Field {
    Field::new(key, Kind::Map, Default::Required)
}

const fn object(key: &'static str) -> Field {
    Field::new(key, Kind::Object, Default::Required)
}

const fn object_or_null(key: &'static str) -> Field {
    Field::new(key, Kind::ObjectOrNull, Default::Required)
}

const fn shape(key: &'static str) -> Field {
    Field::new(key, Kind::Shape, Default::Required)
}

/// Names of a choice.
fn names<T>(choices: &[(&'static str, T)]) -> Vec<&'static str> {
    choices.iter().map(|(name, _)| *name).collect()
}

/// Every struct of the scenario, in the order of `docs/scenario.md`.
pub(super) const SECTIONS: [Section; 12] = [
    Section {
        schema: "Scenario",
        path: "",
        fields: &[
            text("title", TITLE_LENGTH).json(r#""""#),
            object("channel").in_channel().also(", or a terrain instead"),
            object("terrain").otherwise("left out").on_terrain().also(", instead of a channel"),
            object_or_null("flow").required(),
            items("bodies", BODIES).required(),
            number(&GRAVITY),
            number(&DURATION).otherwise("twice the time at which the flow is expected to have come to rest, at least as long as every table of a prescribed motion; 3 without a flow"),
            number(&SAMPLE_INTERVAL).also(", and at most 500,000 samples of all bodies together"),
            whole(&FLOW_SNAPSHOTS),
            whole(&FLOW_SNAPSHOT_POINTS),
            object("numerics").otherwise("all defaults"),
            object("accuracy").otherwise("all defaults"),
        ],
    },
    Section {
        schema: "Channel",
        path: "channel.",
        fields: &[
            number(&INCLINATION).required(),
            number(&INCLINE_LENGTH).required(),
            number(&RUNOUT_LENGTH).required(),
            number(&WIDTH),
            number(&BASE_FRICTION),
            number(&SIDE_FRICTION),
        ],
    },
    Section {
        schema: "Terrain",
        path: "terrain.",
        fields: &[
            map("height_map").required(),
            words("coordinates", || names(&COORDINATES)).json(r#""map""#),
            number(&BASE_FRICTION),
            map("base_friction_map").null(),
        ],
    },
    Section {
        schema: "Flow",
        path: "flow.",
        fields: &[
            number(&VOLUME).required().in_channel().also(", and must fit"),
            object("release").otherwise("all defaults").in_channel(),
            items("releases", RELEASES).required().on_terrain(),
            object("material").otherwise("all defaults"),
        ],
    },
    Section {
        schema: "Release",
        path: "flow.release.",
        fields: &[
            number(&RELEASE_HEIGHT),
            number(&TOE_DISTANCE).also(", below the incline's length"),
        ],
    },
    Section {
        schema: "TerrainRelease",
        path: "flow.releases[].",
        fields: &[
            Field::new(CORNER.key, Kind::Table(CORNER, 2, CORNERS, "corners"), Default::Words("left out")).also(" on the map, whose sides do not cross"),
            number(&THICKNESS).otherwise("left out").also("; with `polygon_m`"),
            map("thickness_map").null().also("; instead of a polygon"),
            map("surface_map").null().also("; instead of a polygon"),
            number(&RELEASE_TIME),
        ],
    },
    Section {
        schema: "Material",
        path: "flow.material.",
        fields: &[
            number(&BULK_DENSITY).also(", not above the grains'"),
            number(&GRAIN_DENSITY),
            number(&GRAIN_DIAMETER),
            number(&STATIC_FRICTION),
            number(&LIMITING_FRICTION).also(", not below `static_friction`"),
            number(&INERTIAL_NUMBER),
            number(&POISSONS_RATIO),
            number(&YOUNGS_MODULUS).automatic().also(", and stiff enough for the release's weight and for what a `motion` presses"),
        ],
    },
    Section {
        schema: "Body",
        path: "bodies[].",
        fields: &[
            shape("shape").required(),
            number(&SPHERO_RADIUS).otherwise("1/20 of the thickness, the diameter of the largest ball inside (of a cube: the side); of a ball or capsule its radius").also(", below half the thickness; of a ball or capsule nothing but its radius"),
            number(&BODY_DENSITY),
            object("position").otherwise("all defaults"),
            number(&YAW),
            vector(&ORIENTATION, 4).null().also(", of length 1 within 0.001; yaw 0"),
            vector(&VELOCITY, 3).also("; 0 if fixed or with a `motion`"),
            vector(&ANGULAR_VELOCITY, 3).also("; 0 if fixed or with a `motion`"),
            number(&FRICTION),
            number(&RESTITUTION),
            number(&ROLLING_FRICTION),
            number(&FLOW_FRICTION),
            number(&FLOW_RESTITUTION),
            number(&CONTACT_MODULUS).automatic().also(", and stiff enough for the body's weight, its start and its fall"),
            flag("fixed").json("false").also("; not together with `motion`"),
            object_or_null("motion").null(),
        ],
    },
    Section {
        schema: "Position",
        path: "bodies[].position.",
        fields: &[
            number(&DOWNSTREAM).otherwise("the longest side of a cube or box, the length of a ball or capsule, else the largest distance of two vertices").in_channel().also(", inside the channel"),
            number(&LATERAL).in_channel().also(", inside the channel"),
            number(&EAST).required().on_terrain().also(", its bounding radius from the edges of the map"),
            number(&NORTH).required().on_terrain().also(", its bounding radius from the edges of the map"),
            number(&TERRAIN_ELEVATION).automatic().on_terrain().also(", in a channel 0 or more, and above the ground"),
        ],
    },
    Section {
        schema: "Motion",
        path: "bodies[].motion.",
        fields: &[
            list(&MOTION_TIME, MOTION_TIMES, "times").otherwise("left out"),
            vector(&VELOCITY, 3).otherwise("zeros"),
            vector(&ANGULAR_VELOCITY, 3).otherwise("zeros"),
        ],
    },
    Section {
        schema: "Numerics",
        path: "numerics.",
        fields: &[
            number(&CELL_SIZE).automatic().also(", not above the channel's width"),
            whole(&POINTS_PER_CELL),
            number(&SOUND_SPEED).automatic().also(", and at least √(2 g × release height) and √6 × the fastest `motion`"),
            number(&COURANT).automatic(),
            number(&FLOW_COURANT).automatic(),
            words("precision", || names(&PRECISIONS)).json(r#""single""#),
            words("symmetry", || names(&SYMMETRIES)).json(r#""auto""#),
            words("approach", || names(&APPROACHES)).json(r#""auto""#),
            words("coupling", || names(&COUPLINGS)).json(r#""half_spacing""#),
            words("ending", || names(&ENDINGS)).json(r#""auto""#),
            whole(&THREADS).automatic(),
        ],
    },
    Section {
        schema: "Accuracy",
        path: "accuracy.",
        fields: &[
            flag("error_bars").json("false"),
            number(&TARGET).null().also("; `numerics.cell_size_m` is then automatic"),
            words("quantity", || names(&QUANTITIES)).null(),
            whole(&TARGET_BODY).also(", a body of the scenario, also without a target (0 if there are none)"),
            number(&BUDGET),
        ],
    },
];
