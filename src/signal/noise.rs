//! Laws of the white noise ξ that drives the sensor: unit variance where it exists, else unit scale.
//!
//! The normal law is drawn in bulk, see [`gaussian`](super::gaussian). Every other is a closed form in
//! uniform draws (inversion, or Bailey's polar method [^1] for Student's t) over `libm`. So no bit
//! depends on the system's own elementary functions.
//!
//! [^1]: R. W. Bailey, "Polar generation of random variates with the t-distribution",
//! Math. Comp. 62, 1994.

use super::gaussian::normals;
use crate::format::brief;
use crate::rng::Generator;
use crate::simd::{Value, Vectors};
use libm::{log, pow, sqrt, tan};
use rand::Rng;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::f64::consts::PI;
use std::fmt;

/// A family of distributions, symmetric about zero.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum Law {
    /// N(0, 1).
    Normal,
    /// Double exponential.
    Laplace,
    /// Logistic.
    Logistic,
    /// Uniform on ±√3.
    Uniform,
    /// Cauchy of unit scale: no variance.
    Cauchy,
    /// Student's t with this many degrees of freedom; of unit scale at 2 and below.
    StudentT(f64),
    /// N(0, 1), a `share` of it replaced by N(0, `scale`²), then brought to unit variance.
    Contaminated {
        /// Probability of the wide component.
        share: f64,
        /// Its deviation, relative to the narrow one.
        scale: f64,
    },
}

/// Why a law was refused.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum LawError {
    /// Degrees of freedom out of range.
    #[error("student_t must have at least 0.25 and finite degrees of freedom, got {}", brief(*.0))]
    DegreesOfFreedom(f64),
    /// A share outside [0, 1].
    #[error("contaminated.share must lie in [0, 1], got {}", brief(*.0))]
    Share(f64),
    /// A scale out of range.
    #[error("contaminated.scale must lie in [1e-6, 1e6], got {}", brief(*.0))]
    Scale(f64),
}

/// A source of independent draws from a [`Law`].
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(try_from = "Law", into = "Law")]
pub struct Noise {
    law: Law,
    /// The factor from the law's natural scale to unit variance.
    unit: f64,
}

impl TryFrom<Law> for Noise {
    type Error = LawError;

    fn try_from(law: Law) -> Result<Self, LawError> {
        Self::new(law)
    }
}

impl From<Noise> for Law {
    fn from(noise: Noise) -> Self {
        noise.law
    }
}

impl Default for Noise {
    fn default() -> Self {
        Self::new(Law::Normal).expect("it has no parameters")
    }
}

/// So many independent draws of the normal law.
pub fn white_noise(count: usize, generator: &mut Generator) -> Vec<f64> {
    let mut noise = vec![0.0; count];
    Noise::default().fill(generator, &mut noise);
    noise
}

impl Noise {
    /// Configures the sampler.
    ///
    /// # Errors
    /// If a parameter of the law is out of its range.
    pub fn new(law: Law) -> Result<Self, LawError> {
        let unit = match law {
            Law::Normal | Law::Cauchy => 1.0,
            Law::Laplace => sqrt(0.5),
            Law::Logistic => sqrt(3.0) / PI,
            Law::Uniform => sqrt(3.0),
            Law::StudentT(freedom) => {
                // Below a quarter the tails exceed the range of floating point.
                if !(freedom >= 0.25 && freedom.is_finite()) {
                    return Err(LawError::DegreesOfFreedom(freedom));
                }
                if freedom > 2.0 {
                    sqrt((freedom - 2.0) / freedom)
                } else {
                    1.0
                }
            }
            Law::Contaminated { share, scale } => {
                if !(0.0..=1.0).contains(&share) {
                    return Err(LawError::Share(share));
                }
                if !(1e-6..=1e6).contains(&scale) {
                    return Err(LawError::Scale(scale));
                }
                1.0 / sqrt(1.0 - share + share * scale * scale)
            }
        };
        Ok(Self { law, unit })
    }

    /// Fills `record` with independent draws.
    pub fn fill<V: Value>(&self, generator: &mut Generator, record: &mut [V]) {
        match self.law {
            Law::Normal => normals(Vectors::widest(), generator, record),
            Law::Laplace => draw(record, || {
                let (uniform, negative) = uniform_and_sign(generator);
                let size = -log(uniform) * self.unit;
                if negative { -size } else { size }
            }),
            Law::Logistic => draw(record, || {
                let uniform = open_uniform(generator);
                log(uniform / (1.0 - uniform)) * self.unit
            }),
            Law::Uniform => draw(record, || (2.0 * open_uniform(generator) - 1.0) * self.unit),
            Law::Cauchy => draw(record, || tan(PI * (open_uniform(generator) - 0.5))),
            Law::StudentT(freedom) => draw(record, || student_t(generator, freedom) * self.unit),
            Law::Contaminated { share, scale } => {
                normals(Vectors::widest(), generator, record);
                for value in record.iter_mut().flat_map(V::lanes_mut) {
                    let is_wide = open_uniform(generator) < share;
                    *value *= self.unit * if is_wide { scale } else { 1.0 };
                }
            }
        }
    }

    /// Whether the law is normal, so that sums of draws are normal too.
    pub fn is_normal(&self) -> bool {
        self.law == Law::Normal
    }
}

fn draw<V: Value>(record: &mut [V], mut next: impl FnMut() -> f64) {
    for value in record.iter_mut().flat_map(V::lanes_mut) {
        *value = next();
    }
}

