//! Random streams addressed by coordinates: (seed, purpose, subject, position) → generator.
//!
//! A trial's draws must be a function of what is simulated and of the trial's index, never of the
//! thread, the batch or the order of the work. So nothing here keeps a running state between
//! positions: the first three coordinates are hashed into a ChaCha8 key, and the fourth selects one
//! of that key's 2⁶⁴ streams.
//!
//! ```
//! use liftsim::rng::Stream;
//! use rand::Rng;
//!
//! let noise = Stream::new(2014, "noise", "adxl105");
//! assert_eq!(noise.at(3).next_u64(), noise.at(3).next_u64());
//! assert_ne!(noise.at(3).next_u64(), noise.at(4).next_u64());
//! ```

use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;
use serde::{Deserialize, Serialize};
use sha2::{Digest, Sha256};

/// The generator behind every draw of the project.
pub type Generator = ChaCha8Rng;

/// A family of independent generators, one for each position.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[serde(from = "Key", into = "Key")]
pub struct Stream {
    origin: Generator,
}

/// What a stream is saved as: its draws are a function of it.
type Key = [u8; 32];

impl From<Key> for Stream {
    fn from(key: Key) -> Self {
        let origin = Generator::from_seed(key);
        Self { origin }
    }
}

impl From<Stream> for Key {
    fn from(stream: Stream) -> Self {
        stream.origin.get_seed()
    }
}

impl Stream {
    /// The stream of `seed` that serves `purpose` (noise, impulses, …) for `subject`, a text that
    /// names what is simulated; equal subjects share their draws.
    pub fn new(seed: u64, purpose: &str, subject: &str) -> Self {
        let mut key = Sha256::new();
        key.update(seed.to_le_bytes());
        key.update((purpose.len() as u64).to_le_bytes());
        key.update(purpose.as_bytes());
        key.update(subject.as_bytes());
        Self {
            origin: Generator::from_seed(key.finalize().into()),
        }
    }

    /// The generator at `position`, always in its initial state.
    pub fn at(&self, position: u64) -> Generator {
        let mut generator = self.origin.clone();
        generator.set_stream(position);
        generator
    }
}

/// Uniform in [0, 1), a multiple of 2⁻⁵³.
pub fn unit(generator: &mut Generator) -> f64 {
    (generator.next_u64() >> 11) as f64 * 0.5f64.powi(53)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_coordinate_matters() {
        let first = |seed, purpose, subject: &str, at| {
            Stream::new(seed, purpose, subject).at(at).next_u64()
        };
        let origin = first(1, "noise", "a", 0);
        assert_eq!(origin, first(1, "noise", "a", 0));
        assert_ne!(origin, first(2, "noise", "a", 0));
        assert_ne!(origin, first(1, "ties", "a", 0));
        assert_ne!(origin, first(1, "noise", "b", 0));
        assert_ne!(origin, first(1, "noise", "a", 1));
    }

    /// A change of these values changes every result of the project: say so in the CHANGELOG.
    #[test]
    fn golden_draws() {
        let mut generator = Stream::new(2014, "noise", "golden").at(7);
        assert_eq!(
            [generator.next_u64(), generator.next_u64()],
            [18375520861979867348, 13299681888526189660]
        );
    }
}
