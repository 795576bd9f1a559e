use super::*;
use proptest::prelude::*;

fn options(keys: &str) -> Options {
    toml::from_str(keys).unwrap_or_else(|error| panic!("{error}"))
}

/// Rates 0, .25, .5 and 1 at 0, 1, 2 and 3, each ± .1 within [0, 1].
fn rates() -> Plot {
    curve_of(&[0.0, 0.25, 0.5, 1.0])
}

/// The same of other rates.
fn curve_of(rates: &[f64]) -> Plot {
    let points = (0..).map(f64::from).zip(rates).map(|(x, &y)| {
        let [low, high] = [y - 0.1, y + 0.1].map(|end: f64| end.clamp(0.0, 1.0));
        Point::new(x, [low, y, high])
    });
    let x = Axis::linear(0.0, rates.len() as f64 - 1.0, 5).labelled("x");
    let y = Axis::linear(0.0, 1.0, 5).labelled("y");
    let mut plot = Plot::stack(&x, [(200.0, y)]);
    let style = Style::of(0);
    add_bands(
        &mut plot,
        0,
        &[Curve {
            style,
            points: points.collect(),
        }],
    );
    plot.add(0, Mark::Axes);
    plot.add_legend([Entry::new("a curve", style, Key::MarkedLine)], Place::Free);
    plot.set_caption(&["a caption".to_owned()]);
    plot
}

fn changed(keys: &str) -> (Plot, Vec<String>) {
    let changed = options(keys).apply(rates(), None);
    changed.unwrap_or_else(|error| panic!("{error}"))
}

fn refused(keys: &str) -> String {
    options(keys).apply(rates(), None).unwrap_err().to_string()
}

fn markers(plot: &Plot) -> Vec<Point> {
    let of = |mark: &Mark| match mark {
        Mark::Markers(points, _) => Some(points.clone()),
        _ => None,
    };
    plot.marks_of(0).find_map(of).unwrap()
}

#[test]
fn without_options_nothing_changes() {
    assert_eq!(changed("").0, rates());
}

/// The logarithm of .25 is where it is; 0 has none, and an arrow at the end of its interval stands for it.
#[test]
fn a_logarithmic_scale() {
    let (plot, _) = changed("y_scale = 'log'");
    let points = markers(&plot);
    assert!((points[1].y - 0.25f64.log10()).abs() < 1e-12);
    assert_eq!((points[0].limit, points[0].y), (Some(Limit::Upper), -1.0));
    assert_eq!((points[3].limit, points[3].y), (None, 0.0));
    let y = &plot.panels[0].y;
    assert_eq!((y.scale, &y.label[..]), (Some(Scale::Log), "y"));
    assert!(y.from < -1.0 && y.to > 0.0);
    for (place, label) in &y.ticks {
        assert!(
            (label.parse::<f64>().unwrap().log10() - place).abs() < 1e-9,
            "{label}"
        );
    }
}

/// Neither 0 nor 1 has a place.
#[test]
fn a_probit_scale() {
    let (plot, _) = changed("y_scale = 'probit'");
    let points = markers(&plot);
    assert_eq!(points[2].y, 0.0);
    assert!((points[1].y + 0.6744897501960817).abs() < 1e-9);
    let limits = [points[0].limit, points[3].limit];
    assert_eq!(limits, [Some(Limit::Upper), Some(Limit::Lower)]);
    assert!((points[3].y - 1.2815515655446004).abs() < 1e-9, "of .9");
    let labels: Vec<&str> = plot.panels[0]
        .y
        .ticks
        .iter()
        .map(|(_, label)| &label[..])
        .collect();
    assert_eq!(labels, ["0.1", "0.2", "0.5", "0.8", "0.9"]);
}

#[test]
fn ranges_cut_and_say_so() {
    let (plot, notes) = changed("x_range = [0.5, 2.5]\ny_range = [0.0, 0.4]");
    assert_eq!(notes, ["3 points lie outside the ranges of the axes"]);
    assert_eq!(plot.caption[1], notes);
    assert_eq!(markers(&plot).len(), 1);
    let lines = plot.marks_of(0).filter_map(|mark| match mark {
        Mark::Line(points, _) => Some(points.clone()),
        _ => None,
    });
    let lines: Vec<_> = lines.collect();
    assert_eq!(lines, [[(0.5, 0.125), (1.0, 0.25), (1.6, 0.4)]]);
}

