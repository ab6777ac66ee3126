//! Failure of a job, as the problem document stored with it.

use super::job_limits::Excess;
use scree_solver::{Mover, SetupError, StepError};
use serde::{Deserialize, Serialize};
use serde_json::{Map, Value, json};
use utoipa::ToSchema;

/// Failure of a job: an RFC 9457 problem document without the HTTP status,
/// since no request failed. The numbers of the failure are members beside the text.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct Failure {
    /// Kind of failure, as a stable name.
    #[serde(rename = "type")]
    pub kind: String,
    /// Name of the kind, for people.
    pub title: String,
    /// Description of this occurrence.
    pub detail: String,
    /// Numbers of the failure, with units in their names: `time_s`, the
    /// offending `point` or `body`, `substep_s`, …
    #[serde(flatten)]
    pub numbers: Map<String, Value>,
}

impl Failure {
    fn new(kind: &str, title: &str, detail: String, numbers: Value) -> Self {
        let numbers = match numbers {
            Value::Object(numbers) => numbers,
            _ => Map::new(),
        };
        Self {
            kind: format!("urn:scree:failure:{kind}"),
            title: title.to_owned(),
            detail,
            numbers,
        }
    }

    /// The computation could not go on. Final: a retry would fail again.
    pub fn numerical(error: &StepError) -> Self {
        Self::new(
            "numerical",
            "The computation could not go on",
            error.to_string(),
            step_numbers(error),
        )
    }

    /// The solver could not set the scenario up.
    pub fn setup(error: &SetupError) -> Self {
        let numbers = match error {
            SetupError::TooManyPoints {
                points,
                limit,
                cell_size_m,
            } => {
                json!({"points": points, "limit": limit, "cell_size_m": cell_size_m})
            }
            SetupError::NotReducible { key, word, .. } => json!({*key: word}),
            SetupError::Threads { threads, .. } => json!({"threads": threads}),
        };
        Self::new(
            "setup",
            "The scenario could not be set up",
            error.to_string(),
            numbers,
        )
    }

    /// The job exceeds a limit of the service.
    pub fn excess(excess: &Excess) -> Self {
        let (kind, title, numbers) = match excess {
            Excess::Memory {
                needed_bytes,
                limit_bytes,
            } => (
                "memory",
                "Too much memory",
                json!({"needed_bytes": needed_bytes, "limit_bytes": limit_bytes}),
            ),
            Excess::NoMemory {
                needed_bytes,
                available_bytes,
            } => (
                "memory",
                "Too much memory",
                json!({"needed_bytes": needed_bytes, "available_bytes": available_bytes}),
            ),
            Excess::WallTime { spent_s, limit_s } => (
                "wall-time",
                "Too much wall time",
                json!({"spent_s": spent_s, "limit_s": limit_s}),
            ),
            Excess::Results {
                needed_bytes,
                limit_bytes,
            } => (
                "results-size",
                "Too large results",
                json!({"needed_bytes": needed_bytes, "limit_bytes": limit_bytes}),
            ),
        };
        Self::new(kind, title, excess.to_string(), numbers)
    }

    /// The solver failed unexpectedly; the log has the details
    /// under `error_id`.
    pub fn internal(error_id: &str) -> Self {
        Self::new(
            "internal",
            "The run broke off",
            "an internal error ended the run; the service's log has the details".to_owned(),
            json!({"error_id": error_id}),
        )
    }

    /// A resource of the run was missing more often than tolerated.
    pub fn infrastructure(times: u32, last: &str) -> Self {
        Self::new(
            "infrastructure",
            "The service could not run the job",
            format!("{times} attempts in a row failed without getting on; the last one: {last}"),
            json!({"attempts": times}),
        )
    }

    /// The process died during the job more often than tolerated.
    pub fn cut_off(times: u32) -> Self {
        Self::new(
            "cut-off",
            "The service was cut off while running the job",
            format!("the service died {times} times in a row while running this job"),
            json!({"cut_offs": times}),
        )
    }
}

