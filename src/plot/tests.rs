use super::layout::check_panels;
use super::*;

fn axis(label: &str) -> Axis {
    Axis::linear(0.0, 1.0, 5).labelled(label)
}

/// One panel with these points and a legend of one line.
fn plot_of(points: &[(f64, f64)]) -> Plot {
    let mut plot = Plot::stack(&axis("x"), [(200.0, axis("y"))]);
    let points = points.iter().copied().map(Point::at).collect();
    plot.add(0, Mark::Markers(points, Style::of(0)));
    plot.add(0, Mark::Axes);
    let curves = Entry::of_curves(["a curve".to_owned()], Key::MarkedLine);
    plot.add_legend(curves, Place::Free);
    plot
}

/// The upper left corner of the legend and the upper edge of the panel.
fn places(plot: &Plot) -> ((f64, f64), f64) {
    let (legend, above) = plot.placed_legend();
    (legend.unwrap().corner, plot.margins.top + above)
}

#[test]
fn a_legend_takes_the_first_corner_without_data() {
    let corners = [(0.95, 0.05), (0.05, 0.95), (0.95, 0.95), (0.05, 0.05)];
    let found = (0..=4).map(|taken| places(&plot_of(&corners[..taken])));
    let found: Vec<_> = found.collect();
    let ((right, bottom), top) = found[0];
    assert!(right > 250.0 && bottom > 150.0);
    assert_eq!(found[1].0, (60.0, 16.0), "upper left");
    assert_eq!(found[2].0, (right, 16.0), "upper right");
    assert_eq!(found[3].0, (60.0, bottom), "lower left");
    // Above the panel, which makes room for it.
    assert_eq!(found[4], ((54.0, 4.0), top + 17.5 + 8.0));
}

#[test]
fn bands_and_lines_are_covered_between_their_points() {
    let mut plot = plot_of(&[(0.05, 0.95), (0.95, 0.95), (0.05, 0.05)]);
    let across = vec![(0.0, 0.0), (1.0, 0.1)];
    plot.marks.insert(0, (0, Mark::Line(across, Style::of(1))));
    assert_eq!(places(&plot).0, (54.0, 4.0));
}

#[test]
fn a_text_over_the_edge_is_refused() {
    let mut plot = plot_of(&[]);
    plot.panels[0].x.label = "a label ".repeat(12);
    let Err(LayoutError::Clipped(text)) = layout(&plot) else {
        panic!("the label is wider than the sheet");
    };
    assert!(text.starts_with("a label a label"));
    plot.panels[0].x.label = "a label".to_owned();
    plot.legend.as_mut().unwrap().entries[0].text = "a".repeat(1_000_000);
    let message = layout(&plot).unwrap_err().to_string();
    assert!(message.len() < 200, "{message}");
}

#[test]
fn a_caption_breaks_where_it_must() {
    let mut plot = plot_of(&[]);
    plot.set_caption(&["one".to_owned(), "two".to_owned(), "three and ".repeat(20)]);
    let lines = plot.caption_lines();
    assert!(lines.len() > 2);
    assert!(lines[0].starts_with("one; two; three and three"));
    assert!(layout(&plot).is_ok());
}

