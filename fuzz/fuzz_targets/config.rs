//! Bytes as a config, and as settings: refused, or usable at any sampling rate, and soon.

#![no_main]

use libfuzzer_sys::fuzz_target;
use liftsim::config::MonitorOptions;
use liftsim::monitor::{Monitor, Settings};

fuzz_target!(|bytes: &[u8]| {
    let Some((&choice, bytes)) = bytes.split_first() else {
        return;
    };
    if choice % 2 == 0 {
        let text = String::from_utf8_lossy(bytes);
        match MonitorOptions::parse("watch.toml", &text) {
            Ok(config) => begin(&config.settings, 100.0),
            Err(error) => assert!(!error.to_string().is_empty()),
        }
        return;
    }
    let mut numbers = bytes
        .as_chunks::<8>()
        .0
        .iter()
        .map(|eight| u64::from_le_bytes(*eight));
    let mut next = || numbers.next();
    let Some(rate) = next().map(f64::from_bits) else {
        return;
    };
    let default = Settings::default();
    let size = |given: Option<u64>, default| given.map_or(default, |given| given as usize);
    let number = |given: Option<u64>, default| given.map_or(default, f64::from_bits);
    let settings = Settings {
        reference: size(next(), default.reference),
        shift: size(next(), default.shift),
        scale: size(next(), default.scale),
        gap: size(next(), default.gap),
        training: size(next(), default.training),
        order: next().map(|order| order as usize),
        block: number(next(), default.block),
        alpha: number(next(), default.alpha),
        least_speed: number(next(), default.least_speed),
        least_acceleration: number(next(), default.least_acceleration),
        most_acceleration: number(next(), default.most_acceleration),
        longest_motion: number(next(), default.longest_motion),
        longest_slack: number(next(), default.longest_slack),
    };
    begin(&settings, rate);
});

fn begin(settings: &Settings, rate: f64) {
    match settings.at(rate) {
        Err(refusal) => assert!(!refusal.to_string().is_empty()),
        Ok(design) => {
            assert!(design.block > 0.0 && design.block <= 1.0);
            drop(Monitor::new(design, Default::default()));
        }
    }
}