#[test]
fn what_does_not_fit_is_refused() {
    assert_eq!(
        refused("y_scale = 'log'\ny_range = [0.0, 1.0]"),
        "figure.y_range: must be positive on a logarithmic axis, got [0.0, 1.0]"
    );
    assert_eq!(
        refused("x_range = [2.0, 1.0]"),
        "figure.x_range: must be two numbers, the smaller first, got [2.0, 1.0]"
    );
    let mut several = rates();
    several.panels = vec![several.panels[0].clone(); 4];
    let error = options("height = 60")
        .apply(several.clone(), None)
        .unwrap_err();
    assert_eq!(
        error.to_string(),
        "figure.height: must be at least 109 mm for these panels, got 60"
    );
    assert!(options("height = 109").apply(several, None).is_ok());
    let mut named = rates();
    named.panels[0].y = Axis::names(vec!["a".to_owned()]);
    let error = options("y_scale = 'log'").apply(named, None).unwrap_err();
    assert!(error.to_string().contains("has names along y"), "{error}");
}

#[test]
fn a_sheet_of_this_size() {
    for (width, height) in [(88.0, 70.0), (139.7, 60.0), (140.0, 60.0), (180.0, 300.0)] {
        let (plot, _) = changed(&format!("width = {width}\nheight = {height}"));
        let (w, h) = layout(&plot).unwrap().size;
        let mm = |points: f64| points * 25.4 / 72.0;
        assert!(
            (mm(w) - width).abs() < 0.01 && (mm(h) - height).abs() < 0.1,
            "{w} {h}"
        );
    }
}

#[test]
fn parts_are_left_out() {
    let (plot, _) = changed("legend = 'none'\ncaption = false\nmarkers = false");
    assert!(plot.legend.is_none() && plot.caption.is_empty());
    assert!(markers(&plot).is_empty());
    let (plot, _) = changed("legend = 'lower-right'\ncolours = ['black']");
    let place = Place::Corner {
        is_right: true,
        is_low: true,
    };
    let legend = plot.legend.unwrap();
    assert_eq!(legend.place, place);
    assert_eq!(legend.entries[0].style.colour, Colour::BLACK);
}

#[test]
fn curves_of_ones_own() {
    let overlay = |text: &str| Overlay::parse(text);
    let own = overlay("x,y,name\n0, .5, theory\n3, .5, theory\n").unwrap();
    let (plot, _) = Options::default().apply(rates(), Some(&own)).unwrap();
    assert_eq!(plot.legend.unwrap().entries[1].text, "theory");
    let line = plot.marks.iter().rev().find_map(|(_, mark)| match mark {
        Mark::Line(points, _) => Some(points.clone()),
        _ => None,
    });
    assert_eq!(line, Some(vec![(0.0, 0.5), (3.0, 0.5)]));
    let own = overlay("x,y,panel\n0,0,2\n").unwrap();
    let error = Options::default().apply(rates(), Some(&own)).unwrap_err();
    assert_eq!(
        error.to_string(),
        "figure.overlay: line 2: panel must be 1 to 1, got 2"
    );
    let own = overlay("x,y\n0,0.5\n1,0\n").unwrap();
    let error = options("y_scale = 'log'")
        .apply(rates(), Some(&own))
        .unwrap_err();
    assert_eq!(
        error.to_string(),
        "figure.overlay: line 3: y must be positive on a logarithmic axis, got 0"
    );
    for text in ["", "x,y,name\n", "x,z\n1,2\n", "x,y\n1,a\n", "x,y\n1\n"] {
        assert!(overlay(text).is_err(), "{text:?}");
    }
}

