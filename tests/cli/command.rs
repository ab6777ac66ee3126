//! Starts the real binary.

use serde_json::{Value, json};
use std::ffi::OsStr;
use std::io::{BufRead, BufReader, Write};
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Output, Stdio};

/// Result of a command.
#[derive(Debug)]
pub(crate) struct Answer {
    pub(crate) code: Option<i32>,
    pub(crate) stdout: String,
    pub(crate) stderr: String,
}

impl From<Output> for Answer {
    fn from(output: Output) -> Self {
        let text = |bytes| String::from_utf8(bytes).expect("UTF-8");
        Self {
            code: output.status.code(),
            stdout: text(output.stdout),
            stderr: text(output.stderr),
        }
    }
}

/// The binary, in a directory without a configuration, and without that of whoever runs the tests.
pub(crate) fn scree() -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_scree"));
    command
        .current_dir(env!("CARGO_TARGET_TMPDIR"))
        .env("XDG_CONFIG_HOME", env!("CARGO_TARGET_TMPDIR"))
        .env_remove("SCREE_URL")
        .env_remove("SCREE_TOKEN")
        .stdin(Stdio::null());
    command
}

/// Runs the binary to its end.
pub(crate) fn ask(arguments: &[&dyn AsRef<OsStr>]) -> Answer {
    let output = scree().args(arguments.iter().map(|a| a.as_ref())).output();
    output.expect("the binary starts").into()
}

/// Runs the binary with this standard input.
pub(crate) fn ask_with_input(arguments: &[&str], input: &str) -> Answer {
    let mut child = scree()
        .args(arguments)
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .expect("the binary starts");
    let mut stdin = child.stdin.take().expect("piped");
    stdin.write_all(input.as_bytes()).expect("the binary reads");
    drop(stdin);
    child.wait_with_output().expect("the binary ends").into()
}

/// A service, killed when this is dropped.
pub(crate) struct Served {
    pub(crate) child: Child,
    /// Its address, with the port.
    pub(crate) address: String,
}

impl Served {
    /// Starts a service on this database and waits until it listens.
    pub(crate) fn start(database: &Path, stderr: Stdio) -> Self {
        Self::start_with(&["--listen", "127.0.0.1:0"], database, stderr)
    }

    /// Starts a service with these arguments.
    pub(crate) fn start_with(arguments: &[&str], database: &Path, stderr: Stdio) -> Self {
        let mut child = scree()
            .arg("serve")
            .args(arguments)
            .arg("--database")
            .arg(database)
            .stdout(Stdio::piped())
            .stderr(stderr)
            .spawn()
            .expect("the binary starts");
        let mut line = String::new();
        let stdout = child.stdout.take().expect("piped");
        BufReader::new(stdout).read_line(&mut line).expect("a line");
        let address = line.trim().strip_prefix("listening on http://");
        Self {
            address: address.expect("the address").to_owned(),
            child,
        }
    }
}

impl Drop for Served {
    fn drop(&mut self) {
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}

/// A directory with a scenario file in it.
pub(crate) struct Scene {
    directory: tempfile::TempDir,
}

impl Scene {
    pub(crate) fn new(scenario: &Value) -> Self {
        let directory = tempfile::tempdir().expect("a directory for the test");
        let scene = Self { directory };
        std::fs::write(scene.file(), scenario.to_string()).expect("writable");
        scene
    }

    /// The scenario file.
    pub(crate) fn file(&self) -> PathBuf {
        self.path("scenario.json")
    }

    pub(crate) fn path(&self, name: &str) -> PathBuf {
        self.directory.path().join(name)
    }
}

/// A scene of a few hundred points and a tenth of a second in which the flow
/// hits the cube: realistic, but fast to compute.
pub(crate) fn tiny() -> Value {
    json!({
        "title": "tiny",
        "channel": {"inclination_deg": 40, "incline_length_m": 0.2, "runout_length_m": 0.3, "width_m": 0.06},
        "flow": {
            "volume_m3": 1e-4,
            "release": {"height_m": 0.03, "toe_distance_m": 0.0}
        },
        "bodies": [{"shape": {"cube": {"side_m": 0.02}}, "sphero_radius_m": 0.001,
                    "position": {"downstream_m": 0.015}}],
        "duration_s": 0.1,
        "flow_snapshots": 3,
        "numerics": {"cell_size_m": 0.01}
    })
}

/// The tiny scene on finer cells and with samples in quick succession: some seconds of work.
pub(crate) fn long() -> Value {
    let mut scenario = tiny();
    scenario["numerics"] = json!({"cell_size_m": 0.0031, "threads": 1, "ending": "full"});
    scenario["duration_s"] = json!(0.5);
    scenario["sample_interval_s"] = json!(0.001);
    scenario["flow_snapshots"] = json!(30);
    scenario
}

/// The tiny scene with a block of 1,000,000 kg/m³ that falls on the cube, whose
/// contact can only carry its own weight.
pub(crate) fn unstable() -> Value {
    let mut scenario = tiny();
    let mut block = scenario["bodies"][0].clone();
    block["position"]["elevation_m"] = json!(0.1);
    block["density_kg_m3"] = json!(1e6);
    scenario["bodies"][0]["contact_modulus_pa"] = json!(1e6);
    scenario["bodies"] = json!([scenario["bodies"][0], block]);
    scenario["duration_s"] = json!(0.5);
    scenario["sample_interval_s"] = json!(0.0001);
    scenario
}

/// A JSON file.
pub(crate) fn json_file(path: &Path) -> Value {
    let text = std::fs::read_to_string(path).unwrap_or_else(|e| panic!("{}: {e}", path.display()));
    serde_json::from_str(&text).expect("JSON")
}
