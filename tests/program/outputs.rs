//! Every flag that writes a file: what exists is replaced only with --force, and `-` is standard output.

use super::track::with_a_baseline;
use super::{liftsim, outcome};
use std::fs;
use std::path::Path;
use std::process::Output;
use tempfile::TempDir;

/// A folder with what the commands read: a ride, a settled baseline, and a small result.
fn folder() -> TempDir {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path();
    for arguments in [
        "simulate --out ride.csv",
        "sweep fig6 --trials 64 --out results",
    ] {
        let run = run(path, arguments);
        assert!(run.status.success(), "{run:?}");
    }
    with_a_baseline(path);
    folder
}

fn run(folder: &Path, arguments: &str) -> Output {
    let mut command = liftsim();
    command.current_dir(folder).args(arguments.split(' '));
    command.output().expect("the program starts")
}

/// Commands with the ending of the file that they write where FILE stands.
const OUTPUTS: [(&str, &str); 14] = [
    ("simulate --out FILE", "csv"),
    ("detect ride.csv --csv FILE", "csv"),
    ("detect ride.csv --figure FILE", "svg"),
    ("detect ride.csv --save-state FILE", "json"),
    ("track ride.csv --figure FILE", "svg"),
    ("track ride.csv --report FILE", "html"),
    ("track ride.csv --baseline lift.json --spectrum FILE", "svg"),
    (
        "threshold --reference 6 --shift 6 --scale 6 --alpha 0.05 --figure FILE",
        "svg",
    ),
    ("threshold --per-hour 1 --rate 5 --figure FILE", "svg"),
    ("plot results --figure FILE", "svg"),
    (
        "sweep fig6 --trials 64 --out results --save-trials FILE",
        "npz",
    ),
    (
        "sweep fig6 --trials 64 --out elsewhere --fresh --save-trials FILE",
        "npz",
    ),
    ("new FILE --like fig6", "toml"),
    ("new FILE --like ride", "toml"),
];

#[test]
fn what_exists_is_replaced_only_with_force() {
    let folder = folder();
    let path = folder.path();
    for (command, end) in OUTPUTS {
        let name = format!("file.{end}");
        let file = path.join(&name);
        fs::write(&file, "mine").unwrap();
        let command = command.replace("FILE", &name);
        let refused = run(path, &command);
        assert_eq!(refused.status.code(), Some(2), "{command}");
        let error = String::from_utf8(refused.stderr).unwrap();
        let sentence = format!(
            "error: {name}: already exists (give another name, or --force to replace it)\n"
        );
        assert!(error.ends_with(&sentence), "{command}: {error}");
        assert_eq!(
            (&refused.stdout[..], fs::read(&file).unwrap()),
            (&b""[..], b"mine".to_vec())
        );
        let replaced = run(path, &format!("{command} --force"));
        assert!(replaced.status.success(), "{command}: {replaced:?}");
        assert_ne!(fs::read(&file).unwrap(), b"mine", "{command}");
        fs::remove_file(&file).unwrap();
    }
}

#[test]
fn a_hyphen_is_standard_output() {
    let folder = folder();
    let path = folder.path();
    for (command, end) in OUTPUTS {
        let name = format!("NAME.{end}");
        let written = run(path, &command.replace("FILE", &name));
        assert!(written.status.success(), "{command}: {written:?}");
        let printed = run(path, &command.replace("FILE", "-"));
        assert!(printed.status.success(), "{command}: {printed:?}");
        let file = fs::read(path.join(&name)).unwrap();
        assert!(printed.stdout == file, "{command}");
        // What else it says goes where warnings go.
        let says_nothing_else = command.starts_with("new ");
        assert_eq!(printed.stderr.is_empty(), says_nothing_else, "{command}");
        assert!(!path.join("-").exists() && !path.join("-.toml").exists());
        fs::remove_file(path.join(name)).unwrap();
    }
}

/// What is read again, or holds many files, is not standard output; and two files are not one.
#[test]
fn what_standard_output_cannot_be() {
    let folder = folder();
    for (arguments, message) in [
        (
            "track ride.csv --floors 0,12 --map -",
            "--map must be a file that is kept, got -",
        ),
        (
            "track ride.csv --baseline -",
            "--baseline must be a file that is kept, got -",
        ),
        (
            "monitor --map - --floors 0,12",
            "--map must be a file that is kept, got -",
        ),
        (
            "monitor --tcp localhost:9 --spool -",
            "--spool must be a file that is kept, got -",
        ),
        (
            "monitor --tcp localhost:9 --spool -",
            "--spool must be a file that is kept, got -",
        ),
        ("sweep fig6 --out -", "--out must be a directory, got -"),
        ("merge results --out -", "--out must be a directory, got -"),
        (
            "detect ride.csv --csv - --figure -",
            "-: is written to and used for something else too",
        ),
    ] {
        let mut command = liftsim();
        command
            .current_dir(folder.path())
            .args(arguments.split(' '))
            .write_stdin("0,1\n0.1,2\n");
        let (code, out, error) = outcome(&mut command);
        assert_eq!((code, out.as_str()), (2, ""), "{arguments}: {error}");
        assert!(error.contains(message), "{arguments}: {error}");
    }
}

/// A file may lie in the folder that a sweep makes.
#[test]
fn trials_beside_the_results() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path();
    let command = "sweep fig6 --trials 64 --out new/results --save-trials new/results/trials.npz";
    assert!(run(path, command).status.success());
    assert!(path.join("new/results/trials.npz").exists());
    // A refusal leaves no folder behind.
    let refused = run(
        path,
        "sweep fig6 --trials 64 --out other --save-trials nowhere/trials.npz",
    );
    assert_eq!(refused.status.code(), Some(2));
    assert!(!path.join("other").exists());
}
