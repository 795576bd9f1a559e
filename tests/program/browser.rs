//! Pages in a real browser: `$CHROMIUM`, or one in its usual places. Where there is none a test prints that it is skipped.

use assert_cmd::Command;
use std::fs;
use std::path::{Path, PathBuf};
use std::time::Duration;

/// A browser, if there is one.
pub fn browser() -> Option<PathBuf> {
    let usual = ["chromium", "chromium-browser", "google-chrome"];
    let usual = usual.map(|name| Path::new("/usr/bin").join(name));
    let told = std::env::var_os("CHROMIUM").map(PathBuf::from);
    told.into_iter().chain(usual).find(|path| path.exists())
}

/// What the browser prints.
pub fn browse(browser: &Path, directory: &Path, flags: &[&str], file: &str) -> String {
    let profile = tempfile::tempdir().unwrap();
    let mut command = Command::new(browser);
    command.timeout(Duration::from_secs(600)).args([
        "--headless",
        "--no-sandbox",
        "--disable-gpu",
        "--disable-quic",
        "--disable-dev-shm-usage",
        "--no-first-run",
        "--disable-background-networking",
        "--disable-component-update",
        "--disable-sync",
        "--hide-scrollbars",
    ]);
    command.arg(format!("--user-data-dir={}", profile.path().display()));
    command.args(flags);
    command.arg(format!("file://{}", directory.join(file).display()));
    let output = command.output().expect("the browser starts");
    assert!(
        output.status.success(),
        "{}",
        String::from_utf8_lossy(&output.stderr)
    );
    String::from_utf8_lossy(&output.stdout).into_owned()
}

/// What a page looks like in a frame of this width: how wide it is, what runs over its edge, how much it has asked for, how
/// many pictures are there and how many are not, and how many sections.
#[derive(Debug, PartialEq, Eq)]
pub struct Seen {
    pub width: u32,
    pub over: String,
    pub asked: u32,
    pub pictures: u32,
    pub blank: u32,
    pub sections: u32,
}

/// Looks at a page, and leaves a screenshot in `target/tmp`.
pub fn look(browser: &Path, directory: &Path, page: &str, width: u32, name: &str) -> Seen {
    fs::write(directory.join("frame.html"), framed(page, width)).unwrap();
    let dom = browse(browser, directory, &["--dump-dom"], "frame.html");
    let title = dom.split("<title>").nth(1).unwrap_or_default();
    let title = title.split("</title>").next().unwrap_or_default();
    let saw: Vec<&str> = title.split('|').collect();
    let [width_seen, over, asked, pictures, blank, sections] = saw[..] else {
        panic!("the page was not seen: {title}");
    };
    let shot = Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("{name}-{width}.png"));
    let flags = [
        format!("--screenshot={}", shot.display()),
        format!("--window-size={},3600", width.max(500)),
    ];
    browse(browser, directory, &[&flags[0], &flags[1]], "frame.html");
    assert!(fs::metadata(&shot).unwrap().len() > 20_000);
    let number = |text: &str| text.parse().unwrap();
    Seen {
        width: number(width_seen),
        over: over.to_owned(),
        asked: number(asked),
        pictures: number(pictures),
        blank: number(blank),
        sections: number(sections),
    }
}

/// A page with this one in a frame of a width, whose title says what is to be seen.
fn framed(page: &str, width: u32) -> String {
    let page = page.replace('&', "&amp;").replace('"', "&quot;");
    let look = "
        const frame = document.querySelector('iframe'), inner = frame.contentDocument;
        const over = [...inner.querySelectorAll('body *')].filter(it =>
            !it.parentElement.closest('.wide') && it.getBoundingClientRect().right > frame.clientWidth + 0.5);
        const asked = frame.contentWindow.performance.getEntriesByType('resource').filter(it => !it.name.startsWith('data:'));
        const pictures = [...inner.images];
        document.title = [inner.documentElement.scrollWidth, over.map(it => it.tagName).join(' ') || 'none', asked.length,
            pictures.length, pictures.filter(it => !it.complete || it.naturalWidth === 0).length,
            inner.querySelectorAll('section').length].join('|');";
    format!(
        "<!DOCTYPE html><meta charset=\"utf-8\"><title>-</title><style>body {{ margin: 0 }} iframe {{ border: 0; width: {width}px; \
         height: 4200px }}</style><iframe srcdoc=\"{page}\"></iframe><script>onload = () => {{ {look} }}</script>"
    )
}
