//! A sensor in somebody's hand. Who lifts it, or puts it down, swings it as no lift does, and it does not read then what
//! it read before. What it reads until it lies still again says nothing of the cage.

use super::blocks::{Block, Cut};
use super::cost;
use crate::recording::Sample;
use std::ops::Range;

/// A hand needs no longer than this for each way of a swing, s, and moves the sensor faster than this, m/s.
const LONGEST: f64 = 0.9;
const LEAST_SPEED: f64 = 0.3;

/// A block so far from what was before may begin a swing, m/s².
const LEAST: f64 = 0.3;

/// One way of a swing ends where it falls to this share of its peak, and the other begins within this time, s.
const FOOT: f64 = 0.35;
const PAUSE: f64 = 0.15;

/// A swing may go on for so long, s; the level before and after is the mean of a second.
const GOES_ON: f64 = 0.5;
const SECOND: f64 = 1.0;

/// A sensor lies still where the means of three seconds are so near to their own mean: m/s², and in deviations.
const STILL: (f64, f64) = (0.012, 4.0);

/// Blocks may be shorter than they should be: no more than those of so many seconds are looked at.
const MOST_SECONDS: usize = 10;

/// It is in a hand if it reads so much else than before.
const ELSE: (f64, f64) = (0.05, 6.0);

/// Whether a change of speed by so much, m/s, in so many seconds is one of a hand, where one the other way touches it.
pub(crate) fn is_of_hand(seconds: f64, change: f64) -> bool {
    seconds < LONGEST && change.abs() > LEAST_SPEED
}

/// Whether a sensor with these means of three seconds lies still; the deviation of each is that of its white noise.
pub(crate) fn lies_still(means: [f64; 3], deviation: f64) -> bool {
    let middle = means.iter().sum::<f64>() / 3.0;
    let near = STILL.0.max(STILL.1 * deviation);
    means.iter().all(|mean| (mean - middle).abs() < near)
}

/// From when to when somebody has the sensor in hand, s.
pub fn in_hand(cut: &Cut) -> Vec<(f64, f64)> {
    let mut spans = Vec::new();
    let deviation = cut.scatter() / (cut.blocks_in(SECOND) as f64).sqrt();
    let mut from = 0;
    for &end in &cut.ends {
        let stretch = Stretch {
            blocks: &cut.blocks[from..end],
            second: cut.blocks_in(SECOND),
            pause: cut.blocks_in(PAUSE),
            goes_on: cut.blocks_in(GOES_ON),
            deviation,
        };
        stretch.spans(&mut spans);
        from = end;
    }
    spans
}

/// The samples outside of these spans, which are in order of time.
pub fn without(samples: &[Sample], spans: &[(f64, f64)]) -> Vec<Sample> {
    let mut spans = spans.iter().peekable();
    let mut is_outside = |time: f64| {
        while spans.next_if(|span| span.1 < time).is_some() {}
        spans.peek().is_none_or(|span| time < span.0)
    };
    let outside = samples.iter().filter(|sample| is_outside(sample.time));
    outside.copied().collect()
}

/// Blocks without a hole.
struct Stretch<'a> {
    blocks: &'a [Block],
    /// The blocks of a second, of a pause and of what goes on after a swing.
    second: usize,
    pause: usize,
    goes_on: usize,
    /// The deviation of their mean.
    deviation: f64,
}

impl Stretch<'_> {
    fn spans(&self, spans: &mut Vec<(f64, f64)>) {
        let (second, length) = (self.second, self.blocks.len());
        let mut sum: f64 = self.blocks.iter().take(second).map(|it| it.mean).sum();
        // Whoever begins a recording has it in hand too.
        let begun = |block: &Block| block.from - self.blocks[0].from >= cost::HANDLED;
        let mut next = self.blocks.iter().position(begun).unwrap_or(length);
        for first in second..length {
            let base = sum / second as f64;
            sum += self.blocks[first].mean - self.blocks[first - second].mean;
            if first < next || !self.is_off(first, base) {
                continue;
            }
            // A lift's change of speed before it would shift what it is measured from.
            if (first - second..first).any(|at| self.is_off(at, base)) {
                continue;
            }
            let Some(after) = self.swing(first, base) else {
                continue;
            };
            // Whoever has it when the record ends, or breaks off, keeps it.
            let lies = (after..length).find(|at| self.lies_still_from(*at));
            let lies = lies.unwrap_or(length);
            if self.is_jump(after..lies, base) {
                // It is no part of what later swings are measured from.
                next = after + second;
                continue;
            }
            // A shorter one would be no hole.
            next = lies.max(first + self.pause + self.goes_on).min(length);
            spans.push((self.blocks[first].from, self.blocks[next - 1].to));
        }
    }

    fn is_off(&self, block: usize, base: f64) -> bool {
        (self.blocks[block].mean - base).abs() >= LEAST
    }

    /// Whether the sensor reads what it read soon after a swing, or, if the lift went meanwhile, once it lies still and was
    /// not put down before.
    fn is_jump(&self, until_still: Range<usize>, base: f64) -> bool {
        let Range { start, end } = until_still;
        let reads = |from: usize, seconds: usize| {
            let blocks = from..(from + seconds * self.second).min(self.blocks.len());
            let near = ELSE.0.max(ELSE.1 * self.deviation);
            blocks.len() > self.second / 2 && (self.mean(blocks) - base).abs() < near
        };
        let swings = |at: usize| self.is_off(at, base) && self.swing(at, base).is_some();
        reads(start + self.goes_on, 1) || reads(end, 3) && !{ until_still }.any(swings)
    }

    /// The block after two lobes about a base, one way and the other, if a hand made both.
    fn swing(&self, first: usize, base: f64) -> Option<usize> {
        let is_up = self.blocks[first].mean > base;
        let middle = self.lobe(first, base)?;
        let turns = |block: &Block| (block.mean > base) != is_up;
        let turn = self.blocks[middle..]
            .iter()
            .take(self.pause)
            .position(turns)?;
        self.lobe(middle + turn, base)
    }

    fn lobe(&self, first: usize, base: f64) -> Option<usize> {
        let off = |block: &Block| block.mean - base;
        let here = &self.blocks[first..];
        let sign = off(here.first()?).signum();
        let (mut peak, mut seconds) = (0.0, 0.0);
        // What it reads afterwards may be on the same side; what lasts too long is not read to its end.
        let goes_on = |block: &&Block| {
            peak = f64::max(peak, sign * off(block));
            let goes_on = seconds < LONGEST && sign * off(block) > FOOT * peak;
            seconds += if goes_on { block.seconds } else { 0.0 };
            goes_on
        };
        let most = here.iter().take(MOST_SECONDS * self.second);
        let lobe = &here[..most.take_while(goes_on).count()];
        let change: f64 = lobe.iter().map(|it| off(it) * it.seconds).sum();
        is_of_hand(seconds, change).then_some(first + lobe.len())
    }

    fn mean(&self, blocks: Range<usize>) -> f64 {
        let length = blocks.len() as f64;
        self.blocks[blocks].iter().map(|it| it.mean).sum::<f64>() / length
    }

    fn lies_still_from(&self, at: usize) -> bool {
        let second = |number: usize| at + number * self.second..at + (number + 1) * self.second;
        second(2).end <= self.blocks.len()
            && lies_still([0, 1, 2].map(|it| self.mean(second(it))), self.deviation)
    }
}
