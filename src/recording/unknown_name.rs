//! The error for a name that is not one of several known ones.

/// An unknown name, with the known ones.
#[derive(Clone, Debug, Eq, PartialEq, thiserror::Error)]
#[error("must be {known}, got \"{got}\"")]
pub struct UnknownName {
    known: &'static str,
    got: String,
}

impl UnknownName {
    pub(super) fn new(known: &'static str, got: &str) -> Self {
        Self {
            known,
            got: got.to_owned(),
        }
    }
}
