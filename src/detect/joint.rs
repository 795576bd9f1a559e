//! The joint law of the rank sum W and the exceedances T′ of all of the motion, in integers.
//!
//! T′ = #{y ∈ Y₁ ∪ Y₂: y < min X or y > max X}. Both statistics depend on the places of Y₁, so (14) of [^1] does
//! not hold for them, and the law has to be counted together.
//!
//! Let n = N + M₁ + M₂ and N ≥ 2. If u of the motion lie below min X and v above max X, then u + v = t, min X has
//! rank u + 1, max X has rank n − v, and L = n − t − 2 ranks lie between. Y₁ takes k of those and M₁ − k of the t
//! outer ranks; of the L − k ranks left between, X takes N − 2 and Y₂ the others. With e_k(S) = Σ q^{sum of R}, over
//! the k-element subsets R of a set S of ranks, the numbers of cases with T′ = t are the coefficients of
//!
//! Σ_k C(L−k, N−2) · e_k({1 … L}) · Σ_{u+v=t} q^{k(u+1)} e_{M₁−k}({1 … u} ∪ {n−v+1 … n}),
//!
//! that of q^w for W = w. Every subset of ranks is counted once, so this is exact. Given t the law of W is symmetric,
//! because reversing the order of all ranks keeps T′, so the lower half is enough. For N = 1 all of the motion lies
//! outside, and T′ says nothing.
//!
//! Polynomials are held in one large integer each, with so many bits for a coefficient that none overflows into
//! the next: their product is one multiplication.
//!
//! [^1]: see [`crate::signal`].

use super::law::{self, Needs, gaussian_binomial};
use super::samples::Samples;
use super::statistics::smallest_rank_sum;
use libm::sqrt;
use num_bigint::BigUint;
use rayon::prelude::*;

/// For T′ = 0 … M₁ + M₂ the numbers of cases by W, from the smallest W on, of the (N + M₁ + M₂)!/(N! M₁! M₂!)
/// in all.
pub(super) fn counts(samples: &Samples) -> Vec<Vec<BigUint>> {
    let (n, m1, m2) = (samples.reference(), samples.shift(), samples.scale());
    if n == 1 {
        let all = gaussian_binomial(m1, 1 + m2);
        let mut columns = vec![vec![BigUint::ZERO; all.len()]; m1 + m2];
        columns.push(all.into_iter().map(|count| count * (m2 + 1)).collect());
        return columns;
    }
    let counting = Counting::new(samples);
    let columns = (0..=m1 + m2).into_par_iter();
    columns.map(|t| counting.column(t)).collect()
}

/// What these counts take.
pub(super) fn needs(samples: &Samples) -> Needs {
    let parts = [samples.reference(), samples.shift(), samples.scale()];
    let [n, m1, m2] = parts.map(|size| size as f64);
    Needs {
        bytes: law::bytes((m1 + m2 + 1.0) * (m1 * (n + m2) + 1.0), &parts),
        seconds: 1e-9 * nanoseconds([n, m1, m2], (law::bits(&parts) / 64.0).ceil()),
    }
}

/// The time on one core with so many words to a coefficient. There are (M₁ + 1)(M₂ + 1) pairs of t and k, each with a sum
/// over u and a product, and (t + 1) n ranks to add to subsets of up to M₁. What each takes was fitted to measured times of
/// 21 sizes, from 5/30/60 to 100000/1/1 and 40/80/3: they are met within a factor of 1.6.
fn nanoseconds([n, m1, m2]: [f64; 3], words: f64) -> f64 {
    let of_motion = m1 + m2;
    let polynomial = words * (m1 * (m1 + 1.0) / 2.0 + m1 * (n + m2) / 2.0 + 1.0);
    let pairs = (m1 + 1.0) * (m2 + 1.0);
    let ranks = (of_motion + 1.0) * (n + of_motion) * m1;
    polynomial * (pairs * (of_motion + 2.0 + 2.0 * sqrt(polynomial)) + ranks / 2.0)
}

/// What the columns share.
struct Counting {
    samples: Samples,
    ring: Ring,
    smallest: usize,
    /// W has so many values less one.
    degree: usize,
}

