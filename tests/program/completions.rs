//! What bash, zsh and fish offer, asked as they are when Tab is pressed. A shell that is not there is passed over.

use super::{liftsim, outcome, project};
use std::env;
use std::fs;
use std::path::Path;
use std::process::Command;

/// What a shell runs to print the words that may follow a line, one by one.
const SHELLS: [(&str, &str); 3] = [
    ("bash", BASH),
    ("zsh", ZSH),
    (
        "fish",
        "liftsim completions fish | source; complete --do-complete \"$LINE\" | string split --fields 1 \\t",
    ),
];

/// What bash does before it calls the function of the script.
const BASH: &str = r#"
    source <(liftsim completions bash)
    read -ra COMP_WORDS <<<"$LINE"
    [[ $LINE != *' ' ]] || COMP_WORDS+=('')
    COMP_CWORD=$((${#COMP_WORDS[@]} - 1))
    _clap_complete_liftsim liftsim "${COMP_WORDS[COMP_CWORD]}"
    printf '%s\n' "${COMPREPLY[@]}""#;

/// A shell within a shell, at whose prompt the line is typed. The list is printed, with descriptions after ` -- `.
const ZSH: &str = r#"
    zmodload zsh/zpty
    setopt extended_glob
    zpty shell zsh -f -i
    tell() { zpty -w shell "$1" }
    hear() {
        said=
        repeat 300; do
            zpty -rt shell part && said+=$part
            [[ $said == *$'\n'$1* ]] && return
            sleep 0.1
        done
    }
    tell 'PS1=; stty rows 500 cols 300; LISTMAX=1000; autoload -U compinit; compinit -u -D; source <(liftsim completions zsh)'
    tell 'list() { zle list-choices; zle -R; print -n "\nen""d\n" }; zle -N list; bindkey "^X" list; print "\nbeg""in"'
    hear begin
    zpty -w -n shell "$LINE"$'\C-x'
    hear end
    print -r -- "${said//$'\e['[0-9;?]#[[:alpha:]]/ }""#;

/// The words that a shell offers after a line, or nothing where there is no such shell.
fn offered(shell: &str, script: &str, folder: &Path, line: &str) -> Option<Vec<String>> {
    let program = Path::new(env!("CARGO_BIN_EXE_liftsim")).parent().unwrap();
    let path = env::var("PATH").unwrap();
    let output = Command::new(shell)
        .args(["-c", script])
        .current_dir(folder)
        .env("PATH", format!("{}:{path}", program.display()))
        .env("LINE", line)
        .output();
    let output = output.ok()?;
    let words = String::from_utf8(output.stdout).unwrap();
    let words = words.lines().filter_map(|line| line.split(" -- ").next());
    let words = words.flat_map(str::split_whitespace);
    Some(words.map(str::to_owned).collect())
}

#[test]
fn shells_complete_values() {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("fig_mine.toml"), "").unwrap();
    fs::write(folder.path().join("fig_mine.csv"), "").unwrap();
    fs::create_dir(folder.path().join("figs")).unwrap();
    for (shell, script) in SHELLS {
        let offers = |line: &str, yes: &[&str], no: &[&str]| {
            let Some(words) = offered(shell, script, folder.path(), line) else {
                println!("no {shell}: not asked");
                return;
            };
            let is_offered = |word: &&&str| words.iter().any(|it| it == *word);
            let missing: Vec<_> = yes.iter().filter(|word| !is_offered(word)).collect();
            let wrong: Vec<_> = no.iter().filter(is_offered).collect();
            assert!(
                missing.is_empty() && wrong.is_empty(),
                "{shell}, {line}: lacks {missing:?}, has {wrong:?} of {words:?}"
            );
        };
        offers("liftsim thr", &["threshold"], &["track"]);
        offers(
            "liftsim detect --unit ",
            &["m/s^2", "g", "mg", "counts"],
            &[],
        );
        offers(
            "liftsim track --axis ",
            &["z", "-z", "gravity", "auto"],
            &[],
        );
        offers("liftsim monitor --time-unit ", &["s", "ms"], &["m/s^2"]);
        offers("liftsim threshold --rule ", &["product", "wilcoxon"], &[]);
        offers("liftsim check --format ", &["junit", "github"], &[]);
        let files = ["fig_mine.toml"];
        for command in ["sweep", "plan", "check", "replay", "new mine --like"] {
            let line = format!("liftsim {command} fig");
            offers(
                &line,
                &[&files[..], &["fig6", "fig2"]].concat(),
                &["fig_mine.csv", "ride"],
            );
        }
        offers(
            "liftsim simulate ",
            &["ride", "building", "fig_mine.toml"],
            &["fig6"],
        );
        offers("liftsim new ", &["ride", "fig6"], &[]);
        offers("liftsim figures --only fig", &["fig6"], &files);
        offers("liftsim monitor --config fig", &files, &["fig6"]);
        offers("liftsim keys wh", &["whitening"], &["training"]);
    }
}

#[test]
fn every_shell_has_a_script() {
    for shell in ["bash", "zsh", "fish", "elvish", "powershell"] {
        let (code, script, _) = outcome(liftsim().args(["completions", shell]));
        assert!(code == 0 && script.contains("LIFTSIM_COMPLETE"), "{shell}");
    }
}

/// What is offered where other spellings are accepted is accepted too.
#[test]
fn what_is_offered_is_accepted() {
    let ride = project().join("none.csv");
    for (flag, more) in [
        ("--unit", &["--scale", "0.1"][..]),
        ("--axis", &[]),
        ("--time-unit", &[]),
    ] {
        let line = format!("liftsim detect {flag} ");
        let words = offered("bash", BASH, project(), &line);
        let words = words.unwrap_or_default();
        for word in &words {
            let mut command = liftsim();
            command.arg("detect").arg(&ride).args([flag, word]);
            if word == "counts" {
                command.args(more);
            }
            let (_, _, error) = outcome(&mut command);
            assert!(error.contains("none.csv"), "{flag} {word}: {error}");
        }
    }
}
