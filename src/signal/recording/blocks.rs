//! Credits for the axis that moves alone, in blocks of half a second.

/// Means over blocks of half a second of several axes, in bounded memory.
#[derive(Debug)]
pub(super) struct Blocks {
    current: Option<i64>,
    sums: Vec<(f64, u64)>,
    /// The means of all axes, block after block.
    means: Vec<f64>,
    /// One of every `stride` blocks is kept; the stride doubles whenever the list is full.
    stride: i64,
}

/// Length of a block, s.
const BLOCK: f64 = 0.5;

/// The most blocks kept: nine hours at a stride of 1.
const MOST_BLOCKS: usize = 1 << 16;

impl Blocks {
    pub fn new(axes: usize) -> Self {
        Self {
            current: None,
            sums: vec![(0.0, 0); axes],
            means: Vec::new(),
            stride: 1,
        }
    }

    pub fn add(&mut self, axis: usize, time: f64, acceleration: f64) {
        let block = (time / BLOCK).floor() as i64;
        if self.current != Some(block) {
            self.end();
            self.current = Some(block);
        }
        let (sum, count) = &mut self.sums[axis];
        *sum += acceleration;
        *count += 1;
    }

    /// Keeps the block if every axis was read in it.
    fn end(&mut self) {
        let axes = self.sums.len();
        let is_kept = self.current.is_some_and(|block| block % self.stride == 0);
        if is_kept && self.sums.iter().all(|(_, count)| *count > 0) {
            let means = self.sums.iter().map(|(sum, count)| sum / *count as f64);
            self.means.extend(means);
        }
        self.sums.fill((0.0, 0));
        if self.means.len() >= MOST_BLOCKS * axes {
            self.stride *= 2;
            let blocks = self.means.chunks_exact(axes).step_by(2);
            self.means = blocks.flatten().copied().collect();
        }
    }

    /// The credit of each axis.
    pub fn credits(&self) -> Vec<f64> {
        let axes = self.sums.len();
        let current = self.sums.iter().all(|(_, count)| *count > 0);
        let last: Vec<f64> = self
            .sums
            .iter()
            .filter(|_| current)
            .map(|(sum, count)| sum / *count as f64)
            .collect();
        let blocks = || self.means.chunks_exact(axes).chain(last.chunks_exact(axes));
        let medians: Vec<f64> = (0..axes)
            .map(|axis| median(blocks().map(|block| block[axis]).collect()))
            .collect();
        let mut credits = vec![0.0; axes];
        for block in blocks() {
            let squares: Vec<f64> = block
                .iter()
                .zip(&medians)
                .map(|(mean, median)| (mean - median) * (mean - median))
                .collect();
            let total: f64 = squares.iter().sum();
            for (credit, square) in credits.iter_mut().zip(&squares) {
                *credit += (square.min(1.0) - (total - square)).max(0.0);
            }
        }
        credits
    }
}

fn median(mut values: Vec<f64>) -> f64 {
    let middle = values.len() / 2;
    if values.is_empty() {
        0.0
    } else {
        *values.select_nth_unstable_by(middle, f64::total_cmp).1
    }
}
