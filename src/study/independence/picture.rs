//! P(W, T) against P(W)·P(T), for every W, T and sizes: on the diagonal where W and T are independent.

use super::row::{Row, findings};
use crate::format::thousands;
use crate::plot::{Axis, Colour, Entry, Key, Mark, Place, Plot, Point, Style};

const DIAGONAL: Style = Style::of(0).wide(0.8).coloured(Colour::BLACK.faded(0.6));
/// Sizes that a legend can name.
const NAMED: usize = 18;

/// The picture of an enumeration.
pub fn plot(rows: &[Row]) -> Plot {
    let sizes: Vec<&[Row]> = rows.chunk_by(|a, b| sizes_of(a) == sizes_of(b)).collect();
    let logarithms = rows.iter().flat_map(places).filter(|x| x.is_finite());
    let lowest = logarithms.fold(-1.0, f64::min).floor();
    let axis = Axis::powers_of_ten(lowest - 0.2, 0.2, 8);
    let lower_edge = axis.from;
    let diagonal = vec![(axis.from, axis.from), (axis.to, axis.to)];
    let x = axis.clone().labelled("P(W)·P(T)");
    let mut plot = Plot::stack(&x, [(270.0, axis.labelled("P(W, T)"))]);
    plot.add(0, Mark::Grid);
    plot.add(0, Mark::Line(diagonal, DIAGONAL));
    for (index, rows) in sizes.iter().enumerate() {
        // A cell that never occurs lies on the lower edge.
        let points = rows
            .iter()
            .map(places)
            .map(|[x, y]| Point::at((x, y.max(lower_edge))));
        plot.add(
            0,
            Mark::Markers(points.collect(), Style::of(index).sized(1.8)),
        );
    }
    plot.add(0, Mark::Axes);
    let names = sizes.iter().take(NAMED);
    let names = names.map(|rows| sizes_of(&rows[0]).map(|size| size.to_string()).join("/"));
    plot.add_legend(Entry::of_curves(names, Key::Marker), Place::Free);
    plot.set_caption(&caption(rows));
    plot
}

fn sizes_of(row: &Row) -> [usize; 3] {
    [row.reference, row.shift, row.scale]
}

/// Decimal logarithms of both probabilities.
fn places(row: &Row) -> [f64; 2] {
    [row.product, row.joint].map(libm::log10)
}

fn caption(rows: &[Row]) -> [String; 4] {
    let findings = findings(rows);
    let assignments: u64 = findings.iter().map(|finding| finding.assignments).sum();
    let largest = findings.iter().map(|finding| finding.largest_difference);
    let (assignments, pairs) = (thousands(assignments), thousands(rows.len() as u64));
    let largest = largest.max().unwrap_or(0);
    [
        "N/M_1/M_2 as in the legend".to_owned(),
        format!("all {assignments} assignments of ranks enumerated"),
        format!("{pairs} pairs of W and T"),
        format!("largest |n(W, T)·n − n(W)·n(T)| in whole numbers: {largest}"),
    ]
}
