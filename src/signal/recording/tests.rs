//! Whole recordings, from small texts in memory.

use super::*;
use std::path::PathBuf;

#[test]
fn real() {
    let dir = PathBuf::from(std::env::var("LIFTSIM_RECORDINGS").unwrap());
    for sub in ["elevator-tool", "midterm"] {
        let mut files: Vec<_> = std::fs::read_dir(dir.join(sub))
            .unwrap()
            .map(|e| e.unwrap().path())
            .filter(|p| p.extension().is_some_and(|e| e == "csv"))
            .collect();
        files.sort();
        for f in files {
            let r = Recording::open(&f, &Reading::default()).unwrap();
            println!(
                "{}\n {:?} {:?} {} {:?} {} rate {}\n {:?}",
                f.display(),
                r.format(),
                r.time_column(),
                r.vertical(),
                r.acceleration_columns(),
                r.unit(),
                r.rate(),
                r.facts()
            );
            for w in r.warnings() {
                println!("  ! {w}");
            }
        }
    }
}
