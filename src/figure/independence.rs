//! P(W, T) against P(W)·P(T), for every W, T and sizes: on the diagonal where W and T are independent.

use crate::study::independence::{Row, findings};
use crate::format::thousands;
use crate::plot::{Axis, Colour, Entry, Key, Legend, Mark, Place, Plot, Point, Style};

/// Sizes that a legend can name.
const NAMED: usize = 18;

/// The picture of an enumeration.
pub fn plot(rows: &[Row]) -> Plot {
    let sizes: Vec<&[Row]> = rows.chunk_by(|a, b| sizes_of(a) == sizes_of(b)).collect();
    let logarithms = rows.iter().flat_map(places).filter(|x| x.is_finite());
    let lowest = logarithms.fold(-1.0, f64::min).floor();
    let axis = Axis::powers_of_ten(lowest - 0.2, 0.2, 8);
    let (from, to) = (axis.from, axis.to);
    let (x, y) = (axis.clone().labelled("P(W)·P(T)"), axis.labelled("P(W, T)"));
    let mut plot = Plot::stack(&x, [(270.0, y)]);
    plot.add(0, Mark::Grid);
    let diagonal = Style {
        colour: Colour::BLACK.faded(0.6),
        ..Style::of(0).solid()
    };
    plot.add(0, Mark::line([(from, from), (to, to)], 0.8, diagonal));
    for (index, rows) in sizes.iter().enumerate() {
        // A cell that never occurs lies on the lower edge.
        let points = rows
            .iter()
            .map(places)
            .map(|[x, y]| Point::at(x, y.max(from)));
        let style = Style::of(index);
        plot.add(
            0,
            Mark::Points {
                points: points.collect(),
                size: 1.8,
                width: 0.0,
                style,
            },
        );
    }
    plot.add(0, Mark::Axes);
    plot.add(0, Mark::Legend);
    let entries = sizes.iter().take(NAMED).enumerate().map(|(index, rows)| {
        let text = sizes_of(&rows[0]).map(|size| size.to_string()).join("/");
        Entry::new(text, Style::of(index), Key::Marker)
    });
    plot.legend = Some(Legend::new(entries.collect(), Place::Free));
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
    [
        "N/M_1/M_2 as in the legend".to_owned(),
        format!(
            "all {} assignments of ranks enumerated",
            thousands(assignments)
        ),
        format!("{} pairs of W and T", thousands(rows.len() as u64)),
        format!(
            "largest |n(W, T)·n − n(W)·n(T)| in whole numbers: {}",
            largest.max().unwrap_or(0)
        ),
    ]
}
