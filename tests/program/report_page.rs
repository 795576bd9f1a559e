//! `liftsim figures --html`: the report as one page, with every picture in it.

use super::browser::{Seen, browser, look};
use super::{liftsim, outcome, project};
use std::fs;
use std::path::Path;
use tempfile::TempDir;

/// A copy of the committed results.
fn results() -> TempDir {
    let place = tempfile::tempdir().unwrap();
    for entry in fs::read_dir(project().join("results")).unwrap() {
        let from = entry.unwrap().path();
        let to = place.path().join("results").join(from.file_name().unwrap());
        if !from.is_dir() {
            continue;
        }
        fs::create_dir_all(&to).unwrap();
        for file in fs::read_dir(from).unwrap() {
            let file = file.unwrap().path();
            if file.is_file() {
                fs::copy(&file, to.join(file.file_name().unwrap())).unwrap();
            }
        }
    }
    place
}

/// Of the committed results; nothing is counted but what `fig6` lacks.
fn figures(place: &Path, arguments: &[&str]) -> (i32, String, String) {
    let mut command = liftsim();
    let configs = project().join("configs");
    command
        .current_dir(place)
        .args(["figures", "--only", "fig6", "--configs"]);
    outcome(command.arg(configs).args(arguments))
}

fn number_of(text: &str, part: &str) -> u32 {
    text.matches(part).count().try_into().unwrap()
}

/// The page has what the Markdown has: every part, every row of a table, every picture, every link that leads to a place of
/// its own, and nothing that leads elsewhere. A browser shows all of it, on a screen and on a phone.
#[test]
fn the_page_is_the_report() {
    let place = results();
    let place = place.path();
    let (code, out, err) = figures(place, &["--html", "page.html"]);
    assert_eq!((code, err.as_str()), (0, ""));
    assert!(out.contains("page.html  written"), "{out}");
    let markdown = fs::read_to_string(place.join("results/README.md")).unwrap();
    let page = fs::read_to_string(place.join("page.html")).unwrap();
    assert!(page.len() < 15_000_000, "{}", page.len());
    assert!(page.contains("default-src 'none'"));
    for leads in [
        "http:", "https:", "url(", "@import", "<script", "<link", "<iframe", "srcset",
    ] {
        assert!(!page.contains(leads), "{leads}");
    }
    let pictures = number_of(&markdown, "![");
    assert!(pictures > 50);
    assert_eq!(number_of(&page, "src="), pictures);
    assert_eq!(
        number_of(&page, "src=\"data:image/svg+xml;base64,"),
        pictures
    );
    let heads = number_of(&markdown, "\n|---|");
    let rows = markdown
        .lines()
        .filter(|line| line.starts_with("| "))
        .count() as u32;
    assert_eq!(number_of(&page, "<table"), heads);
    assert_eq!(number_of(&page, "<tr>"), rows);
    let places = page
        .split("href=\"")
        .skip(1)
        .map(|rest| rest.split('"').next().unwrap());
    for place in places {
        let id = place
            .strip_prefix('#')
            .unwrap_or_else(|| panic!("{place} leads elsewhere"));
        assert_eq!(number_of(&page, &format!(" id=\"{id}\"")), 1, "{id}");
        let is_named = markdown.contains(&format!("<a id=\"{id}\">"));
        assert!(
            is_named
                || markdown
                    .to_lowercase()
                    .contains(&format!("## {}", id.replace('-', " "))),
            "{id}"
        );
    }
    let Some(browser) = browser() else {
        eprintln!("skipped: no browser (CHROMIUM names one): the page was not opened");
        return;
    };
    for width in [1280, 390] {
        let expected = Seen {
            width,
            over: "none".to_owned(),
            asked: 0,
            pictures,
            blank: 0,
            sections: number_of(&markdown, "\n## ") - 1,
        };
        assert_eq!(
            look(&browser, place, &page, width, "report"),
            expected,
            "{width}"
        );
    }
}

/// A page that is there is kept, unless it may be replaced; that is said before anything is counted.
#[test]
fn a_page_is_not_replaced_unasked() {
    let place = tempfile::tempdir().unwrap();
    fs::write(place.path().join("page.html"), "mine").unwrap();
    for (flags, message) in [
        (
            &["--html", "page.html"][..],
            "page.html: already exists (give another name, or --force to replace it)",
        ),
        (
            &["--html", "page.md"],
            "--html must end in .html or .htm, got page.md",
        ),
        (&["--html", "no/page.html"], "no folder no"),
    ] {
        let (code, out, err) = figures(place.path(), flags);
        assert_eq!((code, out.as_str()), (2, ""), "{err}");
        assert!(err.contains(message), "{err}");
    }
    assert_eq!(fs::read(place.path().join("page.html")).unwrap(), b"mine");
    assert!(!place.path().join("results").exists());
}
