//! The Kalman filter, by its textbook names.
//!
//! An estimate is a mean x and a covariance P, row by row. Measurements are scalars: z = H x + v, var v = R. [^1]
//!
//! - predict: x ← F x + u, P ← F P Fᵀ + Q
//! - innovation: y = z − H x, S = H P Hᵀ + R
//! - update: K = P Hᵀ/S, x ← x + K y, P ← (I − K H) P (I − K H)ᵀ + K R Kᵀ (Joseph)
//!
//! Joseph's form holds for any gain, so rounding in K does no harm, and it keeps P symmetric and positive.
//! The storage is an array where the size is known (`Estimate<[f64; 4], [f64; 16]>`, no allocation) and
//! a `Vec` where it is not.
//!
//! [^1]: Y. Bar-Shalom, X. R. Li, T. Kirubarajan, "Estimation with Applications to Tracking and Navigation",
//! Wiley 2001, section 5.2.

/// What is known of a state of n elements: its mean, and its covariance of n² elements, row by row.
#[derive(Debug, Clone, PartialEq)]
pub struct Estimate<X, P> {
    /// x, n elements.
    pub mean: X,
    /// P, n² elements.
    pub covariance: P,
}

/// How far a measurement lies from what was expected of it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Innovation {
    /// y = z − H x.
    pub value: f64,
    /// S = H P Hᵀ + R.
    pub variance: f64,
}

impl Innovation {
    /// The normalised innovation squared, y²/S: χ² of one degree of freedom where the model is right.
    pub fn nis(&self) -> f64 {
        self.value * self.value / self.variance
    }
}

/// Numbers in a row, as many as the state has elements, or their square.
pub trait Storage: AsRef<[f64]> + AsMut<[f64]> + Clone {}
impl<T: AsRef<[f64]> + AsMut<[f64]> + Clone> Storage for T {}

impl<X: Storage, P: Storage> Estimate<X, P> {
    /// Moves the estimate on: x ← F x + u, P ← F P Fᵀ + Q.
    #[inline]
    pub fn predict(&mut self, transition: &P, input: &X, noise: &P) {
        let n = self.mean.as_ref().len();
        let f = transition.as_ref();
        let mut mean = input.clone();
        for (i, x) in mean.as_mut().iter_mut().enumerate() {
            *x += dot(&f[i * n..][..n], self.mean.as_ref());
        }
        self.mean = mean;
        // F (F P)ᵀ = F P Fᵀ, as P is symmetric.
        let mut moved = product(n, f, &self.covariance);
        transpose(n, moved.as_mut());
        self.covariance = product(n, f, &moved);
        for (p, q) in self.covariance.as_mut().iter_mut().zip(noise.as_ref()) {
            *p += q;
        }
        symmetrise(n, self.covariance.as_mut());
    }

    /// The innovation of a measurement z = H x + v with var v = R, which stays unused.
    #[inline]
    pub fn innovation(&self, row: &X, measured: f64, variance: f64) -> Innovation {
        self.innovation_of(row, &self.spread(row), measured, variance)
    }

    /// Takes a measurement z = H x + v with var v = R into the estimate; S must not be 0.
    #[inline]
    pub fn update(&mut self, row: &X, measured: f64, variance: f64) -> Innovation {
        let spread = self.spread(row);
        let innovation = self.innovation_of(row, &spread, measured, variance);
        let mut gain = spread.clone();
        for k in gain.as_mut() {
            *k /= innovation.variance;
        }
        let n = spread.as_ref().len();
        let (k, spread) = (gain.as_ref(), spread.as_ref());
        for (x, k) in self.mean.as_mut().iter_mut().zip(k) {
            *x += k * innovation.value;
        }
        // First (I − K H) P, then its product with (I − K H)ᵀ, a rank at a time.
        let p = self.covariance.as_mut();
        for (p, k) in p.chunks_exact_mut(n).zip(k) {
            for (p, s) in p.iter_mut().zip(spread) {
                *p -= k * s;
            }
            let left = dot(p, row.as_ref()) - k * variance;
            for (p, k) in p.iter_mut().zip(gain.as_ref()) {
                *p -= left * k;
            }
        }
        symmetrise(n, p);
        innovation
    }

