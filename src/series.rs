//! Elementary functions for vector instructions: power series, truncated where the remainder is below 1e-15 of the value.
//!
//! The code uses only additions, multiplications and divisions, which IEEE 754 rounds correctly, so that the bits are the
//! same on every machine and at every vector width; those of the C library are neither that nor vectors. Loops over these
//! functions become vectors where [`Vectors::run`](crate::simd::Vectors::run) compiles them.

use std::f64::consts::{LN_2, LOG2_E, SQRT_2};

/// ln x for x in (0, 1), not subnormal: x = 2^e m with m in [√½, √2), and with s = (m − 1)/(m + 1)
/// ln m = 2(s + s³/3 + s⁵/5 + …), s² < 0.0295.
#[inline(always)]
pub fn ln(x: f64) -> f64 {
    const LEAST: u64 = (SQRT_2 / 2.0).to_bits();
    // Keeps exponents positive, because vector instructions shift only unsigned numbers.
    const RAISED: u64 = 1024;
    const ODD: [f64; 8] = [17.0, 15.0, 13.0, 11.0, 9.0, 7.0, 5.0, 3.0];
    let exponent = (x.to_bits() + ((RAISED << 52) - LEAST)) >> 52;
    let mantissa = f64::from_bits((x.to_bits() + (RAISED << 52)).wrapping_sub(exponent << 52));
    let s = (mantissa - 1.0) / (mantissa + 1.0);
    let z = s * s;
    let tail = z * horner(z, const { reciprocals(ODD) });
    let exponent = small_integer(exponent) - RAISED as f64;
    exponent * LN_2 + 2.0 * s * (1.0 + tail)
}

/// (sin φ, cos φ) for φ in [0, π/4].
#[inline(always)]
pub fn sin_cos(angle: f64) -> (f64, f64) {
    // 1/(n (n − 1)), from the highest power down: each is the ratio of neighbouring terms.
    const SINE: [f64; 7] = [210.0, 156.0, 110.0, 72.0, 42.0, 20.0, 6.0];
    const COSINE: [f64; 8] = [240.0, 182.0, 132.0, 90.0, 56.0, 30.0, 12.0, 2.0];
    let z = angle * angle;
    let sine = angle * nested(-z, const { reciprocals(SINE) });
    (sine, nested(-z, const { reciprocals(COSINE) }))
}

/// e^x for x ≤ 0: x = k ln 2 + r with |r| ≤ ln 2 / 2, and e^r = 1 + r (1 + r/2 (1 + r/3 (… ))). 0 below −700, where it would
/// soon have fewer digits.
#[inline(always)]
pub fn exp(x: f64) -> f64 {
    const ORDERS: [f64; 13] = [
        13.0, 12.0, 11.0, 10.0, 9.0, 8.0, 7.0, 6.0, 5.0, 4.0, 3.0, 2.0, 1.0,
    ];
    // ln 2 in two parts; the first has so few digits that k times it is exact.
    const HIGH: f64 = f64::from_bits(LN_2.to_bits() & !0xffff_ffff);
    const LOW: f64 = 4.7493250390316726e-07;
    // So large that a sum with it is an integer, in its lowest bits.
    const INTEGER: f64 = 6755399441055744.0;
    let shifted = x * LOG2_E + INTEGER;
    let k = shifted - INTEGER;
    let r = (x - k * HIGH) - k * LOW;
    let power = f64::from_bits((shifted.to_bits() << 52).wrapping_add(1.0f64.to_bits()));
    let value = nested(r, const { reciprocals(ORDERS) }) * power;
    if x < -700.0 { 0.0 } else { value }
}

const fn reciprocals<const N: usize>(mut values: [f64; N]) -> [f64; N] {
    let mut i = 0;
    while i < N {
        values[i] = 1.0 / values[i];
        i += 1;
    }
    values
}

/// c_N + z (c_{N−1} + z (… c_1)).
#[inline(always)]
fn horner<const N: usize>(z: f64, coefficients: [f64; N]) -> f64 {
    coefficients.iter().fold(0.0, |sum, c| c + z * sum)
}

/// 1 + c_N z (1 + c_{N−1} z (1 + … )).
#[inline(always)]
fn nested<const N: usize>(z: f64, ratios: [f64; N]) -> f64 {
    ratios.iter().fold(1.0, |sum, ratio| 1.0 + ratio * z * sum)
}

/// Converts an integer below 2⁵² to a float by instructions that every vector width has.
#[inline(always)]
fn small_integer(n: u64) -> f64 {
    const TWO_52: f64 = 4503599627370496.0;
    f64::from_bits(n | TWO_52.to_bits()) - TWO_52
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::simd::Vectors;

    /// Against the system's, from 0 to where it is 0; and no vector width changes a bit.
    #[test]
    fn exponentials() {
        let at = |step: i32| -710.0 * f64::from(step) / 1_000_000.0;
        let x: Vec<f64> = (0..=1_000_000).map(at).chain([-1e-300, -1e9]).collect();
        let all = |vectors: Vectors| {
            vectors.run(
                #[inline(always)]
                || x.iter().map(|x| exp(*x)).collect::<Vec<_>>(),
            )
        };
        for (x, value) in x.iter().zip(all(Vectors::Baseline)) {
            let expected = if *x < -700.0 { 0.0 } else { x.exp() };
            assert!(
                (value - expected).abs() <= 1e-15 * expected,
                "{x}: {value:e}"
            );
        }
        assert_eq!((exp(0.0), exp(-0.0)), (1.0, 1.0));
        assert!(exp(f64::NAN).is_nan());
        for vectors in Vectors::available() {
            assert_eq!(all(vectors), all(Vectors::Baseline), "{vectors:?}");
        }
    }
}
