//! Case 10: a layer of glass beads flows down a rough slope.
//!
//! The exact profile is that of a steady layer without side walls (Bagnold's, with
//! μ(I)): see `slope.rs`. h = 20 mm, d = 0.53 mm; steady between 20.91° and 32.78°.
//! The layer is periodic, four cells long and one wide between smooth sides. It
//! starts with the exact profile and is compared with it in two windows
//! of time, so that a drift shows. Tolerances: 3 % of surface speed, 3 % of the profile
//! (root mean square, layers counted by the mass below them), 1 % of the height of the centre of
//! mass, all together, since a layer that gets thinner can keep two of
//! them; and 1 % between the surface speeds of the first two windows, a third of
//! the error allowed. Of the height error, the softness of the beads as computed
//! accounts for ⅔ ρ g h cos θ/K: 0.6, 0.2 and 0.05 % at 22, 24 and 26°.
//!
//! Speed is a sensitive measure of friction: d ln u/d ln μ = μ/(μ − μ_s) + μ/(μ_2 − μ) is
//! 20, 10 and 8 at 22, 24 and 26°. So the error of friction that would cause that of
//! the speed is shown too, without a tolerance.
//!
//! With finer cells or more points per cell the unevenness of the points matters less: at
//! full effort, 27 points per cell instead of 8 are shown as well.
//!
//! At 20° nothing may flow: a layer that starts at rest stays there, and one that starts with
//! the profile of 24° comes to rest. Tolerance: the fastest point ends slower than a
//! thousandth of √(g h).

use crate::verify::blocks::PER_CELL;
use crate::verify::findings::{Error, Findings, Question, Resolution};
use crate::verify::run::{Answer, CaseError, Run};
use crate::verify::slope::{HEIGHT, Means, Slope, fastest, leverage, wave_speed};
use crate::verify::{Case, Effort, How};

pub(super) const CASE: Case = Case {
    name: "bagnold",
    number: "10",
    title: "a layer of beads flows down a rough slope, and not where it is too flat",
    source: "u = ⅔ (I/d) √(φ g cos θ) [h^1.5 − (h − y)^1.5], μ(I) = tan θ",
    how: How::Runs(run),
};

/// Slopes [°], and cells over the height.
const SLOPES: [f64; 3] = [24.0, 22.0, 26.0];
const CELLS: [u32; 3] = [10, 20, 40];
/// More points per cell and axis, and the numbers of cells they are used with.
const DENSE: (u32, [u32; 2]) = (3, [10, 20]);
/// Start and end of the windows [s].
const WINDOWS: [[f64; 2]; 3] = [[2.0, 2.5], [2.5, 3.0], [5.5, 6.0]];
const QUICK_WINDOWS: [[f64; 2]; 2] = [[1.0, 1.25], [1.25, 1.5]];
/// Slope too flat for a flow [°].
const FLAT: f64 = 20.0;
/// Time that a layer has to stay or come to rest [s].
const RESTING: f64 = 2.0;
const COMING_TO_REST: f64 = 3.0;

fn run(effort: Effort, findings: &mut Findings) {
    let windows = match effort {
        Effort::Quick => &QUICK_WINDOWS[..],
        Effort::Full => &WINDOWS,
    };
    for &slope in effort.take(&SLOPES, 1) {
        for &cells in effort.take(&CELLS, 2) {
            flowing(slope, cells, PER_CELL, windows, findings);
        }
        if effort == Effort::Full {
            let (per_cell, cells) = DENSE;
            for cells in cells {
                flowing(slope, cells, per_cell, windows, findings);
            }
        }
        for window in windows {
            for (quantity, _) in quantities(slope, window) {
                findings.take_order(&quantity, 1e-3, None);
            }
        }
    }
    for &cells in effort.take(&CELLS, 1) {
        too_flat(cells, findings);
    }
}

/// Quantities of a window, with their tolerances.
fn quantities(slope: f64, [from, to]: &[f64; 2]) -> [(String, f64); 3] {
    let named = |what: &str| format!("{what}, {slope}°, {from}–{to} s");
    [
        (named("surface speed"), 0.03),
        (named("profile off, L2"), 0.03),
        (named("height of the mass centre"), 0.01),
    ]
}

