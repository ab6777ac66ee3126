//! Files of `packaging/`, where they repeat what stands elsewhere.

use crate::command::ask;
use scree::config::ServiceConfig;

const UNIT: &str = include_str!("../../packaging/scree.service");
const DOCKERFILE: &str = include_str!("../../packaging/Dockerfile");

/// Value of a line `key=value` or `key = value`.
fn value<'a>(text: &'a str, key: &str) -> &'a str {
    let mut lines = text.lines().filter_map(|line| line.split_once('='));
    let (_, value) = lines.find(|(known, _)| known.trim() == key).expect(key);
    value.trim().trim_matches('"')
}

#[test]
fn the_image_is_built_by_the_projects_toolchain() {
    let channel = value(include_str!("../../rust-toolchain.toml"), "channel");
    let named = value(DOCKERFILE, "ENV RUSTUP_TOOLCHAIN");
    assert_eq!(named, channel);
    let (minor, _) = channel.rsplit_once('.').expect("three numbers");
    assert!(
        DOCKERFILE.contains(&format!("FROM rust:{minor}-")),
        "{minor}"
    );
}

#[test]
fn the_unit_waits_until_the_service_has_ended() {
    let stop_s: f64 = value(UNIT, "TimeoutStopSec").parse().unwrap();
    let drain_s = ServiceConfig::default().limits.drain_timeout_s;
    assert!(stop_s > 2.0 * drain_s, "{stop_s} s for {drain_s} s");
}

#[test]
fn unit_and_image_start_the_service_with_options_that_it_has() {
    let help = ask(&[&"serve", &"--help"]).stdout;
    let command = |line: &&str| line.starts_with("ExecStart=") || line.starts_with("CMD ");
    let lines: Vec<&str> = UNIT
        .lines()
        .chain(DOCKERFILE.lines())
        .filter(command)
        .collect();
    assert_eq!(lines.len(), 2);
    for line in lines {
        assert!(line.contains("serve"), "{line}");
        let words = line.split([' ', '"', ',']);
        for option in words.filter(|word| word.starts_with("--")) {
            assert!(help.contains(option), "{option}");
        }
    }
}
