//! The equations that can be cited: each as its paper prints it, and as it is meant where that is something else.

use std::collections::BTreeSet;

/// A paper whose equations are cited by their numbers.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Paper {
    /// M. A. Raifeld's, on the detector.
    Raifeld,
    /// Yang Yu's and others', on a monitor with accelerometer and barometer.
    Yang,
}

/// The equations that are cited, by paper and number.
pub(super) type Cited = BTreeSet<(Paper, u8)>;

/// An equation. In the remark `` ` `` encloses formulas.
pub(super) struct Equation {
    pub paper: Paper,
    pub number: u8,
    /// As it is printed; nothing where the text at hand has lost it.
    pub printed: Option<&'static str>,
    /// What it is, and what it should be.
    pub remark: &'static str,
}

const fn equation(
    paper: Paper,
    number: u8,
    printed: Option<&'static str>,
    remark: &'static str,
) -> Equation {
    Equation {
        paper,
        number,
        printed,
        remark,
    }
}

pub(super) const EQUATIONS: [Equation; 16] = [
    equation(
        Paper::Raifeld,
        1,
        Some("K(p) = 1/(2.2·10⁻¹⁰ s² + 1.01·10⁻⁶ s + 0.4)"),
        "The accelerometer, an ADXL105; p and s are the same.",
    ),
    equation(
        Paper::Raifeld,
        2,
        Some("H(z) = 9.404·10⁻⁶ z⁻¹/(1 + 1.5365 z⁻¹ + 0.75056 z⁻²)"),
        "(1) sampled at T_0 = 6.25·10⁻⁵ s, by impulse invariance. That gives the numerator `2.672 z⁻¹`: the one printed lacks the \
         factor T_0/a = 284091, where a = 2.2·10⁻¹⁰. It only sets the scale of the signal.",
    ),
    equation(
        Paper::Raifeld,
        3,
        Some("x_i = −1.5365 x_(i−1) − 0.75056 x_(i−2) + 9.404·10⁻⁶ ξ_(i−1)"),
        "The noise at rest, with the numerator of (2). Here it is `x_i = −1.5365 x_(i−1) − 0.75056 x_(i−2) + ξ_i`, so that σ_ξ is \
         the unit of everything.",
    ),
    equation(
        Paper::Raifeld,
        5,
        Some("P(λ_i) = (1 − ν) δ(λ_i) + 0.5 ν (δ(λ_i − θ) + δ(λ_i + θ))"),
        "An impulse comes with probability ν. It is `−S_(i−1)` where the sum `S_(i−1)` of those before it is not zero, and θ or −θ, \
         alike, where it is.",
    ),
    equation(
        Paper::Raifeld,
        6,
        Some("P(S_i) = 0.5 δ(S_i) + 0.25 δ(S_i − θ) + 0.25 δ(S_i + θ)"),
        "The limit for many samples. From S_0 = 0 it is `P(S_i = 0) = (1 + (1 − 2ν)^i)/2`; θ and −θ share the rest alike.",
    ),
    equation(
        Paper::Raifeld,
        9,
        Some(
            "H_1: y_i = Δ(1 − β) + λ_i + Σ_p a_p λ_(i−p) + ξ_i for i = 1…d, and the same without Δ(1 − β) for i = d + 1…n; H_0: y_i = ξ_i",
        ),
        "The record after whitening, with `β = Σ_p a_p`, p = 1…m. The a_p are those that make the sum of `(x_i − Σ_p a_p x_(i−p))²` \
         least, so the impulses pass with a minus: `λ_i − Σ_p a_p λ_(i−p)`, as Δ does. For m samples after Δ begins or ends \
         its share is another, since the filter still sees what was before.",
    ),
    equation(
        Paper::Raifeld,
        10,
        Some("δ(W, T) = H_1 if {W, T} ∈ ϑ, H_0 if {W, T} ∉ ϑ; P({W, T} ∈ ϑ / H_0) ≤ α"),
        "The rule. The region ϑ is not given.",
    ),
    equation(
        Paper::Raifeld,
        11,
        Some("δ(W, T) = H_1 if W ≥ C_W(T), H_0 if W < C_W(T)"),
        "The rule as a threshold of W that depends on T. It is not given either.",
    ),
    equation(
        Paper::Raifeld,
        12,
        Some("T = Σ_i τ_i, i = 1…M_2; τ_i = 0 if x_min ≤ y_i ≤ x_max, else τ_i = 1"),
        "The y_i are those of Y_2, x_min and x_max the ends of X. W, the sum of the ranks of Y_1 among all three samples, has no number.",
    ),
    equation(
        Paper::Raifeld,
        13,
        Some("P(R_X, R_Y1, R_Y2 / H_0) = 1/(C(N + M_1 + M_2, N + M_1) C(N + M_1, N))"),
        "Every way to deal the ranks to the three samples is as likely as any other; C(n, k) ways to choose k of n.",
    ),
    equation(
        Paper::Raifeld,
        14,
        Some("P(W/T, H_0) = P(W/H_0)"),
        "W and T are independent at rest. A theorem for samples that are exchangeable and without ties.",
    ),
    equation(
        Paper::Raifeld,
        15,
        Some("α = Σ_T P(T/H_0) Σ_W P(W/H_0), T = 0…T_max, W = C_W(T)…W_max"),
        "The exact false-alarm rate of (11). W and T are whole numbers, so that few α can be met: here it is the size of the rule, at \
         most the α that was asked for.",
    ),
    equation(
        Paper::Yang,
        5,
        None,
        "In the form of the barometer's data sheet, which is used here, `k_ALT = 44330 (1 − (p/p_0)^(1/5.255))`. It supposes the temperature \
         of the standard atmosphere. In air of temperature τ, in K, it is `h_2 − h_1 = (R τ/g) ln(p_1/p_2)` with R = 287.05 J/(kg K).",
    ),
    equation(
        Paper::Yang,
        20,
        None,
        "A moving mean of the energies e of the horizontal vibration, by its words; here the mean of all so far, `MA_n = (e_1 + … + e_n)/n`.",
    ),
    equation(
        Paper::Yang,
        21,
        Some("EMA_j = |MA_j − MA_(j−1)|/MA_(j−1) × 100"),
        "In per cent; no value where the mean before is zero.",
    ),
    equation(
        Paper::Yang,
        22,
        Some("k = atan((EMA_n − EMA_(n−m))/(x_n − x_(n−m)))"),
        "Learning stops at k ≈ 0. The paper gives neither x, m nor what is near zero; here x counts windows, and k is in degrees.",
    ),
];

