//! Reduction of a failing scenario, as long as it fails the same way.

use crate::verify::robustness::trial::TrialReport;
use serde_json::Value;

/// Largest number of runs spent on one scenario.
const MOST_RUNS: usize = 60;

/// The smallest scenario found that fails in the same way as this one.
pub(super) fn reduced(scenario: &Value, fails_alike: &mut impl FnMut(&Value) -> bool) -> Value {
    let mut smallest = scenario.clone();
    let mut runs = 0;
    loop {
        let next = simpler(&smallest).into_iter().find(|simpler| {
            let may_run = runs < MOST_RUNS;
            runs += usize::from(may_run);
            may_run && fails_alike(simpler)
        });
        match next {
            Some(simpler) => smallest = simpler,
            None => return smallest,
        }
    }
}

/// Scenarios slightly simpler than this one, the simplest first.
fn simpler(scenario: &Value) -> Vec<Value> {
    let mut all = Vec::new();
    let mut try_with = |change: &dyn Fn(&mut Value)| {
        let mut copy = scenario.clone();
        change(&mut copy);
        if copy != *scenario {
            all.push(copy);
        }
    };
    try_with(&|copy| copy["flow"] = Value::Null);
    let bodies = scenario["bodies"].as_array().map_or(0, Vec::len);
    for body in 0..bodies {
        try_with(&|copy| {
            copy["bodies"].as_array_mut().map(|all| all.remove(body));
        });
    }
    try_with(&|copy| {
        let half = copy["duration_s"].as_f64().unwrap_or(0.0) / 2.0;
        copy["duration_s"] = half.into();
        copy["sample_interval_s"] = half.clamp(1e-5, 3600.0).into();
    });
    // Every optional field.
    let required = [
        "inclination_deg",
        "incline_length_m",
        "runout_length_m",
        "width_m",
        "volume_m3",
        "release",
        "shape",
        "position",
        "downstream_m",
        "height_m",
        "toe_distance_m",
        "cell_size_m",
    ];
    let parts = ["/channel", "/flow/material", "/numerics", ""];
    let of_bodies =
        (0..bodies).flat_map(|body| ["", "/position"].map(|part| format!("/bodies/{body}{part}")));
    for part in parts.map(str::to_owned).into_iter().chain(of_bodies) {
        let Some(Value::Object(fields)) = scenario.pointer(&part) else {
            continue;
        };
        let basic = [
            "channel",
            "flow",
            "bodies",
            "duration_s",
            "sample_interval_s",
            "numerics",
        ];
        let removable = fields.keys().filter(|key| {
            let kept = required.contains(&key.as_str());
            !(kept || part.is_empty() && basic.contains(&key.as_str()))
        });
        for key in removable {
            try_with(&|copy| {
                if let Some(Value::Object(fields)) = copy.pointer_mut(&part) {
                    fields.remove(key);
                }
            });
        }
    }
    all
}

/// Kind of failure, equal for two runs that fail in the same way.
pub(super) fn kind(tried: &TrialReport) -> String {
    match &tried.ended {
        super::Ended::Failed(error) => {
            let whole = format!("{error:?}");
            let name = whole.split([' ', '{', '(']).next();
            name.unwrap_or_default().to_owned()
        }
        super::Ended::Panicked(words) => {
            format!("panic: {}", words.split('(').next().unwrap_or(""))
        }
        _ => tried.broken.join(", "),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    // The failure is caused by a fast body; everything else is removed.
    #[test]
    fn what_does_not_matter_goes() {
        let scenario = json!({
            "channel": {"inclination_deg": 3, "width_m": 1, "base_friction": 0.3},
            "flow": {"volume_m3": 1.0}, "gravity_m_s2": 3.0, "duration_s": 1.0,
            "bodies": [{"shape": 1, "friction": 2}, {"shape": 2, "velocity_m_s": 5, "friction": 1}],
            "numerics": {"courant": 0.3},
        });
        let smallest = reduced(&scenario, &mut |scenario| {
            let bodies = scenario["bodies"].as_array().unwrap();
            let fast = bodies.iter().any(|body| body["velocity_m_s"] == 5);
            fast && scenario["duration_s"].as_f64().unwrap() > 0.2
        });
        assert_eq!(smallest["bodies"], json!([{"shape": 2, "velocity_m_s": 5}]));
        assert_eq!(smallest["flow"], Value::Null);
        assert_eq!(
            smallest["channel"],
            json!({"inclination_deg": 3, "width_m": 1})
        );
        assert_eq!(smallest["duration_s"], 0.25);
        assert!(smallest.get("gravity_m_s2").is_none());
    }
}
