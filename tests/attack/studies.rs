//! kill -9 while a study is computed: it has the same members and the same answers as undisturbed.

use crate::at_length;
use crate::client::{ask, get};
use crate::served::{Place, Served, scene};
use serde_json::{Value, json};
use std::time::Duration;

/// A study whose members take a fraction of a second each, to which levels are added.
fn study(members: usize) -> Value {
    json!({
        "scenario": scene(0.4),
        "inputs": [
            {"pointer": "/channel/base_friction",
             "distribution": {"uniform": {"from": 0.3, "to": 0.5}}},
            {"pointer": "/bodies/0/yaw_deg",
             "distribution": {"triangular": {"from": 0, "mode": 10, "to": 90}}},
        ],
        "design": {"sobol": {"members": members, "seed": 3}},
        "accuracy": {"quantity": "displacement_m", "body": 0, "target": 0.5,
                     "finest_cell_size_m": 0.01},
        "questions": [
            {"rest": {"body": 0, "regions": [0.5, 0.9]}},
            {"quantiles": {"quantity": "displacement_m", "body": 0, "probabilities": [0.5]}},
        ],
    })
}

fn submit(served: &Served, study: &Value) -> String {
    let answer = ask(&served.address, "POST", "/v1/studies", &study.to_string());
    let answer = answer.expect("an answer");
    assert_eq!(answer.status, 202, "{:#}", answer.body);
    format!("/v1/studies/{}", answer.body["id"].as_str().expect("an id"))
}

/// Values, outcomes and jobs' fingerprints of the members, and the answers.
fn all_of(served: &Served, study: &str) -> (Vec<Value>, Value) {
    let levels = get(&served.address, study)["study"]["finer_levels"].clone();
    let levels = levels.as_array().map_or(0, Vec::len);
    let on_level = |level: usize| {
        let members = format!("{study}/members?level={level}&limit=1000");
        let members = get(&served.address, &members)["members"].clone();
        members.as_array().expect("members").clone()
    };
    let members: Vec<Value> = (0..=levels).flat_map(on_level).collect();
    let told = members.iter().map(|member| {
        let job = format!("/v1/jobs/{}", member["job"].as_str().expect("a job"));
        let fingerprint = get(&served.address, &job)["provenance"]["fingerprint"].clone();
        let mut outcome = member["outcome"].clone();
        outcome["finished"]["quantities"]["wall_s"] = Value::Null;
        json!([
            member["level"],
            member["member"],
            member["values"],
            outcome,
            fingerprint
        ])
    });
    let answers = get(&served.address, &format!("{study}/answers"));
    (told.collect(), answers)
}

#[test]
fn a_study_killed_many_times_has_the_same_members_and_answers() {
    let _turn = crate::turn();
    let (kills, members) = (at_length(3, 20), at_length(32, 128));
    let settings = [("SCREE_RECORDING__STATE_INTERVAL_S", "0.05")];
    let undisturbed = Place::new(&settings);
    let served = undisturbed.serve();
    let path = submit(&served, &study(members));
    served.wait(&path, |study| study["status"] == "successful");
    let expected = all_of(&served, &path);
    served.kill();
    let all = expected.0.len();
    assert!(all > members, "no level was added: {:#}", expected.1);

    let place = Place::new(&settings);
    let mut served = place.serve();
    let path = submit(&served, &study(members));
    for kill in 1..=kills {
        let ended = (kill * all / (kills + 1)) as u64;
        served.wait(&path, |study| {
            study["members_ended"].as_u64() >= Some(ended)
        });
        std::thread::sleep(Duration::from_millis((kill as u64 * 37) % 100));
        served.kill();
        served = place.serve();
    }
    served.wait(&path, |study| study["status"] == "successful");
    let found = all_of(&served, &path);
    let differ = found
        .0
        .iter()
        .zip(&expected.0)
        .filter(|(a, b)| a != b)
        .count();
    crate::tell(&format!(
        "study of {all} members on several levels, {kills} kills: {differ} members differ, answers equal: {}",
        found.1 == expected.1
    ));
    assert_eq!(found, expected);
}
