//! Bytes as a saved state, or a valid one with some of its numbers replaced: refused, or a monitor that watches
//! a ride from it without harm.

#![no_main]

use libfuzzer_sys::fuzz_target;
use liftsim::monitor::{Monitor, SavedState};
use liftsim::recording::Sample;

fuzz_target!(|bytes: &[u8]| {
    let Some((&choice, bytes)) = bytes.split_first() else {
        return;
    };
    let text = match choice % 2 {
        0 => String::from_utf8_lossy(bytes).into_owned(),
        _ => damaged(bytes),
    };
    let saved = match SavedState::from_json("state.json", &text) {
        Ok(saved) => saved,
        Err(refusal) => return assert!(!refusal.to_string().is_empty()),
    };
    let design = saved.design().expect("a saved can be used");
    let again = SavedState::from_json("again.json", &saved.to_json());
    assert_eq!(again.expect("what is written can be read"), saved);
    let rate = design.rate;
    let mut monitor = Monitor::new(design, saved.knowledge);
    for number in 0..2000u32 {
        let time = f64::from(number) / rate;
        let noise = f64::from(number.wrapping_mul(2_654_435_769) >> 16) / 1e6;
        let pulse = [0.0, 0.8, 0.0, -0.8][number as usize / 100 % 4];
        let acceleration = 9.8 + noise + pulse;
        for event in monitor.step(Sample { time, acceleration }, Some(number > 1500)) {
            assert!(
                event.time.is_finite() && event.time <= event.reported,
                "{event:?}"
            );
        }
    }
});

/// Numbers and words that a state should not have.
const HOSTILE: [&str; 24] = [
    "null",
    "0",
    "-1",
    "1",
    "2",
    "8",
    "9",
    "1e-300",
    "1e-9",
    "0.5",
    "-0.5",
    "1e4",
    "1e9",
    "1e300",
    "1e999",
    "18446744073709551615",
    "4294967296",
    "100000",
    "true",
    "[]",
    "[0.1]",
    "[1,1,1,1,1,1,1,1]",
    "{}",
    "\"\"",
];

/// Each pair of bytes says which number of the valid state is replaced, and by what.
fn damaged(bytes: &[u8]) -> String {
    let mut tokens: Vec<&str> = VALID.split_inclusive([' ', ',', '[', ']', '}']).collect();
    let is_value =
        |token: &&str| token.starts_with(|c: char| c.is_ascii_digit() || "-ntf".contains(c));
    let values: Vec<usize> = (0..tokens.len())
        .filter(|place| is_value(&tokens[*place]))
        .collect();
    let mut ends = Vec::new();
    for pair in bytes.as_chunks::<2>().0.iter().take(4) {
        let place = values[usize::from(pair[0]) % values.len()];
        let end = tokens[place].trim_start_matches(|c: char| !" ,]}".contains(c));
        ends.push((place, end));
        tokens[place] = HOSTILE[usize::from(pair[1]) % HOSTILE.len()];
    }
    let mut text = String::new();
    for (place, token) in tokens.iter().enumerate() {
        text += token;
        if let Some((_, end)) = ends.iter().find(|(replaced, _)| *replaced == place) {
            text += end;
        }
    }
    text
}

const VALID: &str = r#"{"settings": {"block": 0.05, "reference": 8, "shift": 4, "scale": 4, "gap": 0, "alpha": 0.01,
"training": 40, "order": null, "least_speed": 0.2, "least_acceleration": 0.1, "most_acceleration": 2.5,
"longest_motion": 900.0, "longest_slack": 3.0}, "rate": 20.0, "knowledge": {"reference": {"level": 9.8,
"coefficients": [0.25, -0.125], "deviation": 0.02, "whiteness": 0.5, "training": 40, "span": [0.0, 2.0], "sample":
[0.01, -0.01, 0.02, -0.02, 0.015, -0.015, 0.005, -0.005]}, "begins_at_rest": true, "motion_shows": false}}"#;
