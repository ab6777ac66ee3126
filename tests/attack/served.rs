//! The service as a process of its own, on a database that outlives it.

use crate::client::{ask, get};
use serde_json::{Value, json};
#[cfg(unix)]
use std::fs::{self, Permissions};
use std::io::{BufRead, BufReader, Read};
#[cfg(unix)]
use std::os::unix::fs::{MetadataExt, PermissionsExt, chown};
#[cfg(unix)]
use std::os::unix::process::CommandExt;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};
use tempfile::TempDir;

/// Longest wait for any event.
pub(crate) fn deadline() -> Duration {
    Duration::from_secs(crate::at_length(120, 1_200) as u64)
}

/// The program under attack: this build's, or the one that `ATTACK_BINARY` names.
pub(crate) fn binary() -> PathBuf {
    let named = std::env::var_os("ATTACK_BINARY");
    named.map_or_else(|| env!("CARGO_BIN_EXE_scree").into(), PathBuf::from)
}

/// Time between two polls.
pub(crate) const PAUSE: Duration = Duration::from_millis(10);

/// A directory with a database, and settings for services on it.
pub(crate) struct Place {
    directory: TempDir,
    /// URL of a database on a server, in place of a file in the directory.
    server: Option<String>,
    settings: Vec<(&'static str, String)>,
}

/// A running service; killed when it is dropped.
pub(crate) struct Served {
    child: Child,
    pub(crate) address: String,
}

impl Place {
    pub(crate) fn new(settings: &[(&'static str, &str)]) -> Self {
        let settings = settings.iter();
        Self {
            directory: TempDir::new().expect("a directory for the test"),
            server: None,
            settings: settings
                .map(|(key, value)| (*key, (*value).to_owned()))
                .collect(),
        }
    }

    pub(crate) fn database(&self) -> PathBuf {
        self.directory.path().join("scree.db")
    }

    pub(crate) fn path(&self) -> &Path {
        self.directory.path()
    }

    /// The same place with another setting.
    pub(crate) fn with(mut self, setting: (&'static str, &str)) -> Self {
        self.settings.push((setting.0, setting.1.to_owned()));
        self
    }

    /// Takes away the permission to write there; returns the user to whom that applies: no
    /// permission holds for root.
    #[cfg(unix)]
    pub(crate) fn hand_over_read_only(&self) -> u32 {
        const NOBODY: u32 = 65_534;
        let user = fs::metadata(self.path()).expect("it is there").uid();
        let user = if user == 0 { NOBODY } else { user };
        for path in [self.path(), &self.database()] {
            chown(path, Some(user), None).expect("by root, or to oneself");
        }
        fs::remove_file(self.path().join("scree.db.lock")).expect("the lock file");
        self.set_modes(0o400, 0o500);
        user
    }

    #[cfg(unix)]
    pub(crate) fn make_writable(&self) {
        self.set_modes(0o600, 0o700);
    }

    #[cfg(unix)]
    fn set_modes(&self, file: u32, folder: u32) {
        for (path, mode) in [(self.path(), folder), (&self.database(), file)] {
            fs::set_permissions(path, Permissions::from_mode(mode)).expect("by its owner");
        }
    }

    /// The same place with a database on a server.
    #[cfg(unix)]
    pub(crate) fn on_server(mut self, url: &str) -> Self {
        self.server = Some(url.to_owned());
        self
    }

    /// The settings and the database as a program's environment.
    pub(crate) fn environment<'a>(&self, command: &'a mut Command) -> &'a mut Command {
        let database = match &self.server {
            Some(url) => url.into(),
            None => self.database().into_os_string(),
        };
        let settings = self.settings.iter();
        command
            .env("SCREE_DATABASE", database)
            .envs(settings.map(|(key, value)| (*key, value.as_str())))
    }

    fn command(&self) -> Command {
        self.command_of(&binary())
    }

    fn command_of(&self, program: &Path) -> Command {
        let mut command = Command::new(program);
        self.environment(&mut command)
            .current_dir(self.path())
            .args(["serve", "--listen", "127.0.0.1:0"])
            .env("SCREE_WORKERS__THREADS_PER_WORKER", "1")
            .stdin(Stdio::null())
            .stdout(Stdio::piped());
        command
    }

    /// Starts the service and waits until it listens.
    pub(crate) fn serve(&self) -> Served {
        Self::listening(&mut self.command())
    }

    /// The same under a user, who may not be able to read the folder of the build.
    #[cfg(unix)]
    pub(crate) fn serve_as(&self, user: u32) -> Served {
        let program = tempfile::Builder::new()
            .permissions(Permissions::from_mode(0o755))
            .tempdir()
            .expect("a folder for the program");
        let path = program.path().join("scree");
        fs::copy(binary(), &path).expect("a copy of the program");
        let mut command = self.command_of(&path);
        let served = Self::listening(command.uid(user));
        // It runs without its name.
        drop(program);
        served
    }

    fn listening(command: &mut Command) -> Served {
        let child = command.stderr(Stdio::null()).spawn();
        let mut child = child.expect("the binary starts");
        let mut line = String::new();
        let stdout = child.stdout.take().expect("piped");
        BufReader::new(stdout)
            .read_line(&mut line)
            .expect("the address");
        let address = line
            .trim()
            .strip_prefix("listening on http://")
            .expect("the address");
        Served {
            address: address.to_owned(),
            child,
        }
    }

    /// Starts a service that must refuse to start; returns its exit code and error output.
    pub(crate) fn refuse(&self) -> (Option<i32>, String) {
        let child = self.command().stderr(Stdio::piped()).spawn();
        let mut child = child.expect("the binary starts");
        let status = child.wait().expect("it ends");
        let mut words = String::new();
        let mut stderr = child.stderr.take().expect("piped");
        stderr.read_to_string(&mut words).expect("words");
        (status.code(), words)
    }
}

impl Served {
    /// Kills the service with kill -9.
    pub(crate) fn kill(mut self) {
        self.child.kill().expect("it runs");
        self.child.wait().expect("it ends");
    }

