//! Random bits in bulk: the bytes that a generator gives, most of them by vectors wider than its own.

use crate::rng::Generator;
use crate::simd::Vectors;
use rand::Rng;

#[cfg(target_arch = "x86_64")]
mod chacha;

/// Fills `bytes` as the generator does.
pub fn fill_bytes(vectors: Vectors, generator: &mut Generator, bytes: &mut [u8]) {
    let bytes = match vectors {
        #[cfg(target_arch = "x86_64")]
        Vectors::Avx512 if vectors.is_available() => fill_blocks(generator, bytes),
        _ => bytes,
    };
    generator.fill_bytes(bytes);
}

/// Fills whole blocks, many at a time; returns the bytes left over.
#[cfg(target_arch = "x86_64")]
#[allow(
    unsafe_code,
    reason = "a function compiled for some instructions may be called where they have been detected"
)]
fn fill_blocks<'a>(generator: &mut Generator, bytes: &'a mut [u8]) -> &'a mut [u8] {
    let word = generator.get_word_pos();
    let is_within_a_block = !word.is_multiple_of(16);
    if is_within_a_block || bytes.len() < chacha::SIXTEEN {
        return bytes;
    }
    let (sixteens, rest) = bytes.as_chunks_mut();
    // SAFETY: the instructions have been detected.
    unsafe { chacha::fill(generator, (word / 16) as u64, sixteens) };
    generator.set_word_pos(word + (sixteens.as_flattened().len() / 4) as u128);
    rest
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::rng::Stream;

    /// The generator itself, from places before and beyond 2³² blocks, within a block, and twice in turn.
    #[test]
    fn bytes_are_those_of_the_generator() {
        for start in [0, 16, 5, (1 << 36) - 64, u128::from(u64::MAX) * 16] {
            for length in [0, 7, 1023, 1024, 4096, 5000] {
                for vectors in Vectors::available() {
                    let mut generator = Stream::new(2014, "noise", "bits").at(u64::MAX - 3);
                    generator.set_word_pos(start);
                    let mut other = generator.clone();
                    let (mut bytes, mut expected) = (vec![0; length], vec![0; length]);
                    for _ in 0..2 {
                        fill_bytes(vectors, &mut generator, &mut bytes);
                        other.fill_bytes(&mut expected);
                        assert!(bytes == expected, "{vectors:?} {start} {length}");
                    }
                }
            }
        }
    }
}
