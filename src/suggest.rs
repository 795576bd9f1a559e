//! "Did you mean": the known name nearest to what was written.

/// The nearest of `known` to `got` by edits and transpositions, where no more than a third of it differs.
pub fn nearest<'a>(got: &str, known: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    known
        .into_iter()
        .map(|name| (strsim::damerau_levenshtein(got, name), name))
        .min()
        .filter(|&(distance, name)| distance <= name.len().div_ceil(3))
        .map(|(_, name)| name)
}

/// `` `got`, did you mean `near`? (one of a, b, c) ``
pub fn among<'a>(got: &str, known: impl IntoIterator<Item = &'a str> + Clone) -> String {
    let hint = nearest(got, known.clone())
        .map_or(String::new(), |name| format!(", did you mean `{name}`?"));
    let known: Vec<&str> = known.into_iter().collect();
    format!("`{got}`{hint} (one of {})", known.join(", "))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn near_names_are_suggested_and_far_ones_are_not() {
        assert_eq!(nearest("detla", ["nu", "delta"]), Some("delta"));
        assert_eq!(nearest("gauss", ["normal", "cauchy"]), None);
        assert_eq!(
            among("tehta", ["nu", "theta"]),
            "`tehta`, did you mean `theta`? (one of nu, theta)"
        );
    }
}
