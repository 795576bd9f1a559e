//! The plane of W and T: the null probability of every cell on a logarithmic scale, and the boundary
//! C_W(T) of each region as a line of its own colour, dash and width.

use super::row::Row;
use crate::detect::{Alternative, NullLaws, Samples};
use crate::plot::{Axis, Cell, Colour, Entry, Key, Mark, Place, Plot, Style, power_of_ten};

const HEIGHT: f64 = 238.0;
/// Cells less probable than this are as pale as it.
const FAINTEST: f64 = 1e-12;
/// Columns of the picture; a wide law is drawn by the largest probability in each.
const COLUMNS: u64 = 160;
/// The width of the last line; those before are wider, so that lines that coincide are all seen.
const LINE: f64 = 1.2;
/// Dark colours first: lines lie on blue.
const STYLES: [usize; 6] = [1, 2, 3, 4, 0, 5];

/// The picture of one or more regions; `title` is in parts, between which a line may break.
pub fn plot(laws: &NullLaws, rows: &[Row], title: &[String]) -> Plot {
    let regions: Vec<&[Row]> = rows.chunk_by(|a, b| a.rule == b.rule).collect();
    let (low, high) = visible(laws);
    let x = Axis::linear(low as f64 - 0.5, high as f64 + 0.5, 7).labelled("W, rank sum of Y_1");
    let top = laws.exceedances().last() as f64 + 0.5;
    let y = Axis::linear(-0.5, top, 8).labelled(format!(
        "{}, exceedances of {}",
        laws.of().symbol(),
        laws.of().samples()
    ));
    let mut plot = Plot::stack(&x, [(HEIGHT, y)]);
    (plot.margins.left, plot.margins.right, plot.margins.top) = (48.0, 76.0, 4.0);
    plot.add(0, Mark::Cells(cells(laws)));
    let exponents = (2..=12).step_by(2);
    let shades = exponents.map(|e| (shade(libm::pow(10.0, -f64::from(e))), power_of_ten(-e)));
    let shown = format!("P(W, {} | H_0)", laws.of().symbol());
    plot.add(0, Mark::Shades(shown, shades.collect()));
    let style = |index: usize| Style::of(STYLES[index % STYLES.len()]);
    for (index, rows) in regions.iter().enumerate() {
        let width = LINE + 0.5 * (regions.len() - 1 - index) as f64;
        for line in boundaries(rows, x.from, x.to) {
            plot.add(0, Mark::Line(line, style(index).wide(width)));
        }
    }
    plot.add(0, Mark::Axes);
    let entries = regions.iter().enumerate().map(|(index, rows)| {
        let rule = rows[0].rule.split('(').next().unwrap_or_default();
        let text = format!("{rule}, exact size {:.6}", rows[0].size);
        Entry::new(text, style(index), Key::Line)
    });
    plot.add_legend(entries, Place::Above);
    plot.set_caption(title);
    plot
}

/// What the regions share, and where they lie, in the parts of a caption.
pub fn title(samples: &Samples, alternative: Alternative, alpha: f64) -> Vec<String> {
    let side = match alternative {
        Alternative::Greater => "to the right of its line, and above it where it runs level",
        Alternative::Less => "to the left of its line, and above it where it runs level",
        Alternative::TwoSided => "outside its lines, and above them where they run level",
    };
    vec![
        format!("N = {}", samples.reference()),
        format!("M_1 = {}", samples.shift()),
        format!("M_2 = {}", samples.scale()),
        format!("alternative {alternative}"),
        format!("α = {alpha}"),
        format!("a rule decides H_1*, for motion, {side}"),
    ]
}

/// The rank sums worth showing: between them lies all but a 1e-12th of either tail.
fn visible(laws: &NullLaws) -> (u64, u64) {
    let law = laws.rank_sum();
    let high = law.critical(FAINTEST).min(law.last());
    (law.first() + law.last() - high, high)
}

fn cells(laws: &NullLaws) -> Vec<Cell> {
    let (low, high) = visible(laws);
    let width = (high - low + 1).div_ceil(COLUMNS);
    let columns = (low..=high).step_by(width as usize);
    let columns = columns.map(|from| (from, (from + width - 1).min(high)));
    columns
        .flat_map(|(from, to)| {
            (0..=laws.exceedances().last()).map(move |t| {
                let largest = (from..=to)
                    .map(|w| laws.cell(w, t as usize))
                    .fold(0.0, f64::max);
                let (left, right, t) = (from as f64 - 0.5, to as f64 + 0.5, t as f64);
                ((left, t + 0.5), (right, t - 0.5), shade(largest))
            })
        })
        .collect()
}

/// The lines around a region: for large W, and for small W where there are such. A part that lies outside
/// `from` to `to` is left out.
fn boundaries(rows: &[Row], from: f64, to: f64) -> Vec<Vec<(f64, f64)>> {
    let upper = |row: &Row| row.upper.map_or(f64::INFINITY, |w| w as f64 - 0.5);
    let lower = |row: &Row| row.lower.map_or(f64::NEG_INFINITY, |w| w as f64 + 0.5);
    let mut lines = steps(rows, from, to, upper);
    lines.extend(steps(rows, from, to, lower));
    lines
}

fn steps(rows: &[Row], from: f64, to: f64, at: impl Fn(&Row) -> f64) -> Vec<Vec<(f64, f64)>> {
    let corners = rows.iter().flat_map(|row| {
        let (w, t) = (at(row).clamp(from, to), row.exceedances as f64);
        [(w, t - 0.5), (w, t + 0.5)]
    });
    let corners: Vec<(f64, f64)> = corners.collect();
    let is_on_edge = |w: f64| w <= from || w >= to;
    let mut lines: Vec<Vec<(f64, f64)>> = vec![Vec::new()];
    for (index, pair) in corners.windows(2).enumerate() {
        let is_upright = index % 2 == 0;
        if is_upright && (is_on_edge(pair[0].0) || decides_always(&rows[index / 2])) {
            lines.push(Vec::new());
            continue;
        }
        let last = lines.last_mut().expect("there is a line");
        if last.is_empty() {
            last.push(pair[0]);
        }
        last.push(pair[1]);
    }
    lines.retain(|line| line.len() > 1);
    lines
}

/// Whether small W and large W meet.
fn decides_always(row: &Row) -> bool {
    matches!((row.lower, row.upper), (Some(lower), Some(upper)) if upper <= lower + 1)
}

/// Darker where likelier.
fn shade(probability: f64) -> Colour {
    let depth =
        (1.0 - libm::log10(probability.max(FAINTEST)) / libm::log10(FAINTEST)).clamp(0.0, 1.0);
    let mix = |channel: f64| (255.0 + (channel - 255.0) * (0.04 + 0.8 * depth)) as u8;
    Colour::new(mix(60.0), mix(90.0), mix(130.0))
}
