//! Gravity at rest, from the three axes of an accelerometer in any pose, and what a reading is beside it.
//!
//! The way of [^1], eqs (1)–(4): readings whose length is an outlier are left out; what remains is taken by its geometric
//! median, the point with the least sum of distances, found by Weiszfeld's iteration from their mean. As printed the
//! iteration divides by zero where it meets a reading; Vardi and Zhang's step [^2] goes on from there, or ends there.
//!
//! Where the steps of the sensor are coarser than its noise, readings lie on a lattice, and their geometric median sticks to
//! one of its points: there the mean is taken ([`Estimator::Calibration`]). Every estimator here is measured by
//! `configs/gravity.toml`.
//!
//! A reading is then taken apart, eqs (7)–(10): the residual over gravity, its part along gravity, and what is left across
//! it. Eq. (9) as printed is the product of that part and g, which is no acceleration; what is meant is its direction g/|g|.
//!
//! [^1]: The monitor with accelerometer and barometer, in Chinese (楊昱等, 太原理工大學學報).
//! [^2]: Y. Vardi, C.-H. Zhang, "The multivariate L1-median and associated data depth", PNAS 97 (2000), eq. (2.6).

use crate::stats::quantile::median;
use crate::vector::{Vector, cross, dot, length, mix};

/// Readings are left out whose length is farther from the median length than this, in deviations of theirs, and in steps.
const OUTLIER: f64 = 3.0;
const STEPS: f64 = 2.0;

/// The iteration ends with a step below this, m/s², or after so many.
const STEP: f64 = 1e-8;
const MOST_STEPS: usize = 1000;

/// What sums of directions and of distances may be off by, a reading.
const ROUNDING: f64 = 1e-13;

/// How gravity is found from readings at rest.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Estimator {
    /// Their mean.
    Mean,
    /// The mean without outliers.
    Trimmed,
    /// Their geometric median.
    Median,
    /// As printed: the geometric median without outliers.
    Printed,
    /// As printed, but the mean without outliers where steps are coarser than the noise.
    Calibration,
}

impl Estimator {
    /// All of them.
    pub const ALL: [Self; 5] = [
        Self::Mean,
        Self::Trimmed,
        Self::Median,
        Self::Printed,
        Self::Calibration,
    ];

    /// As a part of names.
    pub fn name(self) -> &'static str {
        match self {
            Self::Mean => "mean",
            Self::Trimmed => "trimmed",
            Self::Median => "median",
            Self::Printed => "printed",
            Self::Calibration => "calibration",
        }
    }

    /// Gravity from readings at rest, m/s², of a sensor with this step, m/s²; none without readings.
    pub fn gravity(self, readings: &[Vector], step: f64) -> Option<Vector> {
        if readings.is_empty() {
            return None;
        }
        let sound = || without_outliers(readings, step);
        Some(match self {
            Self::Mean => mean(readings),
            Self::Trimmed => mean(&sound()),
            Self::Median => geometric_median(readings),
            Self::Printed => geometric_median(&sound()),
            Self::Calibration => {
                let sound = sound();
                if is_lattice(&sound, step) {
                    mean(&sound)
                } else {
                    geometric_median(&sound)
                }
            }
        })
    }
}

/// A reading over gravity, taken apart.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Parts {
    /// Along gravity, m/s²: up positive, as the sensor reads gravity upwards.
    pub vertical: f64,
    /// Across it, m/s².
    pub horizontal: Vector,
}

impl Parts {
    /// Of a reading, where rest reads this, which is gravity if there is any, and up is there: a direction of length 1.
    pub fn of(reading: Vector, rest: Vector, up: Vector) -> Self {
        let residual = mix([(1.0, reading), (-1.0, rest)]);
        let vertical = dot(residual, up);
        Self {
            vertical,
            horizontal: mix([(1.0, residual), (-vertical, up)]),
        }
    }
}

