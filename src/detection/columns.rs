//! A trip as a row: the columns are the fields of [`Trip`]; those of its decisions have the prefix `start` or
//! `stop`. A field added there is a column here.

use super::Trip;
use crate::fields::names;
use crate::monitor::Decision;
use serde_json::Value;

/// Fields of a decision without a column: α is the same for all, and the times of samples are for pictures.
const NOT_SHOWN: [&str; 4] = ["alpha", "reference", "shift", "scale"];

/// The names of the columns, in their order.
pub fn columns() -> Vec<String> {
    let decision = names::<Decision>().iter();
    let shown: Vec<_> = decision.filter(|name| !NOT_SHOWN.contains(name)).collect();
    let trip = names::<Trip>().iter();
    trip.flat_map(|name| match name.strip_suffix("decision") {
        Some(of) => shown.iter().map(|field| format!("{of}{field}")).collect(),
        None => vec![(*name).to_owned()],
    })
    .collect()
}

impl Trip {
    /// The value of a column; null if it has none.
    pub fn column(&self, name: &str) -> Value {
        let trip = serde_json::to_value(self).expect("a trip is plain data");
        let nested = || {
            let (of, field) = name.split_once('_')?;
            trip.get(format!("{of}_decision"))?.get(field)
        };
        (trip.get(name).or_else(nested))
            .cloned()
            .unwrap_or_default()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_columns_are_the_fields() {
        let columns = columns().join(",");
        assert_eq!(
            columns,
            "ride,direction,start,inertial,braking,levelling,stop,speed,ended,or_start,or_stop,\
             start_rank_sum,start_exceedances,start_lower,start_upper,stop_rank_sum,stop_exceedances,\
             stop_lower,stop_upper,start_at,stop_at"
        );
    }
}