/// Where a curve of one's own leaves the axes it is cut where it does, not bent along their edge.
#[test]
fn curves_of_ones_own_end_at_the_axes() {
    let own = Overlay::parse("x,y\n0,0\n10,2\n").unwrap();
    let (plot, notes) = Options::default().apply(rates(), Some(&own)).unwrap();
    assert_eq!(notes, ["points of the overlay outside the axes: 1"]);
    let Some((_, Mark::Line(points, _))) = plot.marks.last() else {
        panic!("a line");
    };
    assert_eq!((points[0], points[1].0), ((0.0, 0.0), 3.0));
    assert!((points[1].1 - 0.6).abs() < 1e-12, "{points:?}");
}

/// However narrow, an axis says where it is.
#[test]
fn narrow_scales_have_ticks() {
    for (scale, from, to) in [("log", 0.55, 0.9), ("probit", 0.55, 0.75)] {
        let (plot, _) = changed(&format!("y_scale = '{scale}'\ny_range = [{from}, {to}]"));
        let y = &plot.panels[0].y;
        assert!(y.ticks.len() >= 3, "{y:?}");
        for (place, label) in &y.ticks {
            let value = y.scale.unwrap().value(*place);
            assert!(
                (label.parse::<f64>().unwrap() - value).abs() < 1e-9,
                "{label}"
            );
        }
    }
}

#[test]
fn signs_that_the_font_lacks_are_named() {
    let mut plot = rates();
    plot.panels[0].title = "電梯 α_ξ".to_owned();
    let (_, notes) = Options::default().apply(plot, None).unwrap();
    assert_eq!(
        notes,
        ["the font has no sign for 梯 (U+68AF), 電 (U+96FB): boxes stand for them"]
    );
}

#[test]
fn a_curve_under_another_is_wider() {
    let curve = |index: usize, y: f64| Curve {
        style: Style::of(index),
        points: (0..5).map(|x| Point::at((f64::from(x), y))).collect(),
    };
    let mut plot = Plot::stack(
        &Axis::linear(0.0, 4.0, 5),
        [(100.0, Axis::linear(0.0, 1.0, 5))],
    );
    add_bands(
        &mut plot,
        0,
        &[curve(0, 0.5), curve(1, 0.501), curve(2, 0.9)],
    );
    let widths = plot.marks.iter().filter_map(|(_, mark)| match mark {
        Mark::Line(_, style) => Some(style.width),
        _ => None,
    });
    let widths: Vec<f64> = widths.collect();
    assert!(
        widths[0] > widths[1] && widths[1] == widths[2],
        "{widths:?}"
    );
}

fn at(points: &[(f64, f64)], x: f64) -> Option<f64> {
    let pair = points
        .windows(2)
        .find(|it| (it[0].0..=it[1].0).contains(&x))?;
    let share = (x - pair[0].0) / (pair[1].0 - pair[0].0);
    Some(pair[0].1 + share * (pair[1].1 - pair[0].1))
}

/// A point between limits is on no line, so that its marker stays; its interval is a bar, within the panel alone.
#[test]
fn a_lone_point_is_seen() {
    let of = |keys: &str| {
        let rates = curve_of(&[0.0, 0.25, 0.0, 0.25, 0.5]);
        options(keys).apply(rates, None).unwrap().0
    };
    let places = |plot: &Plot| markers(plot).iter().map(|it| it.x).collect::<Vec<_>>();
    let bands = |plot: &Plot| {
        let lengths = plot.marks_of(0).filter_map(|mark| match mark {
            Mark::Band(points, _) => Some(points.len()),
            _ => None,
        });
        lengths.collect::<Vec<_>>()
    };
    let plot = of("y_scale = 'log'\nmarkers = false");
    assert_eq!(places(&plot), [0.0, 1.0, 2.0]);
    assert_eq!(bands(&plot), [1, 2]);
    assert!(plot.caption.concat().concat().contains("arrows: limits"));
    let plot = of("y_scale = 'log'\nx_range = [0.0, 3.0]\ny_range = [0.01, 0.1]");
    assert_eq!(bands(&plot), [0, 0]);
}