/// The point with the least sum of distances from these, of which there is at least one.
///
/// Weiszfeld's steps always come nearer, but ever slower beside a reading that nearly is the median. So each is measured
/// against Newton's, which is exact where it ends, and against the nearest reading, from which a step leads to where
/// Newton's are good.
pub fn geometric_median(points: &[Vector]) -> Vector {
    let mut at = mean(points);
    for _ in 0..MOST_STEPS {
        let pull = Pull::at(points, at);
        if pull.is_balanced() {
            return at;
        }
        let next = pull.next(points);
        let step = length(mix([(1.0, next), (-1.0, at)]));
        at = next;
        if step < STEP && !points.contains(&at) {
            break;
        }
    }
    at
}

fn sum_of_distances(points: &[Vector], at: Vector) -> f64 {
    let distances = points
        .iter()
        .map(|it| length(mix([(1.0, *it), (-1.0, at)])));
    distances.sum()
}

/// What draws a point to others.
struct Pull {
    at: Vector,
    /// The sum of the directions to them.
    sum: Vector,
    /// The sum of their inverse distances, s²/m.
    weights: f64,
    /// The second derivative of the sum of distances, by rows, s²/m.
    curvature: [Vector; 3],
    /// How many lie where it is, of how many.
    here: f64,
    all: f64,
    nearest: Vector,
}

impl Pull {
    fn at(points: &[Vector], at: Vector) -> Self {
        let mut pull = Self {
            at,
            sum: [0.0; 3],
            weights: 0.0,
            curvature: [[0.0; 3]; 3],
            here: 0.0,
            all: points.len() as f64,
            nearest: at,
        };
        let mut least = f64::INFINITY;
        for point in points {
            let to = mix([(1.0, *point), (-1.0, at)]);
            let distance = length(to);
            if distance == 0.0 {
                pull.here += 1.0;
                continue;
            }
            let towards = to.map(|along| along / distance);
            pull.weights += 1.0 / distance;
            pull.sum = mix([(1.0, pull.sum), (1.0, towards)]);
            for axis in 0..3 {
                let row = mix([
                    (1.0, pull.curvature[axis]),
                    (-towards[axis] / distance, towards),
                ]);
                pull.curvature[axis] = row;
                pull.curvature[axis][axis] += 1.0 / distance;
            }
            if distance < least {
                (least, pull.nearest) = (distance, *point);
            }
        }
        pull
    }

    /// Whether it is the median, as far as rounding tells.
    fn is_balanced(&self) -> bool {
        length(self.sum) <= self.here + ROUNDING * self.all
    }

    /// The nearest reading, or where Newton's step leads or else Weiszfeld's: what is best but for rounding, in this order.
    fn next(&self, points: &[Vector]) -> Vector {
        let after = |step: Vector| mix([(1.0, self.at), (1.0, step)]);
        let weiszfeld = after(self.weiszfeld());
        let [here, most] = [self.at, weiszfeld].map(|it| sum_of_distances(points, it));
        let newton = self.newton().map(after);
        let newton = newton.filter(|it| sum_of_distances(points, *it) <= most * (1.0 + ROUNDING));
        let is_better = self.here == 0.0 && sum_of_distances(points, self.nearest) < here;
        if is_better {
            self.nearest
        } else {
            newton.unwrap_or(weiszfeld)
        }
    }

    /// Weiszfeld's step, shortened by the readings that hold it.
    fn weiszfeld(&self) -> Vector {
        let share = 1.0 - self.here / length(self.sum);
        self.sum.map(|along| share / self.weights * along)
    }

    /// The step to where a parabola would be balanced; none from a reading, nor where all lie on a line.
    fn newton(&self) -> Option<Vector> {
        let [x, y, z] = self.curvature;
        let inverse = [cross(y, z), cross(z, x), cross(x, y)];
        let determinant = dot(x, inverse[0]);
        let is_regular = determinant > ROUNDING * self.weights.powi(3) && self.here == 0.0;
        let step = [0, 1, 2].map(|axis| dot(inverse[axis], self.sum) / determinant);
        is_regular.then_some(step)
    }
}

