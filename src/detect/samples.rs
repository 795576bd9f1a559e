//! Where the three samples lie in a trial, Fig. 5 of [^1]: training · X · gap · Y₁ · gap · Y₂.
//!
//! Positions count observations (after decimation) from the first of X.
//!
//! [^1]: see [`crate::signal`].

use std::fmt;
use std::ops::Range;

/// Sizes and spacing of X, Y₁ and Y₂.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Samples {
    reference: usize,
    shift: usize,
    scale: usize,
    gap: usize,
    decimation: usize,
}

/// Why sizes were refused.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum SamplesError {
    /// N = 0.
    #[error("reference must be at least 1, got 0")]
    Reference,
    /// M₁ = 0.
    #[error("shift must be at least 1, got 0")]
    Shift,
    /// M₂ = 0.
    #[error("scale must be at least 1, got 0")]
    Scale,
    /// A block of no observations.
    #[error("decimation must be at least 1, got 0 (1 keeps every observation)")]
    Decimation,
}

impl Samples {
    /// N, M₁, M₂ observations, `gap` of them skipped in between, each the mean of `decimation` raw
    /// ones.
    ///
    /// # Errors
    /// Where a size or the decimation is zero.
    pub fn new(
        reference: usize,
        shift: usize,
        scale: usize,
        gap: usize,
        decimation: usize,
    ) -> Result<Self, SamplesError> {
        match 0 {
            _ if reference == 0 => Err(SamplesError::Reference),
            _ if shift == 0 => Err(SamplesError::Shift),
            _ if scale == 0 => Err(SamplesError::Scale),
            _ if decimation == 0 => Err(SamplesError::Decimation),
            _ => Ok(Self {
                reference,
                shift,
                scale,
                gap,
                decimation,
            }),
        }
    }

    /// Three samples side by side, every observation used.
    ///
    /// # Errors
    /// Where a size is zero.
    pub fn contiguous(reference: usize, shift: usize, scale: usize) -> Result<Self, SamplesError> {
        Self::new(reference, shift, scale, 0, 1)
    }

    /// N.
    pub fn reference(&self) -> usize {
        self.reference
    }

    /// M₁.
    pub fn shift(&self) -> usize {
        self.shift
    }

    /// M₂.
    pub fn scale(&self) -> usize {
        self.scale
    }

    /// Observations skipped between X and Y₁, and between Y₁ and Y₂.
    pub fn gap(&self) -> usize {
        self.gap
    }

    /// Raw observations in each block mean.
    pub fn decimation(&self) -> usize {
        self.decimation
    }

    /// Where X lies.
    pub fn reference_range(&self) -> Range<usize> {
        0..self.reference
    }

    /// Where Y₁ lies.
    pub fn shift_range(&self) -> Range<usize> {
        let start = self.reference.saturating_add(self.gap);
        start..start.saturating_add(self.shift)
    }

    /// Where Y₂ lies.
    pub fn scale_range(&self) -> Range<usize> {
        let start = self.shift_range().end.saturating_add(self.gap);
        start..start.saturating_add(self.scale)
    }

    /// Observations from the first of X to the last of Y₂.
    pub fn span(&self) -> usize {
        self.scale_range().end
    }

    /// Observations from the first after X to the last of Y₁: how long Δ acts unless told otherwise.
    pub fn acceleration(&self) -> usize {
        self.shift_range().end - self.reference
    }
}

impl fmt::Display for Samples {
    /// N/M₁/M₂.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}/{}/{}", self.reference, self.shift, self.scale)
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
        assert_eq!(Samples::contiguous(0, 1, 1), Err(SamplesError::Reference));
        assert_eq!(Samples::contiguous(1, 0, 1), Err(SamplesError::Shift));
        assert_eq!(Samples::contiguous(1, 1, 0), Err(SamplesError::Scale));
        assert_eq!(Samples::new(1, 1, 1, 0, 0), Err(SamplesError::Decimation));
    }
}
