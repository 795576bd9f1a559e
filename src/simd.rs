//! Trials side by side: values of [`LANES`] trials in one array, and loops over them compiled for the
//! vectors that the processor has.
//!
//! Compilers turn a loop over the lanes into vector instructions, as wide as the target they compile
//! for. A kernel is compiled for every width here and the widest the processor has is chosen when the
//! program runs. Each lane goes through the same additions and multiplications in every case (none is
//! ever fused into one instruction with another rounding), so the bits do not depend on the choice.
//!
//! `LIFTSIM_VECTORS=baseline`, `avx2` or `avx512` in the environment asks for no wider than that.

use std::ops::{Add, Div, Mul, Sub};
use std::sync::LazyLock;

/// Trials that are computed side by side.
pub const LANES: usize = 8;

/// Several numbers that go through the same operations: one for each of [`LANES`] trials, or any others.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Wide<const N: usize = LANES>(pub [f64; N]);

/// A value in the linear stages of a trial: of one trial, or of several side by side.
pub trait Value:
    Copy
    + Default
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Mul<f64, Output = Self>
{
    /// The value of each trial.
    fn lanes(&self) -> &[f64];
    /// The value of each trial, mutable.
    fn lanes_mut(&mut self) -> &mut [f64];
}

impl Value for f64 {
    #[inline(always)]
    fn lanes(&self) -> &[f64] {
        std::slice::from_ref(self)
    }

    #[inline(always)]
    fn lanes_mut(&mut self) -> &mut [f64] {
        std::slice::from_mut(self)
    }
}

impl<const N: usize> Value for Wide<N> {
    #[inline(always)]
    fn lanes(&self) -> &[f64] {
        &self.0
    }

    #[inline(always)]
    fn lanes_mut(&mut self) -> &mut [f64] {
        &mut self.0
    }
}

impl<const N: usize> Default for Wide<N> {
    #[inline(always)]
    fn default() -> Self {
        Self([0.0; N])
    }
}

impl<const N: usize> Wide<N> {
    /// The same number everywhere.
    #[inline(always)]
    pub fn all(value: f64) -> Self {
        Self([value; N])
    }

    /// Lane by lane, in a loop that compilers turn into vectors more readily than the methods of arrays.
    #[inline(always)]
    fn zip(self, other: Self, operation: impl Fn(f64, f64) -> f64) -> Self {
        let mut result = self;
        for lane in 0..N {
            result.0[lane] = operation(self.0[lane], other.0[lane]);
        }
        result
    }

    /// The smaller number of each lane; that of `other` where one is NaN.
    #[inline(always)]
    pub fn least(self, other: Self) -> Self {
        self.zip(other, least)
    }

    /// The larger number of each lane; that of `other` where one is NaN.
    #[inline(always)]
    pub fn greatest(self, other: Self) -> Self {
        self.zip(other, greatest)
    }

    /// The absolute value of each lane.
    #[inline(always)]
    pub fn abs(self) -> Self {
        self.zip(
            self,
            #[inline(always)]
            |x, _| x.abs(),
        )
    }

    /// The lowest 32 bits of each number.
    #[inline(always)]
    pub fn low_bits(self) -> [u32; N] {
        let mut bits = [0; N];
        for (bits, x) in bits.iter_mut().zip(&self.0) {
            *bits = x.to_bits() as u32;
        }
        bits
    }
}

/// The smaller of two numbers, in one instruction; the second where one is NaN.
#[inline(always)]
pub fn least(a: f64, b: f64) -> f64 {
    if a < b { a } else { b }
}

/// The larger of two numbers, in one instruction; the second where one is NaN.
#[inline(always)]
pub fn greatest(a: f64, b: f64) -> f64 {
    if a > b { a } else { b }
}

/// Implements operators lane by lane.
macro_rules! lane_by_lane {
    ($($operator:ident, $method:ident: $symbol:tt;)*) => {$(
        impl<const N: usize> $operator for Wide<N> {
            type Output = Self;

            #[inline(always)]
            fn $method(self, other: Self) -> Self {
                self.zip(
                    other,
                    #[inline(always)]
                    |a, b| a $symbol b,
                )
            }
        }
    )*};
}

lane_by_lane! {
    Add, add: +;
    Sub, sub: -;
    Mul, mul: *;
    Div, div: /;
}

impl<const N: usize> Mul<f64> for Wide<N> {
    type Output = Self;

    #[inline(always)]
    fn mul(self, factor: f64) -> Self {
        self * Self::all(factor)
    }
}

/// Vector instruction sets, from narrow to wide.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Vectors {
    /// The instructions that every processor of its family has.
    Baseline,
    /// 256 bits.
    Avx2,
    /// 512 bits.
    Avx512,
}

impl Vectors {
    /// The instruction sets that this processor has.
    pub fn available() -> Vec<Self> {
        let all = [Self::Baseline, Self::Avx2, Self::Avx512].into_iter();
        all.filter(|vectors| vectors.is_available()).collect()
    }

    /// Whether this processor has them.
    #[inline]
    pub fn is_available(self) -> bool {
        match self {
            Self::Baseline => true,
            #[cfg(target_arch = "x86_64")]
            Self::Avx2 => std::is_x86_feature_detected!("avx2"),
            #[cfg(target_arch = "x86_64")]
            Self::Avx512 => {
                Self::Avx2.is_available()
                    && std::is_x86_feature_detected!("avx512f")
                    && std::is_x86_feature_detected!("avx512dq")
                    && std::is_x86_feature_detected!("avx512vl")
            }
            #[cfg(not(target_arch = "x86_64"))]
            Self::Avx2 | Self::Avx512 => false,
        }
    }

    /// The widest available, no wider than the environment asks for.
    pub fn widest() -> Self {
        static WIDEST: LazyLock<Vectors> = LazyLock::new(|| {
            let limit = match std::env::var("LIFTSIM_VECTORS").as_deref() {
                Ok("baseline") => Vectors::Baseline,
                Ok("avx2") => Vectors::Avx2,
                _ => Vectors::Avx512,
            };
            let available = Vectors::available().into_iter();
            available
                .filter(|v| *v <= limit)
                .max()
                .unwrap_or(Vectors::Baseline)
        });
        *WIDEST
    }

    /// Runs `kernel`, whose loops are compiled for these instructions if all of it is inlined. If the
    /// processor lacks them, the widest narrower ones it has are used.
    #[inline]
    pub fn run<R>(self, kernel: impl FnOnce() -> R) -> R {
        #[cfg(target_arch = "x86_64")]
        if self > Self::Baseline {
            return x86::run(self, kernel);
        }
        kernel()
    }
}

#[cfg(target_arch = "x86_64")]
mod x86 {
    use super::Vectors;

    #[allow(
        unsafe_code,
        reason = "a function compiled for some instructions may be called where they have been detected"
    )]
    #[inline]
    pub fn run<R>(vectors: Vectors, kernel: impl FnOnce() -> R) -> R {
        if vectors == Vectors::Avx512 && vectors.is_available() {
            // SAFETY: the instructions have just been detected.
            return unsafe { with_avx512(kernel) };
        }
        if Vectors::Avx2.is_available() {
            // SAFETY: the instructions have just been detected.
            return unsafe { with_avx2(kernel) };
        }
        kernel()
    }

    #[target_feature(enable = "avx2")]
    fn with_avx2<R>(kernel: impl FnOnce() -> R) -> R {
        kernel()
    }

    #[target_feature(enable = "avx2,avx512f,avx512dq,avx512vl")]
    fn with_avx512<R>(kernel: impl FnOnce() -> R) -> R {
        kernel()
    }
}
