//! Bytes as a config, and as settings: refused, or usable at any sampling rate, and soon.

#![no_main]

use libfuzzer_sys::fuzz_target;
use liftsim::detection::MonitorOptions;
use liftsim::monitor::{Monitor, Settings};
use liftsim::whiten::Order;

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
    let mut settings = Settings::default();
    settings.samples.reference = size(next(), default.samples.reference);
    settings.samples.shift = size(next(), default.samples.shift);
    settings.samples.scale = size(next(), default.samples.scale);
    settings.samples.gap = size(next(), default.samples.gap);
    settings.whitening.training = size(next(), default.whitening.training);
    settings.whitening.order = next().map_or(Order::Auto, |order| Order::Fixed(order as usize));
    settings.monitor.block = number(next(), default.monitor.block);
    settings.detector.alpha = number(next(), default.detector.alpha);
    settings.monitor.least_speed = number(next(), default.monitor.least_speed);
    settings.monitor.least_acceleration = number(next(), default.monitor.least_acceleration);
    settings.monitor.most_acceleration = number(next(), default.monitor.most_acceleration);
    settings.monitor.longest_motion = number(next(), default.monitor.longest_motion);
    settings.monitor.longest_slack = number(next(), default.monitor.longest_slack);
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
