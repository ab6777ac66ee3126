//! Rules of a configuration.

use super::*;

fn shipped() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("configs/service.toml")
}

fn written(toml: &str) -> Result<ServiceConfig, ConfigError> {
    let file = tempfile::NamedTempFile::new().unwrap();
    std::fs::write(file.path(), toml).unwrap();
    ServiceConfig::default().layered(Some(file.path()), Toml::string(""))
}

#[test]
fn the_shipped_file_says_what_is_built_in() {
    let config = ServiceConfig::default()
        .layered(Some(&shipped()), Toml::string(""))
        .unwrap();
    assert_eq!(config, ServiceConfig::default());
}

#[test]
fn the_environment_wins_over_the_file() {
    let environment = Serialized::default("workers.count", 7);
    let config = ServiceConfig::default()
        .layered(Some(&shipped()), environment)
        .unwrap();
    assert_eq!(config.workers.count, Some(7));
    assert_eq!(config.limits, ServiceConfig::default().limits);
}

#[test]
fn unknown_keys_wrong_types_and_missing_files_are_refused() {
    for toml in [
        "colour = 1",
        "[workers]\nthreads = 1",
        "[limits]\nconnections = \"many\"",
        "listen = \"localhost\"",
        "listen = ",
    ] {
        let refused = written(toml);
        assert!(
            matches!(refused, Err(ConfigError::Unreadable(_))),
            "{toml}: {refused:?}"
        );
    }
    let missing = ServiceConfig::load(Some(Path::new("no/such/file.toml")));
    assert!(matches!(missing, Err(ConfigError::Missing(_))));
}

#[test]
fn workers_and_their_threads_fit_the_cores() {
    let size = |count, threads_per_worker, cores| {
        Workers {
            count,
            threads_per_worker,
        }
        .check(cores)
        .ok()
        .map(|size| (size.workers, size.threads_per_worker))
    };
    assert_eq!(size(None, None, 5), Some((5, 5)));
    assert_eq!(size(Some(1), None, 2), Some((1, 2)));
    assert_eq!(size(Some(2), Some(1), 2), Some((2, 1)));
    assert_eq!(size(Some(3), None, 2), None);
    assert_eq!(size(Some(0), None, 2), Some((0, 2)));
    assert_eq!(size(None, Some(0), 2), None);
    assert_eq!(size(None, Some(3), 2), None);
}

#[test]
fn what_types_can_not_forbid_is_refused_by_name() {
    let refused = |change: fn(&mut ServiceConfig)| {
        let mut config = ServiceConfig::default();
        change(&mut config);
        config.check(2).unwrap_err().to_string()
    };
    let nan = refused(|config| config.recording.flush_interval_s = f64::NAN);
    assert!(nan.contains("recording.flush_interval_s = NaN"), "{nan}");
    let zero = refused(|config| config.limits.connections = 0);
    assert!(zero.contains("limits.connections = 0"), "{zero}");
    for name in ["", ":memory:", "file:scree.db?mode=memory"] {
        let config = ServiceConfig {
            database: name.into(),
            ..ServiceConfig::default()
        };
        let refused = config.check(2).unwrap_err().to_string();
        assert!(
            refused.contains(&format!("database = {name:?}")),
            "{refused}"
        );
    }
    let idle = refused(|config| config.workers.count = Some(0));
    assert!(idle.contains("workers.count = 0"), "{idle}");
    let limited = refused(|config| {
        config.database = "postgres://db/scree".into();
        config.limits.database_bytes = Some(1);
    });
    assert!(limited.contains("limits.database_bytes = 1"), "{limited}");
    let open = refused(|config| config.listen = "0.0.0.0:80".parse().unwrap());
    assert!(open.contains("listen = 0.0.0.0:80"), "{open}");
    assert!(ServiceConfig::default().check(2).is_ok());
}
