//! Bytes as a pipe: lines of readings, and then, since text grows samples slowly, a score of which each pair
//! of bytes is a stretch of rest, of acceleration, of silence or of the drum turning. A monitor watches both.

#![no_main]

use libfuzzer_sys::fuzz_target;
use liftsim::monitor::{Design, Kind, Knowledge, Monitor, Settings};
use liftsim::recording::{LineReader, Reading, Sample};
use std::cell::OnceCell;

fuzz_target!(|bytes: &[u8]| {
    let Some((&choice, bytes)) = bytes.split_first() else {
        return;
    };
    let end = bytes
        .iter()
        .position(|byte| *byte == 0)
        .unwrap_or(bytes.len());
    let (text, score) = bytes.split_at(end);
    let mut watch = Watch::new(choice);
    read(text, choice & 1 == 1, &mut watch);
    play(score, &mut watch);
});

/// Reads lines until the end, whatever is refused.
fn read(text: &[u8], has_drum: bool, watch: &mut Watch) {
    let mut lines = match has_drum {
        true => LineReader::with_drum(text, &Reading::default()),
        false => LineReader::new(text, &Reading::default()),
    };
    let mut number = 0;
    loop {
        let reading = match lines.next() {
            Ok(None) => return,
            Ok(Some(reading)) => reading,
            Err(refusal) => {
                assert!(!refusal.to_string().is_empty());
                continue;
            }
        };
        assert!(lines.number() > number && reading.acceleration.is_finite());
        assert_eq!(reading.drum_turns.is_some(), has_drum);
        number = lines.number();
        let time = reading.time.unwrap_or(watch.time + watch.interval);
        watch.take(time, reading.acceleration, reading.drum_turns);
    }
}

fn play(score: &[u8], watch: &mut Watch) {
    let mut drum = None;
    for stretch in score.as_chunks::<2>().0.iter().take(64) {
        let [what, size] = *stretch;
        let (size, loud) = (u32::from(size), f64::from(what / 16) / 4.0);
        match what % 8 {
            0 => watch.rest(4 * size, 0.02, drum),
            1 => watch.accelerate(size % 64, loud, drum),
            2 => watch.accelerate(size % 64, -loud, drum),
            3 => watch.rest(size, loud, drum),
            4 => watch.time += f64::from(size) * watch.interval,
            5 => drum = [None, Some(true), Some(false)][what as usize / 16 % 3],
            6 => watch.accelerate(size % 8, 1e3 * loud, drum),
            _ => watch.accelerate(
                1,
                [f64::MAX, f64::MIN, 1e308, -0.0][what as usize / 16 % 4],
                drum,
            ),
        }
    }
}

struct Watch {
    monitor: Monitor,
    time: f64,
    interval: f64,
    number: u32,
    reported: f64,
}

impl Watch {
    fn new(choice: u8) -> Self {
        thread_local! { static DESIGN: OnceCell<Design> = const { OnceCell::new() } }
        let design = DESIGN.with(|design| design.get_or_init(small).clone());
        let interval = 1.0 / design.rate;
        let knowledge = Knowledge {
            reference: None,
            begins_at_rest: choice & 2 > 0,
            motion_shows: choice & 4 > 0,
        };
        let far = [0.0, -1e3, 1e9, 1e12][usize::from(choice / 16) % 4];
        Self {
            monitor: Monitor::new(design, knowledge),
            time: far,
            interval,
            number: 0,
            reported: f64::NEG_INFINITY,
        }
    }

    fn rest(&mut self, samples: u32, noise: f64, drum: Option<bool>) {
        for _ in 0..samples {
            self.number = self
                .number
                .wrapping_mul(1_664_525)
                .wrapping_add(1_013_904_223);
            let uniform = f64::from(self.number >> 8) / f64::from(1 << 23) - 1.0;
            self.take(self.time + self.interval, 9.8 + noise * uniform, drum);
        }
    }

    fn accelerate(&mut self, samples: u32, by: f64, drum: Option<bool>) {
        for _ in 0..samples {
            self.take(self.time + self.interval, 9.8 + by, drum);
        }
    }

    /// Times that do not grow are for the caller to refuse.
    fn take(&mut self, time: f64, acceleration: f64, drum_turns: Option<bool>) {
        if !(time > self.time && time.abs() < 1e13) {
            return;
        }
        self.time = time;
        let mut state = self.monitor.state();
        for event in self.monitor.step(Sample { time, acceleration }, drum_turns) {
            assert!(
                event.time.is_finite() && event.time <= event.reported,
                "{event:?}"
            );
            assert!(
                self.reported <= event.reported && event.reported == time,
                "{event:?}"
            );
            self.reported = event.reported;
            if let Kind::Change {
                state: next, speed, ..
            } = event.kind
            {
                assert!(next != state, "{event:?} changes nothing");
                assert!(speed.is_none_or(f64::is_finite), "{event:?}");
                state = next;
            }
        }
        assert_eq!(state, self.monitor.state());
        if let Some(reference) = self.monitor.reference() {
            assert!(reference.level.is_finite() && reference.deviation.is_finite());
            assert!(reference.sample.iter().all(|value| value.is_finite()));
        }
    }
}

/// Small samples, a block a reading.
fn small() -> Design {
    let mut settings = Settings::default();
    settings.samples.reference = 8;
    settings.samples.shift = 4;
    settings.samples.scale = 4;
    settings.samples.gap = 1;
    settings.detector.alpha = 0.01;
    settings.whitening.training = 40;
    settings.monitor.longest_motion = 30.0;
    settings.monitor.longest_slack = 1.0;
    settings.at(20.0).expect("they can be used")
}
