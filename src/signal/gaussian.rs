//! Standard normal draws in bulk, by Box and Muller's transformation [^1]: with (U, V) uniform,
//! √(−2 ln U) · (cos 2πV, sin 2πV) are two independent normals.
//!
//! Of the C library it uses square roots alone, which IEEE 754 rounds correctly, so that the bits are the same on every
//! machine and at every vector width.
//!
//! [^1]: G. E. P. Box, M. E. Muller, "A note on the generation of random normal deviates",
//! Ann. Math. Statist. 29, 1958.

use super::bits::fill_bytes;
use crate::rng::Generator;
use crate::series::{ln, sin_cos};
use crate::simd::{LANES, Value, Vectors};
use std::f64::consts::FRAC_PI_4;

/// Normal draws made by one step of the transformation.
const STEP: usize = 2 * LANES;

/// Normal draws made from one request for random bits.
const BULK: usize = 32 * STEP;

/// Fills `record` with independent standard normals. The last step is drawn whole even if only a part of it
/// is needed.
pub fn normals<V: Value>(vectors: Vectors, generator: &mut Generator, record: &mut [V]) {
    let lanes = V::default().lanes().len();
    let (mut bytes, mut draws) = ([0; 8 * BULK], [0.0; BULK]);
    for record in record.chunks_mut(BULK / lanes) {
        let wanted = (record.len() * lanes).next_multiple_of(STEP);
        let (bytes, draws) = (&mut bytes[..8 * wanted], &mut draws[..wanted]);
        fill_bytes(vectors, generator, bytes);
        transform(vectors, bytes, draws);
        for (value, draws) in record.iter_mut().zip(draws.chunks_exact(lanes)) {
            value.lanes_mut().copy_from_slice(draws);
        }
    }
}

/// Turns random bytes into normals, a step at a time: the first half of its bits gives the radii, the second
/// the directions.
fn transform(vectors: Vectors, bytes: &[u8], draws: &mut [f64]) {
    vectors.run(
        #[inline(always)]
        || {
            let (bits, _) = bytes.as_chunks::<8>();
            let (bits, _) = bits.as_chunks::<STEP>();
            let (draws, _) = draws.as_chunks_mut::<STEP>();
            for (bits, draws) in bits.iter().zip(draws) {
                step(bits, draws);
            }
        },
    );
}

#[inline(always)]
fn step(bits: &[[u8; 8]; STEP], draws: &mut [f64; STEP]) {
    for lane in 0..LANES {
        let radius = radius(u64::from_le_bytes(bits[lane]));
        let (cosine, sine) = direction(u64::from_le_bytes(bits[LANES + lane]));
        draws[lane] = radius * cosine;
        draws[LANES + lane] = radius * sine;
    }
}

/// A number in (0, 1) from the upper 52 bits: the midpoint of one of 2⁵² cells.
#[inline(always)]
fn open_uniform(bits: u64) -> f64 {
    const HALF_CELL: f64 = 1.0 - f64::EPSILON / 2.0;
    f64::from_bits(bits >> 12 | 1.0f64.to_bits()) - HALF_CELL
}

/// √(−2 ln U).
#[inline(always)]
fn radius(bits: u64) -> f64 {
    (-2.0 * ln(open_uniform(bits))).sqrt()
}

/// (cos φ, sin φ) at an angle uniform on the circle: the upper 52 bits place it in the first eighth, the
/// lowest three mirror it into any other.
#[inline(always)]
fn direction(bits: u64) -> (f64, f64) {
    let (sine, cosine) = sin_cos(open_uniform(bits) * FRAC_PI_4);
    let is_steep = bits & 4 != 0;
    let (x, y) = if is_steep {
        (sine, cosine)
    } else {
        (cosine, sine)
    };
    let signed = |value: f64, sign: u64| f64::from_bits(value.to_bits() ^ (sign << 63));
    (signed(x, bits & 1), signed(y, bits >> 1 & 1))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::rng::Stream;
    use rand::Rng;

    fn bits(length: usize) -> Vec<u64> {
        let mut generator = Stream::new(2014, "noise", "gaussian").at(0);
        (0..length).map(|_| generator.next_u64()).collect()
    }

    /// The radius against the system's ln over the whole range, including the smallest and the largest. Both have
    /// rounding errors in the last bits; the truncation error of the series is below 1e-15.
    #[test]
    fn agrees_with_the_elementary_functions() {
        let mut edges = vec![0, u64::MAX, 1 << 63, (1 << 63) - 1, 3037000500 << 32];
        edges.extend(bits(200_000));
        for bits in edges {
            let uniform = open_uniform(bits);
            let expected = (-2.0 * uniform.ln()).sqrt();
            let error = (radius(bits) / expected - 1.0).abs();
            assert!(error < 2e-15, "{bits}: {error:e}");
            let (cosine, sine) = direction(bits);
            let angle = uniform * FRAC_PI_4;
            let (x, y) = (cosine.abs().max(sine.abs()), cosine.abs().min(sine.abs()));
            assert!((x / angle.cos() - 1.0).abs() < 2e-15, "{bits}");
            assert!((y / angle.sin() - 1.0).abs() < 2e-15, "{bits}");
        }
    }

    /// Each of the eight octants, by the three lowest bits.
    #[test]
    fn directions_fill_the_circle() {
        let octant = |(x, y): (f64, f64)| (x > 0.0, y > 0.0, x.abs() > y.abs());
        let found: std::collections::HashSet<_> = (0..8)
            .map(|low| octant(direction(low | 0x8000 << 40)))
            .collect();
        assert_eq!(found.len(), 8);
    }

    /// The vector width changes no bit.
    #[test]
    fn every_width_gives_the_same_bits() {
        let draws = |vectors| {
            let mut generator = Stream::new(2014, "noise", "gaussian").at(1);
            let mut draws = vec![0.0f64; 5003];
            normals(vectors, &mut generator, &mut draws);
            draws.into_iter().map(f64::to_bits).collect::<Vec<_>>()
        };
        for vectors in Vectors::available() {
            assert_eq!(draws(vectors), draws(Vectors::Baseline), "{vectors:?}");
        }
    }
}
