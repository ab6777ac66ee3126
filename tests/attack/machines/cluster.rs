//! A database server, and services and workers on it.

use crate::served::{Place, binary};
use std::path::Path;
use std::process::{Child, Command, Stdio};
use tempfile::TempDir;

/// A PostgreSQL server of a test; it ends with it.
pub(crate) struct Server {
    directory: TempDir,
    pub(crate) url: String,
}

/// A worker process; killed when it is dropped.
pub(crate) struct Worker(Child);

impl Server {
    pub(crate) fn start() -> Self {
        let directory = tempfile::Builder::new()
            // The server's user may be another one.
            .permissions(std::os::unix::fs::PermissionsExt::from_mode(0o755))
            .tempdir()
            .expect("a directory for the server");
        let url = start(directory.path());
        Self { directory, url }
    }

    /// Kills the server with kill -9 and starts it again.
    pub(crate) fn crash(&self) {
        postgres("kill", self.directory.path());
        assert_eq!(start(self.directory.path()), self.url);
    }

    /// A place whose services and workers use this server.
    pub(crate) fn place(&self, settings: &[(&'static str, &str)]) -> Place {
        Place::new(settings).on_server(&self.url)
    }
}

impl Drop for Server {
    fn drop(&mut self) {
        postgres("stop", self.directory.path());
    }
}

fn start(directory: &Path) -> String {
    postgres("start", directory)
}

fn postgres(verb: &str, directory: &Path) -> String {
    let script = Path::new(env!("CARGO_MANIFEST_DIR")).join(".ci/postgres");
    let answer = Command::new(script)
        .arg(verb)
        .arg(directory.join("server"))
        .stderr(Stdio::inherit())
        .output()
        .expect("the script starts");
    assert!(answer.status.success(), "postgres {verb}");
    String::from_utf8_lossy(&answer.stdout).trim().to_owned()
}

impl Worker {
    /// Starts a worker process with one thread.
    pub(crate) fn start(place: &Place, arguments: &[&str]) -> Self {
        let child = place
            .environment(&mut Command::new(binary()))
            .current_dir(place.path())
            .args(["work", "--threads", "1"])
            .args(arguments)
            .stdin(Stdio::null())
            .stderr(Stdio::null())
            .spawn();
        Self(child.expect("the binary starts"))
    }

    /// Kills it with kill -9.
    pub(crate) fn kill(mut self) {
        self.0.kill().expect("it runs");
        self.0.wait().expect("it ends");
    }

    /// Sends a signal.
    pub(crate) fn signal(&self, signal: &str) {
        let id = self.0.id().to_string();
        let sent = Command::new("kill").args([signal, &id]).status();
        assert!(sent.expect("kill").success());
    }

    /// Waits until it ends by itself; returns its exit code.
    pub(crate) fn end(mut self) -> Option<i32> {
        self.0.wait().expect("it ends").code()
    }
}

impl Drop for Worker {
    fn drop(&mut self) {
        let _ = self.0.kill();
        let _ = self.0.wait();
    }
}