/// A uniform draw strictly between 0 and 1: the midpoints of 2⁵² cells.
fn open_uniform(generator: &mut Generator) -> f64 {
    ((generator.next_u64() >> 12) as f64 + 0.5) * (1.0 / (1u64 << 52) as f64)
}

/// One 64-bit draw as an open uniform and an independent sign.
fn uniform_and_sign(generator: &mut Generator) -> (f64, bool) {
    let bits = generator.next_u64();
    let uniform = ((bits >> 12) as f64 + 0.5) * (1.0 / (1u64 << 52) as f64);
    (uniform, bits & 1 == 1)
}

/// Bailey's polar method: with (u, v) uniform in the unit disc and w = u² + v².
fn student_t(generator: &mut Generator, freedom: f64) -> f64 {
    loop {
        let u = 2.0 * open_uniform(generator) - 1.0;
        let v = 2.0 * open_uniform(generator) - 1.0;
        let w = u * u + v * v;
        if w <= 1.0 {
            return u * sqrt(freedom * (pow(w, -2.0 / freedom) - 1.0) / w);
        }
    }
}

impl fmt::Display for Noise {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.law {
            Law::Normal => f.write_str("normal"),
            Law::Laplace => f.write_str("laplace"),
            Law::Logistic => f.write_str("logistic"),
            Law::Uniform => f.write_str("uniform"),
            Law::Cauchy => f.write_str("cauchy"),
            Law::StudentT(freedom) => write!(f, "student_t({freedom})"),
            Law::Contaminated { share, scale } => write!(f, "contaminated({share} {scale})"),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::rng::Stream;
    use statrs::distribution::{self, ContinuousCDF};

    const LAWS: [Law; 8] = [
        Law::Normal,
        Law::Laplace,
        Law::Logistic,
        Law::Uniform,
        Law::Cauchy,
        Law::StudentT(3.0),
        Law::StudentT(1.5),
        Law::Contaminated {
            share: 0.1,
            scale: 5.0,
        },
    ];

    fn sample(law: Law, size: usize) -> Vec<f64> {
        let mut record = vec![0.0; size];
        let mut generator = Stream::new(2014, "noise", &format!("{law:?}")).at(0);
        Noise::new(law).unwrap().fill(&mut generator, &mut record);
        record
    }

    /// The law's own distribution function, from another library, at the scale stated here.
    fn cumulative(law: Law, x: f64) -> f64 {
        let normal = |x: f64| distribution::Normal::standard().cdf(x);
        let t = |x: f64, nu: f64| distribution::StudentsT::new(0.0, 1.0, nu).unwrap().cdf(x);
        match law {
            Law::Normal => normal(x),
            Law::Laplace => distribution::Laplace::new(0.0, 0.5f64.sqrt())
                .unwrap()
                .cdf(x),
            Law::Logistic => 1.0 / (1.0 + (-x * PI / 3f64.sqrt()).exp()),
            Law::Uniform => (0.5 + x / 12f64.sqrt()).clamp(0.0, 1.0),
            Law::Cauchy => distribution::Cauchy::new(0.0, 1.0).unwrap().cdf(x),
            Law::StudentT(nu) if nu > 2.0 => t(x * (nu / (nu - 2.0)).sqrt(), nu),
            Law::StudentT(nu) => t(x, nu),
            Law::Contaminated { share, scale } => {
                let deviation = (1.0 - share + share * scale * scale).sqrt();
                (1.0 - share) * normal(x * deviation) + share * normal(x * deviation / scale)
            }
        }
    }

    /// Kolmogorov–Smirnov: P(√n D > 3.0) ≤ 2e^{−18} = 3e-8 for each of the eight laws.
    #[test]
    fn draws_follow_their_law() {
        for law in LAWS {
            let n = 100_000;
            let mut record = sample(law, n);
            record.sort_by(f64::total_cmp);
            let distance = record
                .iter()
                .enumerate()
                .map(|(i, &x)| {
                    let f = cumulative(law, x);
                    (f - i as f64 / n as f64).max((i + 1) as f64 / n as f64 - f)
                })
                .fold(0.0, f64::max);
            let statistic = distance * (n as f64).sqrt();
            println!("{law:?}: n = {n}, sqrt(n) D = {statistic:.3}");
            assert!(statistic < 3.0, "{law:?}");
        }
    }

    /// A change of these values changes results: say so in the CHANGELOG.
    #[test]
    fn golden_draws() {
        let golden = [
            [-0.9622009983235893, -0.20099226179882518],
            [0.613489246366383, 0.6576758283070108],
            [-0.5041946576141977, 3.1314371698155443],
            [0.5859127598279804, -0.03440275857044918],
            [0.5015875888392496, 4.870157507649214],
            [-0.22112159506380202, 1.2847350719309518],
            [0.11722496991072216, -0.39662711686292496],
            [0.6334317225557654, -0.023150403831281995],
        ];
        for (law, first) in LAWS.into_iter().zip(golden) {
            assert_eq!(sample(law, 2), first, "{law:?}");
        }
    }

    #[test]
    fn refusals() {
        let refused = |law| Noise::new(law).unwrap_err().to_string();
        assert!(refused(Law::StudentT(0.0)).contains("got 0"));
        assert!(refused(Law::StudentT(f64::NAN)).contains("NaN"));
        let contaminated = |share, scale| Law::Contaminated { share, scale };
        assert!(refused(contaminated(1.5, 2.0)).contains("share"));
        assert!(refused(contaminated(0.5, -2.0)).contains("scale"));
    }
}