proptest! {
    /// Nothing is drawn across an estimate that has no place, and everything between two that have one.
    #[test]
    fn lines_and_bands_have_gaps_at_limits(quarters in prop::collection::vec(0..=4u8, 2..12)) {
        let rates: Vec<f64> = quarters.iter().map(|&it| f64::from(it) / 4.0).collect();
        let scaled = options("y_scale = 'probit'").apply(curve_of(&rates), None);
        let (plot, _) = scaled.unwrap();
        let is_limit = |x: usize| rates[x] == 0.0 || rates[x] == 1.0;
        let joins = |mark: &Mark, x: usize| {
            let at: Vec<f64> = match mark {
                Mark::Line(points, _) => points.iter().map(|it| it.0).collect(),
                Mark::Band(points, _) => points.iter().map(|it| it.x).collect(),
                _ => return false,
            };
            at.windows(2).any(|it| it[0] < x as f64 + 0.5 && it[1] > x as f64 + 0.5)
        };
        for x in 1..rates.len() {
            let found = plot.marks_of(0).filter(|mark| joins(mark, x - 1)).count();
            let expected = if is_limit(x - 1) || is_limit(x) { 0 } else { 2 };
            prop_assert_eq!(found, expected, "at {}", x);
        }
    }

    /// A line that is cut is there exactly where it runs through the panel; a band is what lies in it.
    #[test]
    fn cuts_keep_what_lies_inside(
        values in prop::collection::vec((-1.0..2.0f64, 0.01..0.5f64), 2..12),
        x_from in -0.5..3.0f64, x_wide in 0.3..5.0f64, y_from in -0.5..0.8f64, y_wide in 0.1..1.5f64,
    ) {
        let points: Vec<Point> = (0..).map(f64::from).zip(&values)
            .map(|(x, (y, half))| Point::new(x, [y - half, *y, y + half])).collect();
        let mut plot = Plot::stack(&Axis::linear(0.0, 9.0, 5), [(100.0, Axis::linear(0.0, 1.0, 5))]);
        let style = Style::of(0);
        add_bands(&mut plot, 0, &[Curve { style, points: points.clone() }]);
        let (x, y) = ([x_from, x_from + x_wide], [y_from, y_from + y_wide]);
        plot.show(Some(x), Some(y)).unwrap();
        let (mut lines, mut band) = (Vec::new(), Vec::new());
        for (_, mark) in plot.marks {
            match mark {
                Mark::Line(line, _) => lines.push(line),
                Mark::Band(points, _) => band = points,
                _ => {}
            }
        }
        let edge = |of: fn(&Point) -> f64, points: &[Point]| -> Vec<(f64, f64)> {
            points.iter().map(|point| (point.x, of(point))).collect()
        };
        for step in 0..200 {
            let here = x[0] + (x[1] - x[0]) * (f64::from(step) + 0.5) / 200.0;
            let expected = at(&edge(|it| it.y, &points), here);
            let found = lines.iter().find_map(|line| at(line, here));
            match expected.filter(|value| (y[0]..=y[1]).contains(value)) {
                Some(value) => prop_assert!((found.unwrap() - value).abs() < 1e-9),
                None => {
                    let is_edge = expected.is_some_and(|it| y.iter().any(|end| (it - end).abs() < 1e-9));
                    prop_assert!(found.is_none() || is_edge);
                }
            }
            for of in [|it: &Point| it.low, |it: &Point| it.high] {
                let expected = at(&edge(of, &points), here).map(|it| it.clamp(y[0], y[1]));
                let found = at(&edge(of, &band), here).map(|it| it.clamp(y[0], y[1]));
                if let (Some(expected), Some(found)) = (expected, found) {
                    prop_assert!((expected - found).abs() < 1e-9, "{here}: {expected} {found}");
                }
            }
        }
    }
}

/// A name longer than the sheet is wide stands in several lines, at the usual width too.
#[test]
fn a_long_name_has_several_lines() {
    let mut plot = rates();
    let name = "a name of a curve that says everything there is to say of it and ".repeat(3);
    plot.add_legend(
        [Entry::new(name, Style::of(0), Key::MarkedLine)],
        Place::Free,
    );
    assert!(layout(&plot).is_err());
    let (plot, _) = options("").apply(plot, None).unwrap();
    assert!(layout(&plot).is_ok());
    assert!(plot.legend.unwrap().entries.len() > 1);
}
