//! The latest blocks, measured and whitened: as many as a decision or the training needs.

use super::reference::Reference;
use crate::explain::Block;
use crate::whiten;
use serde::{Deserialize, Serialize};
use std::ops::Range;

/// The latest blocks. Blocks are numbered from the first since the last gap.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub(super) struct History {
    capacity: usize,
    /// The number of the first block held.
    first: u64,
    blocks: Vec<Block>,
    whitened: Vec<f64>,
}

impl History {
    pub fn new(capacity: usize) -> Self {
        Self {
            capacity,
            first: 0,
            blocks: Vec::with_capacity(2 * capacity),
            whitened: Vec::with_capacity(2 * capacity),
        }
    }

    /// The number of the next block.
    pub fn end(&self) -> u64 {
        self.first + self.blocks.len() as u64
    }

    /// Adds a block, whitened if there is a filter. Amortised constant time: when the buffer is full, the older
    /// half is dropped.
    pub fn push(&mut self, block: Block, reference: Option<&Reference>) {
        if self.blocks.len() == 2 * self.capacity {
            self.blocks.drain(..self.capacity);
            self.whitened.drain(..self.capacity);
            self.first += self.capacity as u64;
        }
        self.blocks.push(block);
        let whitened = reference.map_or(0.0, |reference| {
            // Blocks before the record count as the level of rest.
            let last = self.blocks.len() - 1;
            let order = reference.coefficients.len().min(last);
            let past = self.blocks[last - order..last].iter().rev();
            let mut rest = block.mean - reference.level;
            for (a, block) in reference.coefficients.iter().zip(past) {
                rest -= a * (block.mean - reference.level);
            }
            rest
        });
        self.whitened.push(whitened);
    }

    /// Whitens all blocks held with a new filter.
    pub fn whiten(&mut self, reference: &Reference) {
        let centred: Vec<f64> = (self.blocks.iter())
            .map(|block| block.mean - reference.level)
            .collect();
        whiten::whiten(&reference.coefficients, &centred, 0, &mut self.whitened);
    }

    pub fn clear(&mut self) {
        self.first = 0;
        self.blocks.clear();
        self.whitened.clear();
    }

    /// The positions of blocks in the buffer; `None` if one of them is not held.
    fn place(&self, blocks: Range<u64>) -> Option<Range<usize>> {
        let start = blocks.start.checked_sub(self.first)? as usize;
        let end = blocks.end.checked_sub(self.first)? as usize;
        (start <= end && end <= self.blocks.len()).then_some(start..end)
    }

    pub fn blocks(&self, blocks: Range<u64>) -> Option<&[Block]> {
        Some(&self.blocks[self.place(blocks)?])
    }

    pub fn whitened(&self, blocks: Range<u64>) -> Option<&[f64]> {
        Some(&self.whitened[self.place(blocks)?])
    }

    /// The number of the first block that ends after a time, s.
    pub fn at(&self, time: f64) -> u64 {
        self.first + self.blocks.partition_point(|block| block.to <= time) as u64
    }

    /// A block that is held, and whitened.
    pub fn get(&self, number: u64) -> (Block, f64) {
        let place = (number - self.first) as usize;
        (self.blocks[place], self.whitened[place])
    }

    /// The last block, and whitened. There must be one.
    pub fn newest(&self) -> (Block, f64) {
        self.get(self.end() - 1)
    }

    /// Time of the first sample of a block, or of the oldest block held if that one is gone.
    pub fn starts(&self, block: u64) -> f64 {
        self.blocks[block.saturating_sub(self.first) as usize].from
    }

    /// Time of the last sample of the block before `block`.
    pub fn ends(&self, block: u64) -> f64 {
        let after = block.saturating_sub(self.first).max(1);
        self.blocks[after as usize - 1].to
    }
}
