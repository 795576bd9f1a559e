//! The words of a config as a line of text: `` `code` ``, `*emphasis*`, `**strong**`, `[a link](#place)`, and the equations
//! that they cite.
//!
//! An equation is cited by its number in parentheses, (9), which must not follow a letter or digit directly, as in AR(2); or
//! without parentheses after eq. or eqs: eqs 10, 11 and 15. (20)–(22) cites those between as well. A number that is
//! no equation of the paper in question remains a number.

use super::document::{Span, Target, Text};
use super::published::{Cited, Paper};

/// A text with its marks; marks without an end are letters.
pub(super) fn spans(text: &str) -> Text {
    let mut spans = Text::new();
    let mut plain = String::new();
    let mut rest = text;
    while let Some(letter) = rest.chars().next() {
        if let Some((span, after)) = marked(rest) {
            push(&mut spans, &mut plain);
            spans.push(span);
            rest = after;
        } else {
            plain.push(letter);
            rest = &rest[letter.len_utf8()..];
        }
    }
    push(&mut spans, &mut plain);
    spans
}

fn push(spans: &mut Text, plain: &mut String) {
    if !plain.is_empty() {
        spans.push(Span::Plain(std::mem::take(plain)));
    }
}

/// The marked span that a text begins with, and what follows it.
fn marked(text: &str) -> Option<(Span, &str)> {
    if let Some(rest) = text.strip_prefix('`') {
        let (code, rest) = rest.split_once('`')?;
        return Some((Span::Code(code.to_owned()), rest));
    }
    if let Some((words, rest)) = between(text, "**") {
        return Some((Span::Strong(spans(words)), rest));
    }
    if let Some((words, rest)) = between(text, "*") {
        return Some((Span::Emphasis(spans(words)), rest));
    }
    let (words, rest) = text.strip_prefix('[')?.split_once("](")?;
    let (target, rest) = rest.split_once(')')?;
    if words.contains(['[', ']']) || target.contains(char::is_whitespace) {
        return None;
    }
    let target = match target.strip_prefix('#') {
        Some(place) => Target::Here(place.to_owned()),
        None => Target::Elsewhere(target.to_owned()),
    };
    Some((Span::Link(target, spans(words)), rest))
}

/// The words between two marks, which touch them, and what follows.
fn between<'a>(text: &'a str, mark: &str) -> Option<(&'a str, &'a str)> {
    let (words, rest) = text.strip_prefix(mark)?.split_once(mark)?;
    let touches = |it: Option<char>| it.is_some_and(|it| !it.is_whitespace() && it != '*');
    let is_marked = touches(words.chars().next()) && touches(words.chars().next_back());
    is_marked.then_some((words, rest))
}

/// The same text with a link to each equation that it cites, which is noted; words that already lead elsewhere cite without
/// a link.
pub(super) fn cite(text: Text, paper: Paper, cited: &mut Cited) -> Text {
    let mut linked = Text::new();
    for span in text {
        match span {
            Span::Plain(words) => link(&words, paper, cited, &mut linked),
            Span::Emphasis(words) => linked.push(Span::Emphasis(cite(words, paper, cited))),
            Span::Strong(words) => linked.push(Span::Strong(cite(words, paper, cited))),
            Span::Link(target, words) => {
                cite(words.clone(), paper, cited);
                linked.push(Span::Link(target, words));
            }
            other => linked.push(other),
        }
    }
    linked
}

fn link(words: &str, paper: Paper, cited: &mut Cited, spans: &mut Text) {
    let mut plain = String::new();
    let mut rest = words;
    let mut last = None;
    while let Some(letter) = rest.chars().next() {
        let number = number(&words[..words.len() - rest.len()], rest);
        let Some((number, label)) = number.filter(|(number, _)| paper.has(*number)) else {
            plain.push(letter);
            rest = &rest[letter.len_utf8()..];
            continue;
        };
        let first = last.filter(|_| plain == "–").unwrap_or(number);
        cited.extend((first..=number).map(|number| (paper, number)));
        push(spans, &mut plain);
        let place = Target::Here(paper.place(number));
        spans.push(Span::Link(place, vec![Span::Plain(label.to_owned())]));
        last = Some(number);
        rest = &rest[label.len()..];
    }
    push(spans, &mut plain);
}

/// The number that `rest` begins with, as it is written, if it cites an equation after the words before it.
fn number<'a>(before: &str, rest: &'a str) -> Option<(u8, &'a str)> {
    if let Some(inner) = rest.strip_prefix('(') {
        let (digits, _) = inner.split_once(')')?;
        let is_apart = !before.ends_with(char::is_alphanumeric);
        let number = digits
            .parse()
            .ok()
            .filter(|_| is_apart && is_digits(digits));
        return Some((number?, &rest[..digits.len() + 2]));
    }
    let digits = rest.split(|it: char| !it.is_ascii_digit()).next()?;
    // `eqs 10, 11 and ` ends like `eqs ` once its numbers are taken away.
    let is_listed = |it: char| it.is_ascii_digit() || it == ',' || it == ' ';
    let before = before.replace(" and ", ", ");
    let word = before.trim_end_matches(is_listed);
    let is_first = before.len() > word.len() && !before.ends_with(|it: char| it.is_ascii_digit());
    let is_cited = word.ends_with("eq.") || word.ends_with("eqs");
    let number = digits.parse().ok()?;
    (is_cited && is_first).then_some((number, digits))
}

fn is_digits(text: &str) -> bool {
    text.chars().all(|it| it.is_ascii_digit())
}

#[cfg(test)]
mod tests {
    use super::super::markdown;
    use super::*;
    use proptest::prelude::*;

    /// The text as Markdown, and the numbers cited.
    fn linked(text: &str) -> (String, Vec<u8>) {
        let mut cited = Cited::new();
        let text = cite(spans(text), Paper::Raifeld, &mut cited);
        let numbers = cited.into_iter().map(|(_, number)| number).collect();
        (markdown::text(&text), numbers)
    }

    #[test]
    fn equations_are_linked() {
        for (text, expected, numbers) in [
            ("(5) is exact", "[(5)](#eq-5) is exact", &[5][..]),
            (
                "eqs (1) and (2)",
                "eqs [(1)](#eq-1) and [(2)](#eq-2)",
                &[1, 2],
            ),
            (
                "(eqs 10, 11 and 15)",
                "(eqs [10](#eq-10), [11](#eq-11) and [15](#eq-15))",
                &[10, 11, 15],
            ),
            ("(3)–(5)", "[(3)](#eq-3)–[(5)](#eq-5)", &[3, 4, 5]),
            ("*as eq. 9 says*", "*as eq. [9](#eq-9) says*", &[9]),
            ("[by (9)](#fig1)", "[by (9)](#fig1)", &[9]),
        ] {
            assert_eq!(
                linked(text),
                (expected.to_owned(), numbers.to_vec()),
                "{text}"
            );
        }
    }

    #[test]
    fn other_numbers_are_none() {
        for text in [
            "AR(2)",
            "t(4)",
            "(16)",
            "(1 and 5)",
            "curves 1, 2",
            "(0)",
            "Fig. 6",
            "`(5)`",
            "(5",
            "P(1)",
            "eq. 16",
            "(+1)",
        ] {
            assert_eq!(linked(text), (text.to_owned(), Vec::new()), "{text}");
        }
    }

    proptest! {
        /// Markdown of what was read is what was read, whatever marks are in it.
        #[test]
        fn words_come_back(text in "[a `*_|()\\[\\]#σ]{0,24}") {
            prop_assert_eq!(markdown::text(&spans(&text)), text);
        }
    }
}
