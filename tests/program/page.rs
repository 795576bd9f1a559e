//! `liftsim track --report`: one page that says all of it, asks for nothing, and fits a screen, a phone and paper.

use super::browser::{Seen, browse, browser, look};
use super::recordings::{Said, recorded, well};
use super::{liftsim, outcome};
use quick_xml::Reader;
use quick_xml::events::Event;
use serde_json::Value;
use std::fs;
use std::path::Path;

fn track(directory: &Path, arguments: &[&str]) -> Said {
    let mut command = liftsim();
    command.current_dir(directory).arg("track").args(arguments);
    outcome(&mut command)
}

/// The page of a recording.
fn page(directory: &Path, arguments: &[&str]) -> String {
    let report = ["--report", "page.html", "--force"];
    let (code, _, err) = track(directory, &[arguments, &report].concat());
    assert_eq!(code, 0, "{err}");
    fs::read_to_string(directory.join("page.html")).unwrap()
}

/// The second stop is between floors, and some rides are short.
const BUILDING: [&str; 14] = [
    "--speed",
    "1.6",
    "--acceleration",
    "1",
    "--trip",
    "up:3.2",
    "--trip",
    "up:4.9",
    "--trip",
    "down:4.9",
    "--trip",
    "up:9.6",
    "--trip",
    "down:12.8",
];
const FLOORS: [&str; 5] = ["ride.csv", "--floors", "0,3.2,6.4,9.6,12.8", "--at", "0"];

const SECTIONS: [&str; 8] = [
    "picture",
    "rides",
    "alarms",
    "quality",
    "figures",
    "undecided",
    "sensor",
    "made",
];

/// Every element that is begun is ended, by a reader of XML; what HTML leaves open is a line of its own.
pub fn assert_well_formed(page: &str) {
    let head = page.find("<title>").unwrap();
    let voids = page[..head].matches("<meta").count();
    assert_eq!(page.matches("<meta").count(), voids);
    let body = format!("<html>{}", &page[head..]).replace("</head>", "");
    let mut reader = Reader::from_str(&body);
    let mut depth = 0;
    loop {
        match reader
            .read_event()
            .unwrap_or_else(|error| panic!("{error}"))
        {
            Event::Start(start) => {
                depth += 1;
                start.attributes().for_each(|it| drop(it.unwrap()));
            }
            Event::End(_) => depth -= 1,
            Event::Eof => break,
            _ => {}
        }
    }
    assert_eq!(depth, 0);
}

/// Nothing in it leads elsewhere.
fn assert_alone(page: &str) {
    assert!(page.contains("default-src 'none'"));
    for leads in [
        "http:", "https:", "src=", "href", "url(", "@import", "<script", "<link", "<iframe",
    ] {
        assert!(!page.contains(leads), "{leads}");
    }
}

#[test]
fn a_page_has_all_of_it() {
    let directory = recorded(&BUILDING);
    let path = directory.path();
    let page = page(path, &FLOORS);
    assert_well_formed(&page);
    assert_alone(&page);
    let places = SECTIONS.map(|id| page.find(&format!("<section id=\"{id}\"")));
    assert!(
        places.iter().all(Option::is_some) && places.is_sorted(),
        "{places:?}"
    );
    let report = well(track(
        path,
        &[&FLOORS[..], &["--quality", "--format", "json"]].concat(),
    ));
    let report: Value = serde_json::from_str(&report).unwrap();
    let rides = report["rides"].as_array().unwrap();
    assert_eq!(rides.len(), 5);
    for ride in rides {
        let number = |name: &str| ride[name].as_f64().unwrap();
        for shown in [
            format!(
                "{:.3}<span class=\"within\"> ± {:.3}",
                number("distance"),
                number("deviation")
            ),
            format!("{:.2}", number("start")),
            format!(
                "{:.2}",
                ride["quality"]["acceleration"]["value"].as_f64().unwrap()
            ),
        ] {
            assert!(page.contains(&shown.replace('-', "−")), "{shown}");
        }
    }
    for said in [
        "5 rides in",
        "no undecided stretch, 1 alarm.",
        "✗ alarm: between floors",
        "Ride 2, judged again by ride 3: alarm, between floors",
        "0 → 1",
        "off every floor",
        "GB/T 10058-2009, from memory",
        "✓ within limits",
        "100.0 Hz",
        "role=\"img\"",
    ] {
        assert!(page.contains(said), "{said}");
    }
}

/// By any name and from anywhere.
#[test]
fn the_same_recording_gives_the_same_bytes() {
    let directory = recorded(&BUILDING);
    let path = directory.path();
    let first = page(path, &FLOORS);
    let absolute = path.join("ride.csv").display().to_string();
    let again = page(path, &[&[&absolute[..]], &FLOORS[1..]].concat());
    assert!(first == again);
    let folder = path.file_name().unwrap().to_string_lossy().into_owned();
    assert!(!first.contains(&folder));
}

