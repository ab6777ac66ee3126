//! Numbers of the method that were chosen and not derived: each with its meaning, unit, source,
//! and the consequence of another value. Tolerances of geometry and of rounding stand with the
//! code that they belong to.

/// Numbers of the method.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Method {
    /// Length of steps and sub-steps of the flow.
    pub time_step: TimeStep,
    /// Stiffness of the flow and of its contacts, where a scenario gives none.
    pub stiffness: Stiffness,
    /// Automatic cell size.
    pub resolution: Resolution,
    /// Redistribution of points.
    pub redistribution: Redistribution,
    /// Strain-rate smoothing.
    pub smoothing: Smoothing,
    /// Action of walls on nodes.
    pub boundary: Boundary,
    /// Contact of points with bodies, and of bodies with walls and bodies.
    pub contact: Contact,
    /// Length of body sub-steps.
    pub body_step: BodyStep,
    /// Sleep of bodies.
    pub sleep: Sleep,
    /// Early stop of a run.
    pub early_stop: EarlyStop,
    /// Guards that end a run.
    pub guards: Guards,
}

/// Length of steps and sub-steps of the flow.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TimeStep {
    /// Acoustic Courant number of the sub-step, by default (equation 25). A lone point is stable
    /// up to 1, a flow up to about 2 (decision 22); smaller costs more and changes little.
    pub courant: f64,
    /// Travel of the fastest point per step [cells], by default (equation 27): between two
    /// transfers the weights are those of the first. Larger is cheaper and off by the motion of
    /// nodes relative to points: by up to 10 % at one cell per edge, 2 % at three
    /// (docs/source-paper.md).
    pub flow_courant: f64,
    /// Share of its expected speed below which a flow is transferred as often as at that speed. A
    /// slower flow would be transferred ever more rarely, and its points would not be
    /// redistributed.
    pub slow: f64,
    /// Largest travel of a body in a sub-step [cells]: less than a point's spacing, so that it
    /// meets every point on its way.
    pub body_travel: f64,
    /// Sub-step without a flow, in which bodies choose their own [s].
    pub without_flow: f64,
    /// Largest sub-step over the time scale of a body's contacts with the flow (equation 26).
    pub body_contact_share: f64,
}

/// Stiffness of the flow and of its contacts.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Stiffness {
    /// Sound speed over the speed whose dynamic pressure is the largest expected (equation 32):
    /// density varies by its inverse square under steady load, 1 %. Sub-steps shorten with it.
    pub sound_over_flow: f64,
    /// Overlap of a point and a body, over the point spacing, at the largest pressure expected: a
    /// contact is then no stiffer than the material between two points (equation 34).
    pub reference_overlap: f64,
    /// Stiffness for the weight of a body laid on the flow, over that for a flow's dynamic
    /// pressure (decision 28). A body settles by its pressure over the shear modulus, several
    /// times that near the bearing capacity: without this a steel cube on sand settles by a
    /// sixteenth of its side.
    pub settlement: f64,
    /// Overlap of a body at rest on one vertex, over its sphero radius (equation 33).
    pub overlap_at_rest: f64,
    /// Overlap of an impact on one vertex at the expected speed, over the sphero radius (equation
    /// 33). Smaller takes shorter body sub-steps; above 0.9 the run ends.
    pub overlap_at_impact: f64,
    /// Tangential over normal stiffness, 2(1−ν)/(2−ν) at ν = 0.3 (Mindlin 1949).
    pub tangential_ratio: f64,
    /// Bulk viscosity over ρ_c c_P h, b of equation 3a: resists changes of volume of grains in
    /// touch, so that noise does not grow as sub-steps shorten (decision 8).
    pub bulk_viscosity: f64,
}

/// Automatic cell size (equation 30).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Resolution {
    /// Cells across the thinnest body: peak and displacement are off by some per cent
    /// (docs/coarse-cells.md). Cost goes with the fourth power.
    pub cells_per_body: f64,
    /// Cells across the release, without bodies.
    pub cells_per_release: f64,
    /// Largest number of points for which cells are made that small.
    pub automatic_points: f64,
}

/// Redistribution of points (equations 39 to 42c; decisions 8, 16 and 19).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Redistribution {
    /// Shift over −h² ∇excess volume fraction, per cell of travel (Lind et al. 2012). Without it
    /// points gather in long shear.
    pub shift: f64,
    /// Largest shift in a step [cells].
    pub largest_shift: f64,
    /// Share of its own compressive strain that a point exchanges for the mean, per cell of
    /// travel. Without it volumes of points scatter.
    pub volumetric_smoothing: f64,
    /// Relative rise of pressure per excess volume fraction and cell of travel. Without it a
    /// flow settles into less volume than that of its points.
    pub pressure_correction: f64,
    /// Largest relative rise of pressure in a step.
    pub largest_rise: f64,
    /// Share of the fastest point's travel below which a point is redistributed less, by the
    /// square: a flow at rest that only trembles would creep.
    pub slow: f64,
    /// Height above the bed below which no point is shifted towards it [cells]: nodes behind a
    /// wall do not show how crowded it is there.
    pub no_shift_height: f64,
    /// Depth behind the bed below which no point is moved farther behind it [cells].
    pub deepest_penetration: f64,
}

