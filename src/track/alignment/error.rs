//! Why clocks cannot be brought together.

/// Why clocks cannot be brought together.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[allow(missing_docs, reason = "the messages say it")]
pub enum AlignmentError {
    #[error("the barometer has readings in fewer than two seconds")]
    Readings,
    #[error("no ride is measured from start to stop")]
    NoRide,
    #[error("nowhere do the rides and the pressure agree")]
    Unlike,
    #[error("too few of the rides are in both records")]
    Few,
    #[error("a record is longer than two days")]
    Long,
    #[error("the rides agree with the pressure {0:.1} s ahead, and about as well {1:.1} s ahead")]
    Ambiguous(f64, f64),
}