#[test]
fn what_comes_from_a_file_is_escaped() {
    let directory = recorded(&[]);
    let path = directory.path();
    let text = fs::read_to_string(path.join("ride.csv")).unwrap();
    let rows = text.lines().skip(1).map(|line| {
        let cells: Vec<&str> = line.split(',').collect();
        format!("{},{}\n", cells[0], cells[3])
    });
    let column = "<script>alert('1')</script>&amp;";
    let rows: String = rows.collect();
    let name = "<script>\"&'<b>.csv";
    fs::write(
        path.join(name),
        format!("time,\"{column} (m/s^2)\"\n{rows}"),
    )
    .unwrap();
    let column = format!("{column} (m/s^2)");
    let page = page(path, &[name, "--time", "time", "--acceleration", &column]);
    assert_well_formed(&page);
    assert_alone(&page);
    assert!(
        page.contains("<h1>&lt;script&gt;&quot;&amp;'&lt;b&gt;.csv</h1>"),
        "{page}"
    );
    assert!(page.contains("&lt;script&gt;alert('1')&lt;/script&gt;&amp;amp;"));
}

/// A page of little says how little, and why.
#[test]
fn what_is_not_there_is_said() {
    let still = recorded(&["--still", "--rest", "20"]);
    let slow = recorded(&["--rate", "10"]);
    for (directory, flags, said) in [
        (
            &still,
            &[][..],
            &[
                "No ride in ",
                "No rides: the record stays at its level.",
                "no floors were given",
            ][..],
        ),
        (
            &slow,
            &[],
            &["No ride is judged: at 10.0 Hz the record holds no vibration"],
        ),
        (
            &slow,
            &["--from", "12", "--begins", "motion"],
            &[
                "not recorded",
                "not measured",
                "No distance, the record does not hold its start",
            ],
        ),
    ] {
        let page = page(directory.path(), &[&["ride.csv"], flags].concat());
        assert_well_formed(&page);
        for said in said {
            let lower = page.to_lowercase();
            assert!(lower.contains(&said.to_lowercase()), "{said}");
        }
    }
}

#[test]
fn nothing_is_overwritten_unasked() {
    let directory = recorded(&["--rate", "25"]);
    let path = directory.path();
    for (flags, message) in [
        (
            &["--report", "ride.csv"][..],
            "--report must end in .html or .htm",
        ),
        (&["--report", "no/page.html"], "no folder no"),
        (
            &["--report", "a.html", "--map", "a.html"],
            "used for something else too",
        ),
    ] {
        let (code, out, err) = track(path, &[&["ride.csv"], flags].concat());
        assert_eq!((code, out.as_str()), (2, ""), "{err}");
        assert!(err.contains(message), "{err}");
    }
    let once = ["ride.csv", "--report", "page.html", "--rated-speed", "1"];
    assert_eq!(track(path, &once).0, 0);
    let first = fs::read(path.join("page.html")).unwrap();
    let (code, _, err) = track(path, &once);
    assert!(code == 2 && err.contains("already exists"), "{err}");
    assert_eq!(fs::read(path.join("page.html")).unwrap(), first);
    assert_eq!(track(path, &[&once[..], &["--force"]].concat()).0, 0);
}

/// On a screen and on a phone nothing runs over the edge and nothing is asked for, a long name and an alarm included; on paper
/// every page begins with a section. Screenshots are left in `target/tmp`.
#[test]
fn a_browser_shows_it_whole() {
    let Some(browser) = browser() else {
        eprintln!("skipped: no browser (CHROMIUM names one): the page was not opened");
        return;
    };
    let directory = recorded(&BUILDING);
    let path = directory.path();
    let long = format!("{}.csv", "a_long_name_without_a_space".repeat(4));
    fs::rename(path.join("ride.csv"), path.join(&long)).unwrap();
    let page = page(path, &[&[&long[..]], &FLOORS[1..]].concat());
    for width in [1280, 390] {
        let seen = look(&browser, path, &page, width, "recording");
        let expected = Seen {
            width,
            over: "none".to_owned(),
            asked: 0,
            pictures: 0,
            blank: 0,
            sections: SECTIONS.len() as u32,
        };
        assert_eq!(seen, expected, "{width}");
    }
    let pdf = path.join("page.pdf").display().to_string();
    let print = format!("--print-to-pdf={pdf}");
    browse(
        &browser,
        path,
        &["--no-pdf-header-footer", &print],
        "page.html",
    );
    let Ok(text) = std::process::Command::new("pdftotext")
        .args([&pdf, "-"])
        .output()
    else {
        eprintln!("skipped: no pdftotext: the pages were not read");
        return;
    };
    let text = String::from_utf8(text.stdout).unwrap();
    let pages: Vec<&str> = text.trim_end_matches('\x0c').split('\x0c').collect();
    let titles: Vec<&str> = page
        .split("<h2>")
        .skip(1)
        .filter_map(|rest| rest.split("</h2>").next())
        .collect();
    assert!((2..=SECTIONS.len()).contains(&pages.len()), "{text}");
    for page in &pages[1..] {
        let first = page.trim_start().lines().next().unwrap_or_default();
        assert!(titles.contains(&first), "{first}");
    }
}