fn flowing(
    inclination_deg: f64,
    cells: u32,
    per_cell: u32,
    windows: &[[f64; 2]],
    findings: &mut Findings,
) {
    let slope = Slope {
        inclination_deg,
        cells,
        per_cell,
        start_deg: inclination_deg,
        duration: windows[windows.len() - 1][1],
    };
    let resolution = match per_cell {
        PER_CELL => resolution(cells),
        more => Resolution::named(format!("{cells} cells of {} points", more.pow(3))),
    };
    let mut run = Run::start(slope.scene());
    let mut speeds = Vec::new();
    for window in windows {
        let measured = run
            .as_mut()
            .map_err(|error| CaseError::Scene(error.to_string()))
            .and_then(|run| means(&slope, run, window));
        if let Ok((means, _)) = &measured {
            speeds.push(means.surface(inclination_deg).0);
        }
        take_window(inclination_deg, window, &resolution, measured, findings);
    }
    if let (Ok(run), [first, second, ..]) = (&run, &speeds[..]) {
        let drift = format!("surface speed, {inclination_deg}°, second window over first");
        let question = Question::new(drift, "", 1.0).within(0.01);
        findings.take(&resolution, [question], Ok(run.answer([second / first])));
    }
}

fn resolution(cells: u32) -> Resolution {
    let size = HEIGHT / f64::from(cells);
    Resolution::sized(format!("{cells} cells"), size)
}

fn means(
    slope: &Slope,
    run: &mut Run,
    [from, to]: &[f64; 2],
) -> Result<(Means, Answer<0>), CaseError> {
    run.to(*from)?;
    let means = slope.means(run, *to)?;
    Ok((means, run.answer([])))
}

fn take_window(
    slope: f64,
    window: &[f64; 2],
    resolution: &Resolution,
    measured: Result<(Means, Answer<0>), CaseError>,
    findings: &mut Findings,
) {
    let [surface, profile, centre] = quantities(slope, window);
    let exact = slope_surface(&measured, slope);
    let [from, to] = window;
    let questions = [
        Question::new(surface.0, "m/s", exact.1).within(surface.1),
        Question::new(profile.0, "", 0.0)
            .by(Error::Absolute)
            .within(profile.1),
        Question::new(centre.0, "m", 0.5 * HEIGHT).within(centre.1),
        Question::new(
            format!("friction that speed stands for, {slope}°, {from}–{to} s"),
            "",
            1.0,
        ),
    ];
    let answer = measured.map(|(means, Answer { cost, .. })| {
        let faster = exact.0 / exact.1 - 1.0;
        let friction = 1.0 - faster / leverage(slope);
        Answer {
            values: [exact.0, means.off(slope), means.centre, friction],
            cost,
        }
    });
    findings.take(resolution, questions, answer);
}

/// Measured and exact surface speed; NaN if nothing was measured.
fn slope_surface(measured: &Result<(Means, Answer<0>), CaseError>, slope: f64) -> (f64, f64) {
    match measured {
        Ok((means, _)) => means.surface(slope),
        Err(_) => (f64::NAN, f64::NAN),
    }
}

/// A slope that holds the beads: started from rest, and from the profile of a steep one.
fn too_flat(cells: u32, findings: &mut Findings) {
    let starts = [
        ("from rest", FLAT, RESTING),
        ("from the profile of 24°", 24.0, COMING_TO_REST),
    ];
    for (start, start_deg, duration) in starts {
        let slope = Slope {
            inclination_deg: FLAT,
            cells,
            per_cell: PER_CELL,
            start_deg,
            duration,
        };
        let over = Error::Over {
            of: "of √(g h)",
            size: wave_speed(),
        };
        let quantity = format!("fastest point at {FLAT}°, {start}, after {duration} s");
        let question = Question::new(quantity, "m/s", 0.0).by(over).within(1e-3);
        findings.take(&resolution(cells), [question], at_the_end(&slope));
    }
}

fn at_the_end(slope: &Slope) -> Result<Answer<1>, CaseError> {
    let mut run = Run::start(slope.scene())?;
    run.to(slope.duration)?;
    Ok(run.answer([fastest(&run.simulation)]))
}
