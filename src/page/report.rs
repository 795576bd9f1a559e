//! The reproduction report as one HTML page that stands for itself, with every picture in it.
//!
//! It is a view of a [`Report`], as its Markdown is. Links lead within the page; files beside the report are named without
//! a link, since the page may be anywhere. What `_` or `^` sets low or high in a formula, or after a single letter, is set so.

use super::parts::{section, shell, wide};
use crate::claim::Verdict;
use crate::report::{Block, Part, Report, Span, Target};
use base64::Engine;
use base64::prelude::BASE64_STANDARD;
use maud::{Markup, PreEscaped, html};
use std::collections::BTreeMap;

const STYLE: &str = concat!(include_str!("page.css"), include_str!("report.css"));

/// The page of a report, with the picture of each experiment, an SVG, by its name.
pub fn html(report: &Report, pictures: &BTreeMap<String, String>) -> String {
    let parts = report.claims.iter().chain(&report.experiments);
    let body = html! {
        div.report {
            (contents(report))
            main {
                header {
                    p.kind { "liftsim" }
                    h1 { (report.title) }
                    @for block in &report.opening { (self::block(block, &report.title, pictures)) }
                }
                @for part in parts.chain(&report.equations) {
                    (section(&part.id, words(&part.title), html! {
                        @for block in &part.blocks { (self::block(block, &part.title, pictures)) }
                    }))
                }
            }
        }
    };
    shell(&report.title, "light dark", STYLE, body)
}

fn contents(report: &Report) -> Markup {
    let entries = |parts: &mut dyn Iterator<Item = &Part>| {
        html! { ul { @for part in parts { li { a href={ "#" (part.id) } { (words(&part.title)) } } } } }
    };
    html! {
        nav aria-label="Contents" tabindex="0" {
            p.kind { "Contents" }
            (entries(&mut report.claims.iter().chain(&report.equations)))
            p.kind { "Experiments" }
            (entries(&mut report.experiments.iter()))
        }
    }
}

fn block(block: &Block, title: &str, pictures: &BTreeMap<String, String>) -> Markup {
    match block {
        Block::Paragraph(spans) => html! { p { (text(spans)) } },
        Block::Table { head, rows } => {
            let table = html! {
                table class={ "columns-" (head.len()) } {
                    thead { tr { @for name in head { th scope="col" { (name) } } } }
                    tbody { @for row in rows { tr { @for cell in row { td { (text(cell)) } } } } }
                }
            };
            wide(title, table)
        }
        Block::Picture {
            name,
            alternative,
            caption,
        } => html! {
            figure {
                @if let Some(svg) = pictures.get(name) { (wide(title, picture(svg, alternative))) }
                figcaption { (text(caption)) }
            }
        },
    }
}

/// A picture that takes up its place before it is drawn.
fn picture(svg: &str, alternative: &str) -> Markup {
    let data = format!("data:image/svg+xml;base64,{}", BASE64_STANDARD.encode(svg));
    let [width, height] = ["width", "height"].map(|side| points(svg, side));
    html! { img src=(data) alt=(alternative) width=[width] height=[height]; }
}

/// A side of a picture whose sides are in points, in pixels of CSS.
fn points(svg: &str, side: &str) -> Option<u32> {
    let (_, rest) = svg.split_once(&format!(" {side}=\""))?;
    let points: f64 = rest.split_once("pt\"")?.0.parse().ok()?;
    Some((points * 96.0 / 72.0).round() as u32)
}

fn text(spans: &[Span]) -> Markup {
    html! { @for span in spans { (self::span(span)) } }
}

fn span(span: &Span) -> Markup {
    match span {
        Span::Plain(plain) => words(plain),
        // A long name breaks after an underscore.
        Span::Code(code) => {
            html! { code { @for part in code.split_inclusive('_') { (part) wbr; } } }
        }
        Span::Formula(formula) => html! { span.formula { (PreEscaped(set(formula, true))) } },
        Span::Emphasis(spans) => html! { em { (text(spans)) } },
        Span::Strong(spans) => html! { strong { (text(spans)) } },
        Span::Link(Target::Here(place), spans) => {
            html! { a href={ "#" (place) } { (text(spans)) } }
        }
        Span::Link(Target::Elsewhere(_), spans) => html! { span.file { (text(spans)) } },
        Span::Anchor(id) => html! { a id=(id) {} },
        Span::Verdict(verdict) => self::verdict(verdict),
    }
}

fn verdict(verdict: &Verdict) -> Markup {
    let (tone, mark) = match verdict {
        Verdict::Holds => ("good", "✓"),
        Verdict::HoldsWhere(_) => ("doubt", "◐"),
        Verdict::DoesNotHold => ("bad", "✗"),
        Verdict::Undecided => ("doubt", "?"),
    };
    html! {
        strong.verdict.(tone) { (mark) " " (verdict.name()) }
        @if let Verdict::HoldsWhere(places) = verdict { " " (words(places)) }
    }
}

fn words(words: &str) -> Markup {
    PreEscaped(set(words, false))
}

/// HTML of words, or of a formula, with what is set low or high. Among words the letter before a `_` must stand alone, for names of
/// files and keys have underscores, too.
fn set(words: &str, is_formula: bool) -> String {
    let escaped = |text: &str| html! { (text) }.into_string();
    let mut set = String::new();
    let mut rest = words;
    while let Some(at) = rest.find(['_', '^']) {
        let (before, mark) = (&rest[..at], &rest[at..=at]);
        let whole = &words[..words.len() - rest.len() + at];
        set += &escaped(before);
        rest = &rest[at + 1..];
        match script(rest).filter(|_| is_formula || is_single(whole)) {
            Some((script, after)) => {
                let tag = if mark == "_" { "sub" } else { "sup" };
                set += &format!("<{tag}>{}</{tag}>", escaped(script));
                rest = after;
            }
            None => set += mark,
        }
    }
    set + &escaped(rest)
}

/// What is set low or high at the beginning of a text, without its parentheses, and what follows.
fn script(text: &str) -> Option<(&str, &str)> {
    if let Some(rest) = text.strip_prefix('(') {
        return rest.split_once(')');
    }
    let end = text.find(|it: char| !it.is_alphanumeric());
    let (script, rest) = text.split_at(end.unwrap_or(text.len()));
    (!script.is_empty()).then_some((script, rest))
}

/// Whether a text ends with a letter that no letter, digit or underscore precedes, or with a parenthesis.
fn is_single(text: &str) -> bool {
    let mut back = text.chars().rev();
    let (last, before) = (back.next(), back.next());
    let is_word = |it: char| it.is_alphanumeric() || it == '_';
    last == Some(')') || last.is_some_and(char::is_alphabetic) && !before.is_some_and(is_word)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn letters_are_set_low_and_high() {
        for (words, expected) in [
            ("Δ/σ_ξ = 1", "Δ/σ<sub>ξ</sub> = 1"),
            (
                "λ_i − Σ a_p λ_(i−p)",
                "λ<sub>i</sub> − Σ a<sub>p</sub> λ<sub>i−p</sub>",
            ),
            ("(1 − 2ν)^i)/2", "(1 − 2ν)<sup>i</sup>)/2"),
            ("at_rest, a__b, _x, x_", "at_rest, a__b, _x, x_"),
            ("a < b_1", "a &lt; b<sub>1</sub>"),
        ] {
            assert_eq!(set(words, false), expected);
        }
        assert_eq!(set("|MA_(j−1)|", true), "|MA<sub>j−1</sub>|");
    }
}
