//! Vectors of three parts.

/// A vector by its parts along x, y and z, or along the columns there are.
pub type Vector = [f64; 3];

/// The inner product.
pub fn dot(a: Vector, b: Vector) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// The vector across both.
pub fn cross(a: Vector, b: Vector) -> Vector {
    [
        a[1] * b[2] - a[2] * b[1],
        a[2] * b[0] - a[0] * b[2],
        a[0] * b[1] - a[1] * b[0],
    ]
}

/// The Euclidean norm.
pub fn length(v: Vector) -> f64 {
    dot(v, v).sqrt()
}

/// The vector of length 1 in this direction, if it has one.
pub fn unit(v: Vector) -> Option<Vector> {
    let length = length(v);
    (length > 0.0 && length.is_finite()).then(|| v.map(|along| along / length))
}

/// Degrees between two vectors of length 1.
pub fn angle(a: Vector, b: Vector) -> f64 {
    libm::acos(dot(a, b).clamp(-1.0, 1.0)).to_degrees()
}

/// The place of the largest part.
pub fn largest(v: Vector) -> usize {
    let larger = |a: &usize, b: &usize| v[*a].abs().total_cmp(&v[*b].abs());
    (0..3).max_by(larger).unwrap_or(0)
}

/// The place of the smallest part.
pub fn smallest(v: Vector) -> usize {
    let smaller = |a: &usize, b: &usize| v[*a].abs().total_cmp(&v[*b].abs());
    (0..3).min_by(smaller).unwrap_or(0)
}

/// The sum of vectors, each times its number.
pub fn mix<const N: usize>(parts: [(f64, Vector); N]) -> Vector {
    [0, 1, 2].map(|axis| parts.iter().map(|(share, v)| share * v[axis]).sum())
}