    /// Stops the service in order.
    #[cfg(unix)]
    pub(crate) fn stop(mut self) {
        let id = self.child.id().to_string();
        let sent = Command::new("kill").args(["-TERM", &id]).status();
        assert!(sent.expect("kill").success());
        self.child.wait().expect("it ends");
    }

    /// Memory of the process.
    #[cfg(target_os = "linux")]
    pub(crate) fn resident_bytes(&self) -> usize {
        self.memory("VmRSS:")
    }

    /// Largest memory of the process so far.
    #[cfg(target_os = "linux")]
    pub(crate) fn peak_resident_bytes(&self) -> usize {
        self.memory("VmHWM:")
    }

    #[cfg(target_os = "linux")]
    fn memory(&self, name: &str) -> usize {
        let path = format!("/proc/{}/status", self.child.id());
        let text = fs::read_to_string(path).expect("it runs");
        let line = text.lines().find_map(|line| line.strip_prefix(name));
        let kilobytes = line.and_then(|line| line.split_whitespace().next()?.parse::<usize>().ok());
        1024 * kilobytes.expect("a number")
    }

    /// Submits a scenario that must be accepted; returns the job's path.
    pub(crate) fn submit(&self, scenario: &Value) -> String {
        let answer = ask(&self.address, "POST", "/v1/jobs", &scenario.to_string());
        let answer = answer.expect("an answer");
        assert_eq!(answer.status, 202, "{}", answer.body);
        format!("/v1/jobs/{}", answer.body["id"].as_str().expect("an id"))
    }

    /// Polls a job until it satisfies a condition.
    pub(crate) fn wait(&self, job: &str, wanted: impl Fn(&Value) -> bool) -> Value {
        let began = Instant::now();
        loop {
            let document = get(&self.address, job);
            if wanted(&document) {
                return document;
            }
            assert!(began.elapsed() < deadline(), "not as wanted: {document:#}");
            std::thread::sleep(PAUSE);
        }
    }

    pub(crate) fn wait_for_success(&self, job: &str) -> Value {
        let document = self.wait(job, has_ended);
        assert_eq!(document["status"], "successful", "{document:#}");
        document
    }
}

impl Drop for Served {
    fn drop(&mut self) {
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}

pub(crate) fn has_ended(job: &Value) -> bool {
    !["accepted", "running"].contains(&job["status"].as_str().expect("a status"))
}

/// A cube on a slope with a little flow behind it.
pub(crate) fn scene(duration_s: f64) -> Value {
    json!({
        "channel": {"inclination_deg": 30, "incline_length_m": 0.4, "runout_length_m": 0.4,
                    "width_m": 0.1},
        "flow": {"volume_m3": 0.0003, "release": {"height_m": 0.04, "toe_distance_m": 0.05}},
        "bodies": [{"shape": {"cube": {"side_m": 0.04}}}],
        "duration_s": duration_s,
        "sample_interval_s": 0.01,
        "flow_snapshots": 5,
        // Run for the full duration, although it comes to rest before.
        "numerics": {"cell_size_m": 0.02, "points_per_cell": 4, "ending": "full"}
    })
}

/// The same in finer cells: minutes of computation for a few simulated seconds.
pub(crate) fn fine_scene(duration_s: f64) -> Value {
    let mut scene = scene(duration_s);
    scene["numerics"]["cell_size_m"] = json!(0.01);
    scene["numerics"]["points_per_cell"] = json!(8);
    scene
}

/// The same in cells fine enough for a run of half a minute.
pub(crate) fn finest_scene(duration_s: f64) -> Value {
    let mut scene = fine_scene(duration_s);
    scene["numerics"]["cell_size_m"] = json!(0.005);
    scene
}

/// A cube alone for a short time: almost nothing to compute.
pub(crate) fn trifle() -> Value {
    let mut scene = scene(0.01);
    scene["flow"] = Value::Null;
    scene
}
