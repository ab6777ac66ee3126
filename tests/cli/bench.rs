//! `scree bench`.

use crate::command::ask;
use serde_json::Value;

#[test]
fn the_collapse_is_measured_as_json() {
    let answer = ask(&[
        &"bench",
        &"--only",
        &"s200k",
        &"--points",
        &"4000",
        &"--repeats",
        &"1",
        &"--json",
    ]);
    assert_eq!((answer.code, answer.stderr.as_str()), (Some(0), ""));
    let report: Value = serde_json::from_str(&answer.stdout).unwrap();
    assert!(report["machine"]["cores"].as_u64() >= Some(1));
    assert!(report.get("size").is_none(), "nobody asked for it");
    let ways = report["s200k"]["ways"].as_array().unwrap();
    for precision in ["single", "double"] {
        for transfer in ["moving", "every"] {
            let is_it = |way: &&Value| {
                way["precision"] == precision && way["transfer"] == transfer && way["threads"] == 1
            };
            assert!(ways.iter().any(|way| is_it(&way)), "{precision} {transfer}");
        }
    }
    for way in ways {
        let (rate, measured) = (&way["point_steps_per_s"], &way["measured"]);
        let steps = measured["steps"].as_u64().unwrap();
        let substeps = measured["substeps"].as_u64().unwrap();
        assert!(rate.as_f64() > Some(1e3), "{way}");
        assert!(substeps >= 8, "{way}");
        assert_eq!(way["transfer"] == "every", steps == substeps, "{way}");
    }
}

#[test]
fn the_bits_of_the_collapse_are_compared_in_a_table() {
    let answer = ask(&[
        &"bench",
        &"--only",
        &"threads",
        &"--points",
        &"1000",
        &"--repeats",
        &"2",
    ]);
    assert_eq!((answer.code, answer.stderr.as_str()), (Some(0), ""));
    for words in ["cores", "M point-steps/s", "the same bits"] {
        assert!(answer.stdout.contains(words), "{}", answer.stdout);
    }
}
