//! The positions of the three samples in a trial, Fig. 5 of [^1]: training · X · gap · Y₁ · gap · Y₂.
//!
//! Positions count observations (after decimation) from the first of X.
//!
//! [^1]: see [`crate::signal`].

use crate::rule::OutOfRange;
use crate::values::Size;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::fmt;
use std::ops::Range;

/// Sizes and spacing of X, Y₁ and Y₂.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct Samples {
    /// N, size of X.
    reference: Size,
    /// M₁, size of Y₁.
    shift: Size,
    /// M₂, size of Y₂.
    scale: Size,
    /// Observations skipped between X and Y₁ and between Y₁ and Y₂.
    gap: usize,
    /// Raw observations whose mean is one observation, before everything else; 1 keeps every one.
    decimation: Size,
}

impl Default for Samples {
    fn default() -> Self {
        Self::contiguous(12, 12, 12).expect("none is 0")
    }
}

impl Samples {
    /// Samples of N, M₁ and M₂ observations with `gap` skipped in between, each observation the mean of
    /// `decimation` raw ones.
    ///
    /// # Errors
    /// If a size or the decimation is zero.
    pub fn new(
        reference: usize,
        shift: usize,
        scale: usize,
        gap: usize,
        decimation: usize,
    ) -> Result<Self, OutOfRange> {
        Ok(Self {
            reference: Size::new(reference)?,
            shift: Size::new(shift)?,
            scale: Size::new(scale)?,
            gap,
            decimation: Size::new(decimation)?,
        })
    }

    /// Three samples side by side, every observation used.
    ///
    /// # Errors
    /// If a size is zero.
    pub fn contiguous(reference: usize, shift: usize, scale: usize) -> Result<Self, OutOfRange> {
        Self::new(reference, shift, scale, 0, 1)
    }

    /// N.
    pub fn reference(&self) -> usize {
        self.reference.get()
    }

    /// M₁.
    pub fn shift(&self) -> usize {
        self.shift.get()
    }

    /// M₂.
    pub fn scale(&self) -> usize {
        self.scale.get()
    }

    /// Observations skipped between X and Y₁, and between Y₁ and Y₂.
    pub fn gap(&self) -> usize {
        self.gap
    }

    /// Raw observations in each block mean.
    pub fn decimation(&self) -> usize {
        self.decimation.get()
    }

    /// The positions of X.
    pub fn reference_range(&self) -> Range<usize> {
        0..self.reference()
    }

    /// The positions of Y₁.
    pub fn shift_range(&self) -> Range<usize> {
        let start = self.reference().saturating_add(self.gap);
        start..start.saturating_add(self.shift())
    }

    /// The positions of Y₂.
    pub fn scale_range(&self) -> Range<usize> {
        let start = self.shift_range().end.saturating_add(self.gap);
        start..start.saturating_add(self.scale())
    }

    /// Observations from the first of X to the last of Y₂.
    pub fn span(&self) -> usize {
        self.scale_range().end
    }

    /// Observations from the first after X to the last of Y₁: the default duration of Δ.
    pub fn acceleration(&self) -> usize {
        self.shift_range().end - self.reference()
    }
}

impl fmt::Display for Samples {
    /// N/M₁/M₂.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}/{}/{}", self.reference(), self.shift(), self.scale())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn layout() {
        let samples = Samples::new(4, 3, 2, 1, 1).unwrap();
        assert_eq!(samples.reference_range(), 0..4);
        assert_eq!(samples.shift_range(), 5..8);
        assert_eq!(samples.scale_range(), 9..11);
        assert_eq!(samples.span(), 11);
        assert_eq!(samples.acceleration(), 4);
    }

    #[test]
    fn refusals() {
        for [reference, shift, scale, decimation] in
            [[0, 1, 1, 1], [1, 0, 1, 1], [1, 1, 0, 1], [1, 1, 1, 0]]
        {
            assert!(Samples::new(reference, shift, scale, 0, decimation).is_err());
        }
    }
}
