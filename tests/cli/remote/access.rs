//! Where the service is, and the right to use it.

use crate::command::{Answer, Scene, Served, ask, scree, tiny};
use std::fs;
use std::path::PathBuf;
use std::process::{Command, Stdio};

/// A service that needs a token.
struct Guarded {
    scene: Scene,
    served: Served,
    token: String,
}

impl Guarded {
    fn new() -> Self {
        let scene = Scene::new(&tiny());
        let made = ask(&[&"token", &"lab", &"--scope", &"submit", &"--scope", &"read"]);
        let token = made.stdout.lines().nth(1).expect("a token");
        let token = token.trim_start_matches("# ").to_owned();
        let config = scene.path("service.toml");
        fs::write(&config, made.stdout).unwrap();
        let arguments = [
            "--listen",
            "127.0.0.1:0",
            "--config",
            config.to_str().unwrap(),
        ];
        let served = Served::start_with(&arguments, &scene.path("test.db"), Stdio::null());
        Self {
            scene,
            served,
            token,
        }
    }

    fn url(&self) -> String {
        format!("http://{}", self.served.address)
    }

    /// Writes a file for its owner alone.
    fn write(&self, name: &str, text: &str) -> PathBuf {
        let path = self.scene.path(name);
        fs::write(&path, text).unwrap();
        #[cfg(unix)]
        set_mode(&path, 0o600);
        path
    }

    /// Result of a list of jobs with this change.
    fn list(&self, change: impl FnOnce(&mut Command)) -> Answer {
        let mut command = scree();
        command.args(["get", "--url", &self.url()]);
        change(&mut command);
        command.output().expect("the binary starts").into()
    }
}

#[cfg(unix)]
fn set_mode(path: &std::path::Path, mode: u32) {
    use std::os::unix::fs::PermissionsExt;
    fs::set_permissions(path, fs::Permissions::from_mode(mode)).unwrap();
}

#[test]
fn a_token_comes_from_file_environment_client_file_or_flag() {
    let guarded = Guarded::new();
    let (url, token) = (guarded.url(), guarded.token.as_str());
    let quietly = |answer: Answer| {
        // The note on an empty list.
        assert_eq!(
            (answer.code, answer.stderr.as_str()),
            (Some(0), "no jobs\n")
        );
    };
    let token_file = guarded.write("token", &format!("{token}\n"));
    quietly(guarded.list(|command| {
        command.arg("--token-file").arg(&token_file);
    }));
    quietly(guarded.list(|command| {
        command.env("SCREE_TOKEN", token);
    }));
    let text = format!("url = \"{url}/\"\ntoken = \"{token}\"\n");
    let client_file = guarded.write("client.toml", &text);
    let answer = scree()
        .arg("get")
        .arg("--client-file")
        .arg(&client_file)
        .output();
    quietly(answer.unwrap().into());

    let warned = guarded.list(|command| {
        command.args(["--token", token]);
    });
    assert_eq!(warned.code, Some(0));
    assert!(warned.stderr.contains("warning"), "{}", warned.stderr);
    assert!(!warned.stderr.contains(token), "{}", warned.stderr);
}

#[test]
fn without_a_good_token_it_is_told_where_one_can_come_from() {
    let guarded = Guarded::new();
    let (none, wrong) = (
        guarded.list(|_| {}),
        guarded.list(|command| {
            command.env("SCREE_TOKEN", "scree_other");
        }),
    );
    // The token of the client file is for its own service.
    let text = format!(
        "url = \"http://127.0.0.1:1\"\ntoken = \"{}\"\n",
        guarded.token
    );
    let client_file = guarded.write("client.toml", &text);
    let elsewhere = guarded.list(|command| {
        command.arg("--client-file").arg(&client_file);
    });
    for answer in [none, wrong, elsewhere] {
        assert_eq!((answer.code, answer.stdout.as_str()), (Some(1), ""));
        for word in ["SCREE_TOKEN", "--token-file", "client.toml", &guarded.url()] {
            assert!(answer.stderr.contains(word), "{word}: {}", answer.stderr);
        }
    }
}

#[cfg(unix)]
#[test]
fn a_token_that_others_can_read_is_refused() {
    let guarded = Guarded::new();
    let token_file = guarded.write("token", &guarded.token);
    let client_file = guarded.write("client.toml", &format!("token = \"{}\"", guarded.token));
    for (flag, path) in [
        ("--token-file", &token_file),
        ("--client-file", &client_file),
    ] {
        for (mode, shown) in [(0o640, "0640"), (0o604, "0604")] {
            set_mode(path, mode);
            let answer = guarded.list(|command| {
                command.arg(flag).arg(path);
            });
            assert_eq!(answer.code, Some(2), "{}", answer.stderr);
            let how = format!("chmod 600 {}", path.display());
            for word in [shown, &how] {
                assert!(answer.stderr.contains(word), "{word}: {}", answer.stderr);
            }
            assert!(!answer.stderr.contains(&guarded.token));
        }
    }
    // Without a token it holds no secret.
    fs::write(&client_file, format!("url = \"{}\"", guarded.url())).unwrap();
    let answer = guarded.list(|command| {
        command.arg("--client-file").arg(&client_file);
        command.env("SCREE_TOKEN", &guarded.token);
    });
    assert_eq!(answer.code, Some(0), "{}", answer.stderr);
}

#[test]
fn without_an_address_it_is_told_how_to_give_one() {
    let answer = ask(&[&"get"]);
    assert_eq!((answer.code, answer.stdout.as_str()), (Some(2), ""));
    for word in ["--url", "SCREE_URL", "client.toml"] {
        assert!(answer.stderr.contains(word), "{word}: {}", answer.stderr);
    }
}

/// The variables are for clients, and no keys of the service's configuration.
#[test]
fn a_service_starts_in_the_environment_of_a_client() {
    let scene = Scene::new(&tiny());
    let mut command = scree();
    command
        .args([
            "serve",
            "--until-stdin-ends",
            "--listen",
            "127.0.0.1:0",
            "--database",
        ])
        .arg(scene.path("test.db"))
        .env("SCREE_URL", "http://127.0.0.1:1")
        .env("SCREE_TOKEN", "scree_x");
    let output = command.output().unwrap();
    assert_eq!(output.status.code(), Some(0), "{output:?}");
}
