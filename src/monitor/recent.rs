//! The newest part of a record, smoothed.

use super::noise::{Noise, Noises};
use crate::explain::{AT_ONCE, Block, is_at_once, lies_still};
use serde::{Deserialize, Serialize};
use std::collections::VecDeque;

/// Over which the record is smoothed, s.
const FAST: f64 = 0.3;
const SLOW: f64 = 1.5;

/// A plateau is three parts of this length that agree, s.
const PART: f64 = 1.0;

/// For how long no pulse may have been seen before what is still older is the level, s.
pub(super) const SETTLED: f64 = 2.5;

/// How much is kept, s.
const KEPT: f64 = 30.0;

/// A block, smoothed.
#[derive(Clone, Copy, Debug, Serialize, Deserialize)]
pub(super) struct Smooth {
    pub from: f64,
    pub to: f64,
    pub seconds: f64,
    pub mean: f64,
    /// The mean around it, and of the time before.
    pub fast: f64,
    pub slow: f64,
    /// How much it changes here at once, beyond noise.
    pub jump: f64,
    /// The mean so much earlier that no pulse that is still unseen can have begun in it.
    pub settled: f64,
}

/// Running mean over the newest blocks.
#[derive(Clone, Debug, Serialize, Deserialize)]
struct Mean {
    count: usize,
    sum: f64,
}

/// The newest blocks since the latest hole.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub(super) struct Recent {
    blocks: VecDeque<Block>,
    /// Of the blocks, as many as there are.
    smooth: VecDeque<Smooth>,
    capacity: usize,
    noise: Noise,
    half: usize,
    at_once: usize,
    fast: Mean,
    slow: Mean,
    part: usize,
    lag: usize,
    /// The number of blocks since the latest hole.
    pub count: usize,
}

impl Mean {
    fn new(count: usize) -> Self {
        Self { count, sum: 0.0 }
    }

    fn step(&mut self, blocks: &VecDeque<Block>) -> f64 {
        let length = blocks.len();
        self.sum += blocks[length - 1].mean;
        if length > self.count {
            self.sum -= blocks[length - 1 - self.count].mean;
        }
        self.sum / self.count.min(length) as f64
    }
}

impl Recent {
    /// Of blocks of this length, s.
    pub fn new(block: f64) -> Self {
        let blocks_in = |seconds: f64| ((seconds / block).round() as usize).max(1);
        let half = blocks_in(FAST / 2.0);
        let capacity = blocks_in(KEPT) + 2 * half + 2;
        Self {
            blocks: VecDeque::with_capacity(capacity + 1),
            smooth: VecDeque::with_capacity(capacity + 1),
            capacity,
            noise: Noise::default(),
            half,
            at_once: blocks_in(AT_ONCE),
            fast: Mean::new(2 * half + 1),
            slow: Mean::new(blocks_in(SLOW)),
            part: blocks_in(PART),
            lag: blocks_in(SETTLED),
            count: 0,
        }
    }

    /// Takes the next block, and gives the newest that can be smoothed.
    pub fn step(&mut self, block: Block) -> Option<Smooth> {
        self.count += 1;
        self.blocks.push_back(block);
        let fast = self.fast.step(&self.blocks);
        let slow = self.slow.step(&self.blocks);
        if self.blocks.len() <= self.half {
            return None;
        }
        let centre = self.blocks[self.blocks.len() - 1 - self.half];
        let settled =
            (self.smooth.len().checked_sub(self.lag)).map(|place| self.smooth[place].mean);
        let smooth = Smooth {
            from: centre.from,
            to: centre.to,
            seconds: centre.seconds,
            mean: centre.mean,
            fast,
            slow,
            jump: self.jump(),
            settled: settled.unwrap_or(centre.mean),
        };
        self.smooth.push_back(smooth);
        self.measure_noise();
        if self.blocks.len() > self.capacity {
            self.blocks.pop_front();
            self.smooth.pop_front();
        }
        Some(smooth)
    }

    /// The change at the block that is smoothed, if that is more than noise.
    fn jump(&self) -> f64 {
        let (centre, width) = (self.blocks.len() - 1 - self.half, self.at_once);
        if centre < width {
            return 0.0;
        }
        let mean = |from: usize| {
            let blocks = self.blocks.range(from..from + width);
            blocks.map(|block| block.mean).sum::<f64>() / width as f64
        };
        // A step may fall within the block.
        let jump = mean(centre + 1) - mean(centre - width);
        let noise = self.noise.deviation() * (2.0 * self.fast.count as f64 / width as f64).sqrt();
        if is_at_once(jump, 0.0, noise) {
            jump
        } else {
            0.0
        }
    }

    fn measure_noise(&mut self) {
        let (newest, apart) = (self.smooth.len() - 1, self.fast.count);
        if newest >= 2 * apart {
            let fast = |back: usize| self.smooth[newest - back].fast;
            (self.noise).step(fast(0) - 2.0 * fast(apart) + fast(2 * apart));
        }
    }

    /// The noise as it is if it is white.
    pub fn white(&self) -> Noises {
        let fast = self.noise.deviation();
        let slow = fast * (self.fast.count as f64 / self.slow.count as f64).sqrt();
        Noises { fast, slow }
    }

    /// The deviation of the smoothed record, m/s².
    pub fn noise(&self) -> f64 {
        self.noise.deviation()
    }

    /// Whether to look for a plateau: at every quarter of a part, once there are three.
    pub fn is_due(&self) -> bool {
        self.count >= 3 * self.part && self.count.is_multiple_of((self.part / 4).max(1))
    }

    /// Since when nothing is forgotten, s.
    pub fn oldest(&self) -> f64 {
        self.smooth
            .front()
            .map_or(f64::INFINITY, |first| first.from)
    }

    /// Whether nothing since the latest hole is forgotten.
    pub fn is_whole(&self) -> bool {
        self.count <= self.smooth.len() + self.half
    }

    /// The end of the newest block, s.
    pub fn now(&self) -> Option<f64> {
        self.blocks.back().map(|block| block.to)
    }

    /// The level on which the last three seconds agree, and since when, s.
    pub fn plateau(&self) -> Option<(f64, f64)> {
        let length = self.blocks.len();
        let since = self.blocks[length.checked_sub(3 * self.part)?].from;
        let mean = |part: usize| {
            let to = length - part * self.part;
            let blocks = self.blocks.range(to - self.part..to);
            blocks.map(|block| block.mean).sum::<f64>() / self.part as f64
        };
        let means = [mean(0), mean(1), mean(2)];
        let middle = means.iter().sum::<f64>() / 3.0;
        let noise = self.white().fast * (self.fast.count as f64 / self.part as f64).sqrt();
        lies_still(means, noise).then_some((middle, since))
    }

    /// All that begins at a time or later, smoothed.
    pub fn since(&self, time: f64) -> impl Iterator<Item = &Smooth> {
        let first = self.smooth.partition_point(|it| it.from < time);
        self.smooth.range(first..)
    }

    /// Forgets all but the noise.
    pub fn clear(&mut self) {
        self.blocks.clear();
        self.smooth.clear();
        self.count = 0;
        self.fast.sum = 0.0;
        self.slow.sum = 0.0;
    }
}
