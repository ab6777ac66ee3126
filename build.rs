//! The migrations are compiled in: a new one must rebuild the crate. So is the
//! commit, which every answer names.

use std::process::Command;

fn main() {
    println!("cargo:rerun-if-changed=migrations");
    if let Some(log) = git(&["rev-parse", "--git-path", "logs/HEAD"]) {
        println!("cargo:rerun-if-changed={log}");
    }
    // Built from an archive there is no commit to name.
    let commit = git(&["rev-parse", "HEAD"]).unwrap_or_else(|| "unknown".to_owned());
    // Not SCREE_…: cargo hands it to what it runs, and there that is configuration.
    println!("cargo:rustc-env=BUILD_COMMIT={commit}");
}

fn git(arguments: &[&str]) -> Option<String> {
    let output = Command::new("git").args(arguments).output().ok()?;
    let text = String::from_utf8(output.stdout).ok()?;
    (output.status.success() && !text.trim().is_empty()).then(|| text.trim().to_owned())
}