impl Counting {
    fn new(samples: &Samples) -> Self {
        let (n, m1, m2) = (samples.reference(), samples.shift(), samples.scale());
        let smallest = smallest_rank_sum(m1) as usize;
        let degree = m1 * (n + m2);
        let all = choose(n + m1 + m2, m1) * choose(n + m2, n);
        let ring = Ring::new(all.bits() + 1, smallest + degree / 2 + 1);
        Self {
            samples: *samples,
            ring,
            smallest,
            degree,
        }
    }

    /// The numbers of cases with T′ = t by W.
    fn column(&self, t: usize) -> Vec<BigUint> {
        let (n, m1, m2) = (
            self.samples.reference(),
            self.samples.shift(),
            self.samples.scale(),
        );
        let (all, ring) = (n + m1 + m2, &self.ring);
        let inside = m1.saturating_sub(t)..=m1.min(m1 + m2 - t);
        let mut outer = ring.subsets(m1, all - t + 1..=all);
        let mut outside = vec![BigUint::ZERO; m1 + 1];
        for below in 0..=t {
            for k in inside.clone() {
                outside[k] += ring.times_power(&outer[m1 - k], k * (below + 1));
            }
            if below < t {
                ring.drop_rank(&mut outer, all - t + below + 1);
                ring.add_rank(&mut outer, below + 1);
            }
        }
        let length = all - t - 2;
        let between = ring.subsets(m1, 1..=length);
        let mut column = BigUint::ZERO;
        for k in inside {
            let product = ring.times(&between[k], &outside[k]);
            column += product * choose(length - k, n - 2);
        }
        self.mirrored(&ring.coefficients(&column))
    }

    /// Both halves of a column, from the coefficients of its lower half.
    fn mirrored(&self, coefficients: &[BigUint]) -> Vec<BigUint> {
        let count = |i: usize| {
            let place = self.smallest + i.min(self.degree - i);
            coefficients.get(place).cloned().unwrap_or_default()
        };
        (0..=self.degree).map(count).collect()
    }
}

/// Polynomials in q up to a power, each in one integer.
struct Ring {
    /// Words of 64 bits for each coefficient.
    words: usize,
    /// As many bits as all coefficients have.
    mask: BigUint,
}

impl Ring {
    /// Coefficients of so many bits at most, and so many of them.
    fn new(bits: u64, coefficients: usize) -> Self {
        let words = bits.div_ceil(64) as usize;
        let one = BigUint::from(1u8);
        let mask = (&one << (64 * words * coefficients)) - one;
        Self { words, mask }
    }

    /// e_0 … e_m of these ranks.
    fn subsets(&self, m: usize, ranks: impl Iterator<Item = usize>) -> Vec<BigUint> {
        let mut subsets = vec![BigUint::ZERO; m + 1];
        subsets[0] = BigUint::from(1u8);
        ranks.for_each(|rank| self.add_rank(&mut subsets, rank));
        subsets
    }

    /// Lets the subsets contain `rank`: e_k + q^rank e_{k−1}.
    fn add_rank(&self, subsets: &mut [BigUint], rank: usize) {
        for k in (1..subsets.len()).rev() {
            let with_rank = self.times_power(&subsets[k - 1], rank);
            subsets[k] += with_rank;
        }
    }

    /// Undoes [`add_rank`](Self::add_rank).
    fn drop_rank(&self, subsets: &mut [BigUint], rank: usize) {
        for k in 1..subsets.len() {
            let with_rank = self.times_power(&subsets[k - 1], rank);
            subsets[k] -= with_rank;
        }
    }

    /// q^power times a polynomial.
    fn times_power(&self, polynomial: &BigUint, power: usize) -> BigUint {
        (polynomial << (64 * self.words * power)) & &self.mask
    }

    fn times(&self, a: &BigUint, b: &BigUint) -> BigUint {
        (a * b) & &self.mask
    }

    fn coefficients(&self, polynomial: &BigUint) -> Vec<BigUint> {
        let halves = polynomial.to_u32_digits();
        let coefficients = halves.chunks(2 * self.words);
        coefficients.map(BigUint::from_slice).collect()
    }
}

/// C(n, k).
fn choose(n: usize, k: usize) -> BigUint {
    (0..k).fold(BigUint::from(1u8), |c, i| c * (n - i) / (i + 1))
}
