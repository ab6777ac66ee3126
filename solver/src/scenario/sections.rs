//! Readers of the scenario's sections other than bodies.

use super::agreement::ascend;
use super::node::Node;
use super::reader::Object;
use super::rules::*;
use super::{
    Approach, Channel, Coupling, Ending, Flow, Material, Numerics, Precision, Release, Source,
    Symmetry, TerrainRelease,
};

/// JSON names of the precision.
pub(super) const PRECISIONS: [(&str, Precision); 2] =
    [("single", Precision::Single), ("double", Precision::Double)];

/// JSON names of the symmetry.
pub(super) const SYMMETRIES: [(&str, Symmetry); 3] = [
    ("auto", Symmetry::Auto),
    ("full", Symmetry::Full),
    ("mirror", Symmetry::Mirror),
];

/// JSON names of the approach.
pub(super) const APPROACHES: [(&str, Approach); 3] = [
    ("auto", Approach::Auto),
    ("full", Approach::Full),
    ("slab", Approach::Slab),
];

/// JSON names of the coupling.
pub(super) const COUPLINGS: [(&str, Coupling); 2] = [
    ("half_spacing", Coupling::HalfSpacing),
    ("source_paper", Coupling::SourcePaper),
];

/// JSON names of the ending.
pub(super) const ENDINGS: [(&str, Ending); 2] = [("auto", Ending::Auto), ("full", Ending::Full)];

pub(super) fn read_title(object: &Object<'_>) -> Option<String> {
    match object.member("title") {
        None => Some(String::new()),
        Some(Node::Text(text)) if text.chars().count() <= TITLE_LENGTH => Some(text.clone()),
        Some(_) => {
            let allowed = format!("a text of at most {TITLE_LENGTH} characters");
            let why = format!("must be {allowed}");
            let pointer = object.pointer_to("title");
            object.report.refuse(&pointer, &allowed, None, &why);
            None
        }
    }
}

pub(super) fn read_channel(parent: &Object<'_>) -> Option<Channel> {
    let object = parent.object(parent.required("channel", "an object")?, "channel")?;
    let inclination_deg = object.number(&INCLINATION);
    let incline_length_m = object.number(&INCLINE_LENGTH);
    let runout_length_m = object.number(&RUNOUT_LENGTH);
    let width_m = object.number(&WIDTH);
    let base_friction = object.number(&BASE_FRICTION);
    let side_friction = object.number(&SIDE_FRICTION);
    object.refuse_unknown();
    Some(Channel {
        inclination_deg: inclination_deg?,
        incline_length_m: incline_length_m?,
        runout_length_m: runout_length_m?,
        width_m: width_m?,
        base_friction: base_friction?,
        side_friction: side_friction?,
    })
}

/// The flow; on a terrain its releases are read by `releases`.
pub(super) fn read_flow(
    parent: &Object<'_>,
    releases: Option<impl FnOnce(&Object<'_>) -> Option<Vec<TerrainRelease>>>,
) -> Option<Option<Flow>> {
    let node = parent.required("flow", "an object, or null for no flow")?;
    if *node == Node::Null {
        return Some(None);
    }
    let object = parent.object(node, "flow")?;
    let source = match releases {
        Some(read) => read(&object).map(|releases| Source::Terrain { releases }),
        None => read_channel_source(&object),
    };
    let material = object.defaulted("material").and_then(|o| read_material(&o));
    object.refuse_unknown();
    Some(Some(Flow {
        source: source?,
        material: material?,
    }))
}

fn read_channel_source(object: &Object<'_>) -> Option<Source> {
    let volume_m3 = object.number(&VOLUME);
    let release = object.defaulted("release").and_then(|o| read_release(&o));
    Some(Source::Channel {
        volume_m3: volume_m3?,
        release: release?,
    })
}

fn read_release(object: &Object<'_>) -> Option<Release> {
    let height_m = object.number(&RELEASE_HEIGHT);
    let toe_distance_m = object.number(&TOE_DISTANCE);
    object.refuse_unknown();
    Some(Release {
        height_m: height_m?,
        toe_distance_m: toe_distance_m?,
    })
}

fn read_material(object: &Object<'_>) -> Option<Material> {
    let bulk_density = object.number(&BULK_DENSITY);
    let grain_density = object.number(&GRAIN_DENSITY);
    let grain_diameter_m = object.number(&GRAIN_DIAMETER);
    let static_friction = object.number(&STATIC_FRICTION);
    let limiting_friction = object.number(&LIMITING_FRICTION);
    let reference_inertial_number = object.number(&INERTIAL_NUMBER);
    let poissons_ratio = object.number(&POISSONS_RATIO);
    let youngs_modulus_pa = object.automatic(&YOUNGS_MODULUS);
    object.refuse_unknown();
    ascend(
        object,
        (&STATIC_FRICTION, static_friction),
        (&LIMITING_FRICTION, limiting_friction),
    );
    ascend(
        object,
        (&BULK_DENSITY, bulk_density),
        (&GRAIN_DENSITY, grain_density),
    );
    Some(Material {
        bulk_density_kg_m3: bulk_density?,
        grain_density_kg_m3: grain_density?,
        grain_diameter_m: grain_diameter_m?,
        static_friction: static_friction?,
        limiting_friction: limiting_friction?,
        reference_inertial_number: reference_inertial_number?,
        poissons_ratio: poissons_ratio?,
        youngs_modulus_pa: youngs_modulus_pa?,
    })
}

pub(super) fn read_numerics(parent: &Object<'_>) -> Option<Numerics> {
    let object = parent.defaulted("numerics")?;
    let cell_size_m = object.automatic(&CELL_SIZE);
    let points_per_cell = object.count(&POINTS_PER_CELL);
    let sound_speed_m_s = object.automatic(&SOUND_SPEED);
    let courant = object.automatic(&COURANT);
    let flow_courant = object.automatic(&FLOW_COURANT);
    let precision = object.choice("precision", &PRECISIONS, Some(Precision::default()));
    let symmetry = object.choice("symmetry", &SYMMETRIES, Some(Symmetry::default()));
    let approach = object.choice("approach", &APPROACHES, Some(Approach::default()));
    let coupling = object.choice("coupling", &COUPLINGS, Some(Coupling::default()));
    let ending = object.choice("ending", &ENDINGS, Some(Ending::default()));
    let threads = object.automatic_count(&THREADS);
    object.refuse_unknown();
    Some(Numerics {
        cell_size_m: cell_size_m?,
        points_per_cell: points_per_cell?,
        sound_speed_m_s: sound_speed_m_s?,
        courant: courant?,
        flow_courant: flow_courant?,
        precision: precision?,
        symmetry: symmetry?,
        approach: approach?,
        coupling: coupling?,
        ending: ending?,
        threads: threads?.map(|threads| threads as usize),
    })
}