    #[inline]
    fn innovation_of(&self, row: &X, spread: &X, measured: f64, variance: f64) -> Innovation {
        Innovation {
            value: measured - dot(row.as_ref(), self.mean.as_ref()),
            variance: dot(row.as_ref(), spread.as_ref()) + variance,
        }
    }

    /// P Hᵀ.
    #[inline]
    fn spread(&self, row: &X) -> X {
        let mut spread = row.clone();
        let n = row.as_ref().len();
        let rows = self.covariance.as_ref().chunks_exact(n);
        for (s, p) in spread.as_mut().iter_mut().zip(rows) {
            *s = dot(p, row.as_ref());
        }
        spread
    }
}

#[inline]
fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

/// A B of two matrices of n × n. Transitions are mostly zeros, which cost nothing.
#[inline]
fn product<P: Storage>(n: usize, a: &[f64], b: &P) -> P {
    let mut product = b.clone();
    product.as_mut().fill(0.0);
    let rows = product.as_mut().chunks_exact_mut(n);
    for (row, a) in rows.zip(a.chunks_exact(n)) {
        let terms = a.iter().zip(b.as_ref().chunks_exact(n));
        for (a, b) in terms.filter(|(a, _)| **a != 0.0) {
            row.iter_mut().zip(b).for_each(|(sum, b)| *sum += a * b);
        }
    }
    product
}

#[inline]
fn transpose(n: usize, p: &mut [f64]) {
    for i in 0..n {
        for j in 0..i {
            p.swap(i * n + j, j * n + i);
        }
    }
}

