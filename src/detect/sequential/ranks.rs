//! Sequential ranks: where each block lies among those before it, as a number that is uniform whatever the noise is.
//!
//! With t blocks x₁ … x_t and v uniform on (0, 1],
//!
//! U_t = (#{s < t: x_s < x_t} + v·(#{s < t: x_s = x_t} + 1)) / t.
//!
//! # Theorem
//! If the blocks are exchangeable, U₁, U₂, … are independent and uniform on (0, 1): for any law of the blocks,
//! continuous or with ties.
//!
//! *Proof.* Give each block an independent uniform key and order the pairs (block, key) lexicographically. No two are
//! equal, and they are exchangeable, so every order of the first t is equally likely. The sequential ranks
//! R_s = 1 + #{r < s: pair r below pair s} map the t! orders one to one onto the t! sequences with 1 ≤ R_s ≤ s. So they
//! are independent, and R_t is uniform on 1 … t [^1]. With w_t another uniform number, (R_t − 1 + w_t)/t is then uniform
//! on (0, 1) and independent of all others. It remains that U_t has the same law with a single number v. Given all
//! blocks, let m_t be the number of earlier ones that equal x_t. R_t − 1 is the number of earlier blocks below x_t plus
//! J_t, the number of keys among the m_t that are below key t. Within each group of equal blocks the J are sequential
//! ranks of the keys less one: independent, and J_t uniform on 0 … m_t. So (J_t + w_t)/(m_t + 1) are independent and
//! uniform given the blocks, and may be replaced by fresh v. ∎
//!
//! Only the order of blocks since the beginning enters. Blocks after a stopping time that is a function of these U, such
//! as an alarm, are exchangeable among themselves again, and the ranks may begin anew with them.
//!
//! [^1]: O. Barndorff-Nielsen, "On the limit behaviour of extreme order statistics", Ann. Math. Statist. 34, 1963;
//!     A. Rényi, "Théorie des éléments saillants d'une suite d'observations", 1962.

use serde::{Deserialize, Serialize};

/// The blocks since the beginning: 8 bytes for each. A step takes time in proportion to the root of their number (some
/// tenth of a microsecond at a thousand).
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Ranks {
    /// Nearly all, in ascending order.
    sorted: Vec<f64>,
    /// The latest, in ascending order.
    latest: Vec<f64>,
}

impl Ranks {
    /// Takes in a block `x`, which is a number, with `v` uniform on (0, 1], and returns U in (0, 1].
    pub fn step(&mut self, x: f64, v: f64) -> f64 {
        debug_assert!(!x.is_nan() && v > 0.0 && v <= 1.0);
        let [below, equal] = place(&self.sorted, x);
        let [below_latest, equal_latest] = place(&self.latest, x);
        self.latest.insert(below_latest, x);
        let t = self.seen() as f64;
        if self.latest.len().pow(2) > 4096 + 4 * self.sorted.len() {
            self.sort();
        }
        ((below + below_latest) as f64 + v * ((equal + equal_latest) as f64 + 1.0)) / t
    }

    fn sort(&mut self) {
        self.sorted.append(&mut self.latest);
        self.sorted.sort_by(f64::total_cmp);
    }

    /// t, the number of blocks so far.
    pub fn seen(&self) -> usize {
        self.sorted.len() + self.latest.len()
    }

    /// Begins anew after these blocks, which are numbers.
    pub fn begin(&mut self, blocks: &[f64]) {
        self.clear();
        self.latest.extend_from_slice(blocks);
        self.sort();
    }

    /// Begins anew.
    pub fn clear(&mut self) {
        self.sorted.clear();
        self.latest.clear();
    }
}

/// The numbers of blocks below `x`, and equal to it.
fn place(sorted: &[f64], x: f64) -> [usize; 2] {
    let below = sorted.partition_point(|earlier| *earlier < x);
    let equal = sorted[below..].partition_point(|earlier| *earlier <= x);
    [below, equal]
}
