//! `monitor --heartbeat`: a line every so often, also while no reading comes.

use liftsim::monitor::State;
use serde::Serialize;
use std::sync::Mutex;
use std::sync::mpsc::{Receiver, RecvTimeoutError};
use std::time::{Duration, Instant};

/// What a monitor has come to, for another thread.
pub struct Pulse(Mutex<Latest>);

#[derive(Clone, Copy)]
struct Latest {
    readings: u64,
    /// The time of the last reading, s, and when it came.
    time: Option<f64>,
    came: Instant,
    state: State,
}

/// A line of the heart.
#[derive(Serialize)]
struct Beat {
    event: &'static str,
    /// The time of the last reading, s.
    time: Option<f64>,
    state: State,
    readings: u64,
    /// Seconds since a reading came, or since the start.
    silent: f64,
}

impl Pulse {
    pub fn new() -> Self {
        Self(Mutex::new(Latest {
            readings: 0,
            time: None,
            came: Instant::now(),
            state: State::Unknown,
        }))
    }

    /// Takes note of a reading, and of the state after it.
    pub fn take(&self, time: f64, state: State) {
        let mut latest = self.0.lock().expect("nobody panics with it");
        *latest = Latest {
            readings: latest.readings + 1,
            time: Some(time),
            came: Instant::now(),
            state,
        };
    }

    /// Tells a line after each period, until the other end of the channel is dropped.
    pub fn beat(&self, period: Duration, end: &Receiver<()>, tell: impl Fn(String)) {
        while end.recv_timeout(period) == Err(RecvTimeoutError::Timeout) {
            let latest = *self.0.lock().expect("nobody panics with it");
            tell(super::monitor::line(&Beat {
                event: "heartbeat",
                time: latest.time,
                state: latest.state,
                readings: latest.readings,
                silent: (latest.came.elapsed().as_secs_f64() * 10.0).round() / 10.0,
            }));
        }
    }
}

/// A period of a flag.
pub fn period(text: &str) -> Result<Duration, String> {
    let seconds = text.parse().ok();
    let seconds = seconds.filter(|seconds: &f64| (0.1..=86400.0).contains(seconds));
    let seconds = seconds.ok_or("must lie in 0.1 to 86400 s")?;
    Ok(Duration::from_secs_f64(seconds))
}
