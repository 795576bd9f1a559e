//! `monitor --heartbeat`: a line every so often, also while no reading comes.

use liftsim::monitor::State;
use serde::Serialize;
use std::sync::Mutex;
use std::sync::mpsc::{Receiver, RecvTimeoutError};
use std::time::{Duration, Instant};

/// What is known of the sensor and the cage, for the thread that tells it.
pub struct Heartbeat(Mutex<Latest>);

struct Latest {
    readings: u64,
    /// The time of the last reading, s, and when it came.
    time: Option<f64>,
    came: Instant,
    /// The last that was told.
    state: State,
}

/// What a heartbeat says.
#[derive(Serialize)]
struct Beat {
    event: &'static str,
    time: Option<f64>,
    state: State,
    readings: u64,
    /// Seconds since a reading came, or since the start.
    silent: f64,
}

impl Heartbeat {
    pub fn new() -> Self {
        Self(Mutex::new(Latest {
            readings: 0,
            time: None,
            came: Instant::now(),
            state: State::Unknown,
        }))
    }

    /// Takes note of a reading as it comes.
    pub fn read(&self, time: f64) {
        let mut latest = self.0.lock().expect("no thread panics");
        latest.readings += 1;
        (latest.time, latest.came) = (Some(time), Instant::now());
    }

    /// Takes note of a state that is told.
    pub fn told(&self, state: State) {
        self.0.lock().expect("no thread panics").state = state;
    }

    /// The line for now.
    pub fn line(&self) -> String {
        let latest = self.0.lock().expect("no thread panics");
        super::monitor::line(&Beat {
            event: "heartbeat",
            time: latest.time,
            state: latest.state,
            readings: latest.readings,
            silent: (latest.came.elapsed().as_secs_f64() * 10.0).round() / 10.0,
        })
    }
}

/// Beats after each period, as long as `beat` says to go on and the other end of the channel is there.
pub fn beat(period: Duration, end: &Receiver<()>, beat: impl Fn() -> bool) {
    while end.recv_timeout(period) == Err(RecvTimeoutError::Timeout) && beat() {}
}

/// The period of a flag.
pub fn period(text: &str) -> Result<Duration, String> {
    let seconds = text.parse().ok();
    let seconds = seconds.filter(|seconds: &f64| (0.1..=86400.0).contains(seconds));
    let seconds = seconds.ok_or("must lie in 0.1 to 86400 s")?;
    Ok(Duration::from_secs_f64(seconds))
}
