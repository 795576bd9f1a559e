//! Keys that break ties between equal samples.

use crate::rng::Stream;
use rand::Rng;

/// Keys for a trial's ties; random keys are drawn on first use.
pub(super) struct Keys<'a> {
    stream: &'a Stream,
    trial: u64,
    random: Vec<u64>,
    drawn: bool,
    positions: Vec<u64>,
}

impl<'a> Keys<'a> {
    /// Keys for trials of `span` samples.
    pub fn new(stream: &'a Stream, span: usize) -> Self {
        Self {
            stream,
            trial: 0,
            random: vec![0; span],
            drawn: false,
            positions: (0..span as u64).collect(),
        }
    }

    pub fn start(&mut self, trial: u64) {
        self.trial = trial;
        self.drawn = false;
    }

    /// A random key for each sample.
    pub fn random(&mut self) -> &[u64] {
        if !self.drawn {
            let mut generator = self.stream.at(self.trial);
            for key in &mut self.random {
                *key = generator.next_u64();
            }
            self.drawn = true;
        }
        &self.random
    }

    /// Keys in the order of time.
    pub fn positions(&self) -> &[u64] {
        &self.positions
    }
}