/// Strain-rate smoothing (equation 42a; decision 12).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Smoothing {
    /// Share of the mean in the effective strain rate of a point. Without it a layer at 22° flows
    /// 4 to 6 % too fast, with 1 it flows 4 % too slow (decision 12).
    pub share: f64,
    /// Share of the speed that governs the steps below which a point is smoothed less, by the
    /// square, for the same reason as in redistribution.
    pub slow: f64,
}

/// Action of walls on nodes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Boundary {
    /// Share of a node's kernel in the channel below which its volume fraction is undefined.
    pub least_available_volume: f64,
    /// Slope (rise over run) above which a plane of the bed has horizontal boundary columns
    /// (decision 9).
    pub steep: f64,
}

/// Contact of points with bodies, and of bodies with walls and bodies.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Contact {
    /// Largest share of approach and sliding speed that all contacts of a body with the flow take
    /// in one sub-step (decision 21): they never reverse a motion.
    pub damping_cap: f64,
    /// Largest damping number of a contact law: a restitution of about 0.008.
    pub largest_damping: f64,
}

/// Length of body sub-steps (equations 20 to 20b; decision 32).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BodyStep {
    /// Body sub-step over a contact's time scale √(m/k'): an undamped impact lasts about four of
    /// these scales, so it gets sixty-five.
    pub contact_share: f64,
    /// The share for a contact without damping, whose energy changes by the error of the
    /// integration alone.
    pub undamped_share: f64,
    /// Damping number above which damping dissipates a hundred times the energy that the
    /// integration makes at `contact_share`.
    pub damped: f64,
    /// Largest turn per body sub-step [rad].
    pub largest_turn: f64,
    /// Largest number of body sub-steps; a run that needs more ends.
    pub most: f64,
}

/// Sleep of bodies.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sleep {
    /// Speed below which all places of a body must be for it to be still [m/s].
    pub still: f64,
    /// Time of stillness of all bodies of an island after which it sleeps [s].
    pub after: f64,
}

/// Early stop of a run (equations 62 and 63).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct EarlyStop {
    /// Time of uninterrupted rest after which a body or a flow has come to rest [√(size/g)].
    pub rest_time: f64,
    /// Speed below which points creep [√(g h), h the height of the release]: one that slides
    /// freely is slower only for its first milliseconds.
    pub creep: f64,
    /// Largest possible further advance of the front [cells].
    pub front_bound: f64,
    /// Least bound on it [cells].
    pub front_resolution: f64,
    /// Largest possible further outflow through the open end [released mass].
    pub outflow_bound: f64,
    /// Largest share of the tipping energy of a body that may reach it.
    pub tipping_share: f64,
    /// Largest height by which the energy that may reach a body without a footing could lift it
    /// [sizes of the body].
    pub lift: f64,
}

/// Guards that end a run (docs/method.md, section 10).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Guards {
    /// Mach number above which a flow has blown up.
    pub largest_mach_number: f64,
    /// Overlap of two bodies, as a share of both sphero radii, above which their contact is too
    /// soft.
    pub deepest_overlap: f64,
    /// Largest speed over that of a fall from the highest place and the fastest throw together:
    /// an elastic impact doubles a speed, and a few in a row with ever lighter bodies more.
    pub faster: f64,
    /// Largest rise of the mechanical energy, as a share of the energy scale.
    pub energy_made: f64,
    /// Largest energy made by a body's contacts, as a share of that body's energy scale.
    pub body_energy_made: f64,
}

/// Numbers of the method as they are.
pub const METHOD: Method = Method {
    time_step: TimeStep {
        courant: 0.8,
        flow_courant: 0.2,
        slow: 1.0,
        body_travel: 0.4,
        without_flow: 1e-3,
        body_contact_share: 0.5,
    },
    stiffness: Stiffness {
        sound_over_flow: 10.0,
        reference_overlap: 0.1,
        settlement: 16.0,
        overlap_at_rest: 0.01,
        overlap_at_impact: 0.2,
        tangential_ratio: 0.82,
        bulk_viscosity: 0.2,
    },
    resolution: Resolution {
        cells_per_body: 4.0,
        cells_per_release: 8.0,
        automatic_points: 400_000.0,
    },
    redistribution: Redistribution {
        shift: 1.0,
        largest_shift: 0.1,
        volumetric_smoothing: 2.0,
        pressure_correction: 5.0,
        largest_rise: 0.5,
        slow: 0.2,
        no_shift_height: 0.5,
        deepest_penetration: 0.25,
    },
    smoothing: Smoothing {
        share: 0.5,
        slow: 0.2,
    },
    boundary: Boundary {
        least_available_volume: 0.02,
        steep: 2.0,
    },
    contact: Contact {
        damping_cap: 0.5,
        largest_damping: 12.0,
    },
    body_step: BodyStep {
        contact_share: 0.06,
        undamped_share: 0.01,
        damped: 0.001,
        largest_turn: 0.05,
        most: 100_000.0,
    },
    sleep: Sleep {
        still: 1e-5,
        after: 0.1,
    },
    early_stop: EarlyStop {
        rest_time: 1.5,
        creep: 1e-2,
        front_bound: 0.1,
        front_resolution: 0.01,
        outflow_bound: 1e-3,
        tipping_share: 0.5,
        lift: 1e-3,
    },
    guards: Guards {
        largest_mach_number: 20.0,
        deepest_overlap: 0.9,
        faster: 10.0,
        energy_made: 0.1,
        body_energy_made: 0.01,
    },
};
