//! The part of a report that prints the equations that it cites.

use super::document::{Block, Part, Span, Text, plain};
use super::published::{Cited, EQUATIONS, Equation, Paper};
use super::words::{cite, spans};

/// The part with the equations that are cited, and with those that these cite; none where none is.
pub(super) fn part(mut cited: Cited) -> Option<Part> {
    let mut known = 0;
    while cited.len() > known {
        known = cited.len();
        for equation in &EQUATIONS {
            if equation.is_in(&cited) {
                row(equation, &mut cited);
            }
        }
    }
    let mut blocks = Vec::new();
    for paper in [Paper::Raifeld, Paper::Yang] {
        let of_paper = EQUATIONS
            .iter()
            .filter(|it| it.paper == paper && it.is_in(&cited));
        let rows: Vec<Vec<Text>> = of_paper.map(|it| row(it, &mut Cited::new())).collect();
        if !rows.is_empty() {
            let head = vec![
                "equation",
                "as it is printed",
                "what it is, and what it should be",
            ];
            blocks.push(Block::Paragraph(plain(paper.heading())));
            blocks.push(Block::Table { head, rows });
        }
    }
    (!blocks.is_empty()).then(|| Part {
        id: "equations".to_owned(),
        title: "Equations".to_owned(),
        blocks,
    })
}

fn row(equation: &Equation, cited: &mut Cited) -> Vec<Text> {
    let place = Span::Anchor(equation.paper.place(equation.number));
    let number = Span::Plain(format!("({})", equation.number));
    let lost = || Span::Emphasis(plain("lost in the text at hand"));
    let formula = |formula: &str| Span::Formula(formula.to_owned());
    let remark = cite(spans(equation.remark), equation.paper, cited);
    let remark = remark.into_iter().map(|span| match span {
        Span::Code(formula) => Span::Formula(formula),
        other => other,
    });
    vec![
        vec![place, number],
        vec![equation.printed.map_or_else(lost, formula)],
        remark.collect(),
    ]
}