/// Rounding leaves the two halves of a covariance apart; each takes their mean.
#[inline]
fn symmetrise(n: usize, p: &mut [f64]) {
    for i in 0..n {
        for j in 0..i {
            let mean = 0.5 * (p[i * n + j] + p[j * n + i]);
            (p[i * n + j], p[j * n + i]) = (mean, mean);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use adskalman::{
        CovarianceUpdateMethod, KalmanFilterNoControl, ObservationModel, StateAndCovariance,
        TransitionModelLinearNoControl,
    };
    use nalgebra::{DMatrix, DVector, Matrix1, RowVector4, SMatrix, SVector, U1, U4, Vector1};

    type Square = SMatrix<f64, 4, 4>;

    /// Numbers in (−1, 1) that are the same in every run.
    fn numbers() -> impl FnMut() -> f64 {
        let mut state = 1_u64;
        move || {
            state = state
                .wrapping_mul(6_364_136_223_846_793_005)
                .wrapping_add(1_442_695_040_888_963_407);
            (state >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
        }
    }

    /// A Aᵀ of random A: symmetric and positive.
    fn covariance(n: usize, number: &mut impl FnMut() -> f64) -> DMatrix<f64> {
        let root = DMatrix::from_fn(n, n, |_, _| number());
        &root * root.transpose()
    }

    struct Model {
        f: Square,
        ft: Square,
        q: Square,
        h: RowVector4<f64>,
        ht: SVector<f64, 4>,
        r: Matrix1<f64>,
    }

    impl TransitionModelLinearNoControl<f64, U4> for Model {
        fn F(&self) -> &Square {
            &self.f
        }
        fn FT(&self) -> &Square {
            &self.ft
        }
        fn Q(&self) -> &Square {
            &self.q
        }
    }

    impl ObservationModel<f64, U4, U1> for Model {
        fn H(&self) -> &RowVector4<f64> {
            &self.h
        }
        fn HT(&self) -> &SVector<f64, 4> {
            &self.ht
        }
        fn R(&self) -> &Matrix1<f64> {
            &self.r
        }
    }

    /// Row by row; nalgebra stores columns.
    fn rows(matrix: &Square) -> [f64; 16] {
        matrix.transpose().as_slice().try_into().unwrap()
    }

    fn near(ours: &[f64], theirs: &[f64]) {
        for (a, b) in ours.iter().zip(theirs) {
            assert!(
                (a - b).abs() <= 1e-9 * (1.0 + b.abs()),
                "{ours:?} {theirs:?}"
            );
        }
    }

    /// 300 steps of random models with adskalman's filter, each from where the other left off.
    #[test]
    fn agrees_with_adskalman() {
        let mut number = numbers();
        let p = Square::from_iterator(covariance(4, &mut number).iter().copied());
        let mut theirs = StateAndCovariance::new(SVector::from_fn(|_, _| number()), p);
        let mut ours = Estimate {
            mean: [0, 1, 2, 3].map(|i| theirs.state()[i]),
            covariance: rows(&p),
        };
        for _ in 0..300 {
            let f = Square::from_fn(|_, _| 0.5 * number());
            let h = RowVector4::from_fn(|_, _| number());
            let model = Model {
                f,
                ft: f.transpose(),
                q: Square::from_iterator(covariance(4, &mut number).iter().copied()),
                h,
                ht: h.transpose(),
                r: Matrix1::new(0.01 + number().powi(2)),
            };
            let z = number();
            let form = CovarianceUpdateMethod::JosephForm;
            let filter = KalmanFilterNoControl::new(&model, &model);
            theirs = filter
                .step_with_options(&theirs, &Vector1::new(z), form)
                .unwrap();
            ours.predict(&rows(&f), &[0.0; 4], &rows(&model.q));
            let h = [h[0], h[1], h[2], h[3]];
            assert_eq!(
                ours.innovation(&h, z, model.r[0]),
                ours.update(&h, z, model.r[0])
            );
            near(&ours.mean, theirs.state().as_slice());
            near(&ours.covariance, &rows(theirs.covariance()));
        }
    }

    /// A state of any length, with the formulas written down as they stand.
    #[test]
    fn agrees_with_matrices() {
        for n in [1, 2, 5, 12] {
            let mut number = numbers();
            let (mut x, mut p) = (
                DVector::from_fn(n, |_, _| number()),
                covariance(n, &mut number),
            );
            let flat = |matrix: &DMatrix<f64>| matrix.transpose().as_slice().to_vec();
            let mut ours = Estimate {
                mean: x.as_slice().to_vec(),
                covariance: flat(&p),
            };
            for _ in 0..100 {
                let f = DMatrix::from_fn(n, n, |_, _| number() / n as f64);
                let (u, q) = (
                    DVector::from_fn(n, |_, _| number()),
                    covariance(n, &mut number),
                );
                let h = DMatrix::from_fn(1, n, |_, _| number());
                let (z, r) = (number(), 0.01 + number().powi(2));
                (x, p) = (&f * &x + &u, &f * &p * f.transpose() + &q);
                let (y, s) = (z - (&h * &x)[0], (&h * &p * h.transpose())[0] + r);
                let k = &p * h.transpose() / s;
                x += &k * y;
                p = (DMatrix::identity(n, n) - &k * &h) * p;
                ours.predict(&flat(&f), &u.as_slice().to_vec(), &flat(&q));
                let innovation = ours.update(&h.as_slice().to_vec(), z, r);
                near(
                    &[innovation.value, innovation.variance, innovation.nis()],
                    &[y, s, y * y / s],
                );
                near(&ours.mean, x.as_slice());
                near(&ours.covariance, &flat(&p));
            }
        }
    }

    /// Where one direction is known to 1e-12 of the others, (I − K H) P is no covariance any more; Joseph's form is.
    #[test]
    fn stays_positive_when_ill_conditioned() {
        let mut estimate = Estimate {
            mean: vec![0.0; 3],
            covariance: vec![1e6, 0.0, 0.0, 0.0, 1e6, 0.0, 0.0, 0.0, 1e6],
        };
        let rows = [[1.0, 1.0, 1.0], [1.0, 1.0, 1.0 + 1e-6], [1.0, 0.0, -1.0]];
        for step in 0..300 {
            estimate.update(&rows[step % 3].to_vec(), 0.0, 1e-6);
            let p = DMatrix::from_row_slice(3, 3, &estimate.covariance);
            assert_eq!(p, p.transpose());
            assert!(p.symmetric_eigenvalues().min() > 0.0, "step {step}: {p}");
        }
    }
}