fn step_numbers(error: &StepError) -> Value {
    match error {
        StepError::NonFinitePoint {
            time_s,
            point,
            quantity,
        } => {
            json!({"time_s": time_s, "point": point, "quantity": quantity})
        }
        StepError::NonFiniteBody {
            time_s,
            body,
            quantity,
        } => {
            json!({"time_s": time_s, "body": body, "quantity": quantity})
        }
        StepError::TimeStepCollapse {
            time_s,
            substep_s,
            speed_m_s,
            limit_s,
        } => json!({
            "time_s": time_s, "substep_s": substep_s, "speed_m_s": speed_m_s, "limit_s": limit_s
        }),
        StepError::PointBehindWall {
            time_s,
            point,
            wall,
            depth_m,
        } => {
            json!({"time_s": time_s, "point": point, "wall": wall, "depth_m": depth_m})
        }
        StepError::BodyBehindWall {
            time_s,
            body,
            wall,
            depth_m,
        } => {
            json!({"time_s": time_s, "body": body, "wall": wall, "depth_m": depth_m})
        }
        StepError::BodiesMerge {
            time_s,
            body,
            other,
            overlap_m,
        } => {
            json!({"time_s": time_s, "body": body, "other": other, "overlap_m": overlap_m})
        }
        StepError::BodyStepCollapse {
            time_s,
            body,
            substep_s,
            asked,
            limit,
        } => json!({
            "time_s": time_s, "body": body, "substep_s": substep_s,
            "body_substeps": asked, "limit": limit
        }),
        StepError::SpeedRunaway {
            time_s,
            mover,
            speed_m_s,
            limit_m_s,
        } => moving(
            *mover,
            json!({"time_s": time_s, "speed_m_s": speed_m_s, "limit_m_s": limit_m_s}),
        ),
        StepError::EnergyRunaway {
            time_s,
            rise_j,
            limit_j,
            mover,
            speed_m_s,
        } => moving(
            *mover,
            json!({
                "time_s": time_s, "rise_j": rise_j, "limit_j": limit_j, "speed_m_s": speed_m_s
            }),
        ),
        StepError::BodyEnergyMade {
            time_s,
            body,
            made_j,
            limit_j,
        } => json!({"time_s": time_s, "body": body, "made_j": made_j, "limit_j": limit_j}),
        StepError::Crushed {
            time_s,
            point,
            density_kg_m3,
            limit_kg_m3,
        } => json!({
            "time_s": time_s, "point": point, "density_kg_m3": density_kg_m3,
            "limit_kg_m3": limit_kg_m3
        }),
        StepError::PointInsideBody {
            time_s,
            point,
            body,
            depth_m,
        } => {
            json!({"time_s": time_s, "point": point, "body": body, "depth_m": depth_m})
        }
    }
}

/// Numbers of a failure, with the object whose motion failed.
fn moving(mover: Mover, mut numbers: Value) -> Value {
    match mover {
        Mover::Point(point) => numbers["point"] = json!(point),
        Mover::Body(body) => numbers["body"] = json!(body),
    }
    numbers
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_numerical_failure_carries_its_numbers() {
        let error = StepError::TimeStepCollapse {
            time_s: 0.25,
            substep_s: 1e-12,
            speed_m_s: 900.0,
            limit_s: 1e-10,
        };
        let document = serde_json::to_value(Failure::numerical(&error)).unwrap();
        assert_eq!(document["type"], "urn:scree:failure:numerical");
        assert_eq!(document["detail"], error.to_string());
        assert_eq!(document["time_s"], 0.25);
        assert_eq!(document["substep_s"], 1e-12);
        assert_eq!(document["speed_m_s"], 900.0);
        assert_eq!(document["limit_s"], 1e-10);
    }

    #[test]
    fn a_runaway_names_who_moves() {
        let error = |mover| StepError::SpeedRunaway {
            time_s: 0.5,
            mover,
            speed_m_s: 70.0,
            limit_m_s: 60.0,
        };
        for (mover, key, who) in [(Mover::Point(7), "point", 7), (Mover::Body(2), "body", 2)] {
            let document = serde_json::to_value(Failure::numerical(&error(mover))).unwrap();
            assert_eq!(document[key], who);
            assert_eq!(document["speed_m_s"], 70.0);
            assert_eq!(document["limit_m_s"], 60.0);
        }
    }
}