/// On a narrow sheet all words are there, as large as before, in more lines.
#[test]
fn a_narrow_sheet_keeps_its_words() {
    let mut plot = plot_of(&[]);
    plot.panels[0].x.label =
        "many words that need the width of a page of paper to stand side by side".to_owned();
    plot.panels[0].title = "a title of its own that is a little longer than a column".to_owned();
    plot.set_caption(&[
        "a caption of several parts".to_owned(),
        "each of some length".to_owned(),
    ]);
    plot.margins.top = 20.0;
    let text = "a name of a curve that says all there is to say".to_owned();
    plot.add_legend([Entry::new(text, Style::of(0), Key::Line)], Place::Free);
    let words = |plot: &Plot| {
        let canvas = layout(plot).unwrap();
        let texts = canvas.shapes.iter().filter_map(|shape| match shape {
            Shape::Text(text) => Some((text.text.clone(), text.height)),
            _ => None,
        });
        let all: Vec<_> = texts.collect();
        let words = all
            .iter()
            .flat_map(|(text, _)| text.split([' ', ';']).map(str::to_owned));
        let mut words: Vec<String> = words.filter(|word| !word.is_empty()).collect();
        words.sort();
        let smallest = all
            .iter()
            .map(|(_, height)| *height)
            .fold(f64::INFINITY, f64::min);
        (words, smallest, canvas.size)
    };
    let (wide, narrow) = (
        words(&plot),
        words(&plot.clone().resized(88.0 * 72.0 / 25.4)),
    );
    assert_eq!((&wide.0, wide.1), (&narrow.0, narrow.1));
    assert!(narrow.2.0 < 250.0 && narrow.2.1 > wide.2.1);
}

#[test]
fn as_many_panels_as_can_be_drawn() {
    let grid = |count: usize| {
        let panel = || Panel::new(114.0, axis("x"), axis("y"));
        let mut plot = Plot::of((0..count).map(|_| panel()).collect(), 2);
        plot.caption = vec![vec![String::new()]; 8];
        layout(&plot)
    };
    assert_eq!(check_panels(26), Ok(()));
    assert!(grid(26).is_ok());
    let refused = LayoutError::Panels {
        panels: 300,
        most: 26,
    };
    assert_eq!(check_panels(300), Err(refused.clone()));
    assert_eq!(grid(300), Err(refused));
    let mut plot = plot_of(&[]);
    plot.panels[0].height = 3000.0;
    assert!(matches!(layout(&plot), Err(LayoutError::Height(_))));
}

#[test]
fn nothing_is_drawn_outside_its_panel() {
    let mut plot = plot_of(&[]);
    plot.marks.clear();
    let line = vec![(-1.0, f64::NEG_INFINITY), (0.5, 0.5), (2.0, 7.0)];
    plot.add(0, Mark::Line(line, Style::of(0)));
    let expected = vec![(54.0, 210.0), (217.0, 110.0), (380.0, 10.0)];
    let canvas = layout(&plot).unwrap();
    assert_eq!(
        canvas.shapes[1],
        Shape::Line(expected, 1.1, Style::of(0).colour)
    );
}

/// Ticks keep their words where there is room, whichever way they run; names along x stand on up to three lines for it.
#[test]
fn ticks_that_have_room_are_drawn() {
    let drawn = |x: Axis, y: Axis| {
        let mut plot = Plot::stack(&x, [(100.0, y)]);
        plot.add(0, Mark::Axes);
        let canvas = layout(&plot).unwrap();
        let texts = canvas.shapes.into_iter().filter_map(|shape| match shape {
            Shape::Text(text) => Some(text.text),
            _ => None,
        });
        texts.collect::<Vec<_>>()
    };
    let texts = drawn(axis("x"), Axis::powers_of_ten(-4.5, 0.5, 6));
    for label in ["10⁰", "10⁻¹", "10⁻²", "10⁻³", "10⁻⁴"] {
        assert!(
            texts.iter().any(|text| text == label),
            "{label} in {texts:?}"
        );
    }
    let names = |count| Axis::names((0..count).map(|name| format!("name {name}")).collect());
    let count = |texts: &[String]| texts.iter().filter(|it| it.starts_with("name")).count();
    let texts = drawn(axis("x"), names(30));
    assert!((8..=11).contains(&count(&texts)), "{texts:?}");
    for along in [2, 8, 14, 20] {
        let texts = drawn(names(along), axis("y"));
        assert_eq!(count(&texts), along as usize, "{texts:?}");
    }
    let texts = drawn(names(60), axis("y"));
    assert!((10..=30).contains(&count(&texts)), "{texts:?}");
}
