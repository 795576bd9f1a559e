//! The search: how well the changes of both records agree at each offset.

use super::error::AlignmentError;

/// The pitch of the search, s.
pub const PITCH: f64 = 0.5;

/// The error of a change, by the air's temperature, as a share of it.
pub const SCALE: f64 = 0.05;

/// A clock is another than it says if it is off by more, s.
pub const OFF: f64 = 2.0;

/// The largest ρ, and that from which a barometer moves.
pub const MOST: f64 = 25.0;
const MOVES: f64 = 9.0;

/// The largest mean of ρ.
const FITS: f64 = 6.0;

/// The least share of the motion, of the less moving record and of the best τ.
const SHARE: f64 = 0.5;
const RIVAL: f64 = 0.6;

/// 2 ln 10⁶, times 8.
const CLEAR: f64 = 221.0;

/// How an offset fits.
#[derive(Clone, Copy, Debug)]
pub struct Fit {
    pub ahead: f64,
    pub sign: f64,
    evidence: f64,
    /// The sum of ρ, and of how many residuals, where one of the two moves.
    misfit: f64,
    count: f64,
    /// Those of it where only the barometer does.
    missed: (f64, f64),
    /// What the trips in both records could have of evidence.
    pub motion: f64,
}

/// Changes of both records, every half second.
pub struct Search {
    read: Vec<f64>,
    /// Where the course moves, or is not known.
    moving: Vec<(usize, f64)>,
    cells: usize,
    /// The sums of ρ and of counts up to each reading, where the barometer moves.
    moved: Vec<(f64, f64)>,
    /// The offset at which both begin together, s.
    begin: f64,
    pub variance: f64,
}

impl Search {
    pub fn new(read: Vec<f64>, course: Vec<f64>, begin: f64, variance: f64) -> Self {
        let mut sum = (0.0, 0.0);
        let moved = read.iter().map(|change| {
            let moves = moves(*change, variance);
            sum = (sum.0 + moves.0, sum.1 + moves.1);
            sum
        });
        let moved = [(0.0, 0.0)].into_iter().chain(moved).collect();
        let cells = course.len();
        let moving = course.into_iter().enumerate().filter(|it| it.1 != 0.0);
        Self {
            moved,
            moving: moving.collect(),
            cells,
            read,
            begin,
            variance,
        }
    }

    /// With the first reading at the place `shift` of the course.
    fn fit(&self, shift: isize, sign: f64) -> Fit {
        let place = |at: isize| at.clamp(0, self.read.len() as isize) as usize;
        let (from, to) = (
            place(shift.saturating_neg()),
            place((self.cells as isize).saturating_sub(shift)),
        );
        let mut missed = (
            self.moved[to].0 - self.moved[from].0,
            self.moved[to].1 - self.moved[from].1,
        );
        let (mut misfit, mut count, mut motion, mut stood) = (0.0, 0.0, 0.0, 0.0);
        for &(at, change) in &self.moving {
            let at = (at as isize).saturating_sub(shift);
            let read = usize::try_from(at).ok().and_then(|at| self.read.get(at));
            let Some(read) = read.copied().filter(|it| !it.is_nan()) else {
                continue;
            };
            let moves = moves(read, self.variance);
            missed = (missed.0 - moves.0, missed.1 - moves.1);
            if change.is_nan() {
                continue;
            }
            let scale = self.variance + (SCALE * change).powi(2);
            misfit += ((read - sign * change).powi(2) / scale).min(MOST);
            count += 1.0;
            motion += (change * change / self.variance).min(MOST);
            stood += (read * read / self.variance).min(MOST);
        }
        Fit {
            ahead: self.begin + PITCH * shift as f64,
            sign,
            evidence: stood - misfit - missed.0,
            misfit: misfit + missed.0,
            count: count + missed.1,
            missed,
            motion,
        }
    }

    /// Of all offsets at which the records overlap.
    pub fn fits(&self, signs: &[f64]) -> Vec<Fit> {
        let shifts = -(self.read.len() as isize)..self.cells as isize;
        let of = |sign| shifts.clone().map(move |shift| self.fit(shift, sign));
        signs.iter().flat_map(|sign| of(*sign)).collect()
    }

    /// How the rides fit about where the clocks say, if they do.
    pub fn agrees(&self, said: f64, signs: &[f64]) -> Option<Fit> {
        let shift = ((said - self.begin) / PITCH).round() as isize;
        let near = (OFF / PITCH) as isize;
        let fits = signs.iter().flat_map(|sign| {
            (-near..=near).map(move |by| self.fit(shift.saturating_add(by), *sign))
        });
        fits.filter(|it| it.evidence > 0.0 && it.mean() <= FITS)
            .max_by(|a, b| a.evidence.total_cmp(&b.evidence))
    }

    pub fn best(&self, fits: &[Fit]) -> Result<Fit, AlignmentError> {
        let best = fits.iter().max_by(|a, b| a.evidence.total_cmp(&b.evidence));
        let best = *best.ok_or(AlignmentError::NoRide)?;
        if best.evidence <= 0.0 || best.mean() > FITS {
            return Err(AlignmentError::Unlike);
        }
        Ok(best)
    }

    /// The least motion to be believed, where so many rides are in both records.
    pub fn least_motion(&self, rides: usize) -> f64 {
        let known = self.moving.iter().filter(|it| !it.1.is_nan());
        let rho = known.map(|it| (it.1 * it.1 / self.variance).min(MOST));
        let (course, read) = (rho.sum::<f64>(), self.moved.last().map_or(0.0, |it| it.0));
        match rides {
            0 => f64::INFINITY,
            1 => SHARE * course.max(read),
            _ => SHARE * course.min(read),
        }
    }
}

impl Fit {
    fn mean(&self) -> f64 {
        self.misfit / self.count
    }

    /// That no other one is about as good.
    pub fn is_only(&self, fits: &[Self], apart: f64) -> Result<(), AlignmentError> {
        let mean = self.mean().max(1.0);
        let rivals = fits.iter().filter(|it| {
            let is_other = (it.ahead - self.ahead).abs() > apart;
            // The accelerometer may have missed a ride.
            let (misfit, count) = (it.misfit - it.missed.0, it.count - it.missed.1);
            let is_like = misfit - mean * count < CLEAR;
            is_other && is_like && it.motion > RIVAL * self.motion
        });
        let rival = rivals.min_by(|a, b| a.mean().total_cmp(&b.mean()));
        rival.map_or(Ok(()), |rival| {
            Err(AlignmentError::Ambiguous(self.ahead, rival.ahead))
        })
    }
}

/// ρ of a change that is none, and that it is counted, where a barometer moves.
fn moves(change: f64, variance: f64) -> (f64, f64) {
    let rho = change * change / variance;
    // Not where it is not known.
    if rho > MOVES {
        (rho.min(MOST), 1.0)
    } else {
        (0.0, 0.0)
    }
}
