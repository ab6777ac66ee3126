//! Migrations are compiled in, so a new one must rebuild the crate; so is the
//! commit, which every answer names.

use std::process::Command;

fn main() {
    println!("cargo:rerun-if-changed=migrations");
    if let Some(log) = git(&["rev-parse", "--git-path", "logs/HEAD"]) {
        println!("cargo:rerun-if-changed={log}");
    }
    // A build from an archive has no commit.
    let commit = git(&["rev-parse", "HEAD"]).unwrap_or_else(|| "unknown".to_owned());
    // Not named SCREE_…: cargo passes it on to programs it runs, which would read it as
    // configuration.
    println!("cargo:rustc-env=BUILD_COMMIT={commit}");
}

fn git(arguments: &[&str]) -> Option<String> {
    let output = Command::new("git").args(arguments).output().ok()?;
    let text = String::from_utf8(output.stdout).ok()?;
    (output.status.success() && !text.trim().is_empty()).then(|| text.trim().to_owned())
}