impl Paper {
    /// The paper that a study is about, by the name of its table.
    pub fn of_study(table: &str) -> Self {
        match table {
            "gravity" | "quality" | "vibration" | "phases" | "height" | "air" => Self::Yang,
            _ => Self::Raifeld,
        }
    }

    /// Whether an equation of this number can be cited.
    pub(super) fn has(self, number: u8) -> bool {
        let mut all = EQUATIONS.iter();
        all.any(|it| (it.paper, it.number) == (self, number))
    }

    /// Where a report has an equation.
    pub(super) fn place(self, number: u8) -> String {
        match self {
            Self::Raifeld => format!("eq-{number}"),
            Self::Yang => format!("eq-yang-{number}"),
        }
    }

    /// What stands above its equations.
    pub(super) fn heading(self) -> &'static str {
        match self {
            Self::Raifeld => {
                "Of M. A. Raifeld's paper on the detector. δ(·) is a point mass, ξ the noise after whitening, H_0 rest and H_1 motion."
            }
            Self::Yang => {
                "Of the paper by Yang Yu and others, in Chinese, on a monitor with accelerometer and barometer. The studies of gravity, \
                 quality, baselines, phases and heights are about it."
            }
        }
    }
}

impl Equation {
    /// Whether it is among these.
    pub(super) fn is_in(&self, cited: &Cited) -> bool {
        cited.contains(&(self.paper, self.number))
    }
}