fn mean(points: &[Vector]) -> Vector {
    let sum = points
        .iter()
        .fold([0.0; 3], |sum, it| mix([(1.0, sum), (1.0, *it)]));
    sum.map(|along| along / points.len() as f64)
}

/// Those whose length is like that of the others: the deviation is that of the median distance from their median, so that
/// the outliers themselves do not widen it.
fn without_outliers(points: &[Vector], step: f64) -> Vec<Vector> {
    let lengths: Vec<f64> = points.iter().map(|it| length(*it)).collect();
    let middle = median(lengths.clone());
    let deviation = 1.4826 * median(lengths.iter().map(|it| (it - middle).abs()).collect());
    let most = (OUTLIER * deviation).max(STEPS * step);
    let near = points.iter().zip(lengths);
    let near = near.filter(|(_, length)| (length - middle).abs() <= most);
    near.map(|(point, _)| *point).collect()
}

/// Whether the step is larger than the deviation of an axis.
fn is_lattice(points: &[Vector], step: f64) -> bool {
    let mean = mean(points);
    let variance = |axis: usize| {
        let squares = points.iter().map(|it| (it[axis] - mean[axis]).powi(2));
        squares.sum::<f64>() / points.len() as f64
    };
    (0..3).any(|axis| step * step > variance(axis))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::vector::unit;
    use proptest::prelude::*;

    /// The least sum by trying 26 directions and the steepest with ever smaller steps, since at a reading that nearly is the
    /// median only few directions lead down; or a reading, since beside one that is they lead ever less far.
    fn brute(points: &[Vector]) -> Vector {
        let sum = |at: &Vector| sum_of_distances(points, *at);
        let (mut at, mut step) = (mean(points), 4.0);
        while step > 1e-10 {
            let to = points.iter().map(|it| mix([(1.0, *it), (-1.0, at)]));
            let pull = to
                .filter_map(unit)
                .fold([0.0; 3], |sum, it| mix([(1.0, sum), (1.0, it)]));
            let cube = (0..27).map(|k| [k % 3, k / 3 % 3, k / 9].map(|it| f64::from(it) - 1.0));
            let tried = cube
                .chain(unit(pull))
                .map(|by| mix([(1.0, at), (step, by)]));
            let best = tried.min_by(|a, b| sum(a).total_cmp(&sum(b)));
            match best.filter(|it| sum(it) < sum(&at)) {
                Some(better) => at = better,
                None => step /= 2.0,
            }
        }
        let all = points.iter().copied().chain([at]);
        all.min_by(|a, b| sum(a).total_cmp(&sum(b))).unwrap()
    }

    /// Whether it is as near as a brute search comes, unless that ends before.
    fn is_least(points: &[Vector]) -> bool {
        let (found, brute) = (geometric_median(points), brute(points));
        let worse = sum_of_distances(points, found) - sum_of_distances(points, brute);
        let off = length(mix([(1.0, found), (-1.0, brute)]));
        worse < 1e-13 * points.len() as f64 && (off < 1e-6 || worse < -1e-12)
    }

    /// Only of readings on a line more than one point may be the median.
    fn are_on_a_line(points: &[Vector]) -> bool {
        let from = |it: &Vector| mix([(1.0, *it), (-1.0, points[0])]);
        let pairs = points
            .iter()
            .flat_map(|a| points.iter().map(move |b| (from(a), from(b))));
        pairs
            .map(|(a, b)| length(cross(a, b)))
            .all(|area| area == 0.0)
    }

    proptest! {
        #[test]
        fn it_is_the_least_sum_of_distances(
            points in prop::collection::vec([-3.0..3.0f64, -3.0..3.0, -3.0..3.0], 4..30),
        ) {
            prop_assert!(is_least(&points));
        }

        /// On a lattice it often is a reading, of which there are several.
        #[test]
        fn on_a_lattice_too(
            points in prop::collection::vec([-2..3i32, -2..3, -2..3], 4..30),
        ) {
            let points: Vec<Vector> = points.iter().map(|it| it.map(f64::from)).collect();
            if are_on_a_line(&points) {
                let more = [geometric_median(&points), brute(&points)].map(|it| sum_of_distances(&points, it));
                prop_assert!(more[0] - more[1] < 1e-9);
            } else {
                prop_assert!(is_least(&points));
            }
        }

        /// Of a triangle with two like sides it is the point that sees all sides at 120 degrees, or the corner between them,
        /// however near it is to that.
        #[test]
        fn in_a_triangle(decades in -9.0..0.0f64, is_inside: bool, half in 0.1..10.0f64) {
            let near = if is_inside { 1.0 } else { -1.0 } * libm::pow(10.0, decades);
            let along = half / 3f64.sqrt() + near;
            let points = [[0.0; 3], [along, half, 0.0], [along, -half, 0.0]];
            let off = mix([(1.0, geometric_median(&points)), (-1.0, [near.max(0.0), 0.0, 0.0])]);
            prop_assert!(along < 0.0 || length(off) < 1e-7, "{:?}", off);
        }

        /// A reading is gravity and its parts, and the horizontal is across.
        #[test]
        fn parts_are_the_whole(
            reading in [-20.0..20.0f64, -20.0..20.0, -20.0..20.0],
            gravity in [-9.0..9.0f64, -9.0..9.0, 1.0..9.0],
        ) {
            let up = unit(gravity).unwrap();
            let Parts { vertical, horizontal } = Parts::of(reading, gravity, up);
            let whole = mix([(1.0, gravity), (vertical, up), (1.0, horizontal)]);
            prop_assert!(length(mix([(1.0, whole), (-1.0, reading)])) < 1e-9);
            prop_assert!(dot(horizontal, gravity).abs() < 1e-9);
        }
    }

    /// The iteration begins at the mean, which here is a reading and not the median, and then is both.
    #[test]
    fn a_reading_at_the_start() {
        let points = [
            [0.0, 0.0, 0.0],
            [4.0, 0.0, 0.0],
            [-1.0, 1.0, 0.0],
            [-3.0, -1.0, 0.0],
        ];
        assert!(is_least(&points));
        let lattice = [
            [0, -1, 2],
            [-1, 1, 0],
            [1, 1, 0],
            [-2, 2, -1],
            [0, 1, 2],
            [-2, 0, -1],
        ];
        let lattice = lattice.map(|it| it.map(f64::from));
        // At the second reading the others pull with 1.00064.
        assert!(is_least(&lattice));
        let points = [[0.0; 3], [1.0, 0.0, 0.0], [-1.0, 0.0, 0.0]];
        assert_eq!(geometric_median(&points), [0.0; 3]);
        assert_eq!(geometric_median(&[[1.0, 2.0, 3.0]; 5]), [1.0, 2.0, 3.0]);
    }

    #[test]
    fn a_shock_is_left_out_and_a_lattice_is_averaged() {
        let mut points: Vec<Vector> = (0..100)
            .map(|k| [0.0, 0.01 * f64::from(k % 7), 9.8])
            .collect();
        points.push([0.0, 0.0, 30.0]);
        let trimmed = Estimator::Trimmed.gravity(&points, 0.0).unwrap();
        assert!((trimmed[2] - 9.8).abs() < 1e-9);
        let coarse: Vec<Vector> = (0..100)
            .map(|k| [0.0, 0.0, if k % 4 == 0 { 9.7 } else { 9.9 }])
            .collect();
        assert_eq!(
            Estimator::Printed.gravity(&coarse, 0.2),
            Some([0.0, 0.0, 9.9])
        );
        let mean = Estimator::Calibration.gravity(&coarse, 0.2).unwrap();
        assert!((mean[2] - 9.85).abs() < 1e-9);
        assert_eq!(Estimator::Mean.gravity(&[], 0.0), None);
    }
}
