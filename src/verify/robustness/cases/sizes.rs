//! Cubes much smaller than a cell and much larger, lighter than the flow and heavier.

use super::{CELL, strike, strike_with};
use crate::verify::Effort;
use crate::verify::robustness::{Family, Member, Trial};
use serde_json::json;

pub(super) const SIZES: Family = Family {
    name: "size of the cube",
    reason: "a cube of a quarter of a cell meets fewer points than it has faces and its mass is \
             that of a few points; one of 32 cells has thousands of contacts",
    members: sizes,
};

pub(super) const DENSITIES: Family = Family {
    name: "density of the cube",
    reason: "a light cube rings against the points that cover it (equation 26), a heavy one \
             crushes them",
    members: densities,
};

fn sizes(effort: Effort) -> Vec<Member> {
    let all = [0.25, 1.0, 4.0, 32.0];
    effort.take(&all, 3).iter().copied().map(sized).collect()
}

fn sized(cells: f64) -> Member {
    let side = cells * CELL;
    let mut scenario = strike(40.0);
    scenario["bodies"] = json!([{
        "shape": {"cube": {"side_m": side}}, "position": {"downstream_m": 0.01 + 0.5 * side}
    }]);
    if cells > 5.0 {
        scenario["channel"]["width_m"] = (side + 4.0 * CELL).into();
        scenario["channel"]["incline_length_m"] = 1.5.into();
        scenario["channel"]["runout_length_m"] = 1.5.into();
        scenario["flow"]["volume_m3"] = 0.03.into();
    }
    let name = format!("{cells} cells");
    Member::Scene(Box::new(Trial::new(name, scenario)))
}

fn densities(_: Effort) -> Vec<Member> {
    let of = |ratio: f64| {
        let change = [("/bodies/0/density_kg_m3", json!(1500.0 * ratio))];
        let name = format!("{ratio} times the flow's");
        Member::Scene(Box::new(strike_with(name, &change)))
    };
    [0.05, 0.3, 50.0].map(of).into()
}
