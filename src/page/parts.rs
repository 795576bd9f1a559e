//! What the sections of a page have in common.

use maud::{Markup, html};

/// A section with its title.
pub(super) fn section(id: &str, title: &str, content: Markup) -> Markup {
    html! { section id=(id) { h2 { (title) } (content) } }
}

/// What may be wider than a phone: it scrolls by itself, also by keyboard.
pub(super) fn wide(label: &str, content: Markup) -> Markup {
    html! { div.wide role="region" aria-label=(label) tabindex="0" { (content) } }
}

/// With a capital, unless it begins with what a user would type, and with a full stop.
pub(super) fn sentence(text: &str) -> String {
    let mut rest = text.chars();
    let first = rest.next().into_iter().flat_map(char::to_uppercase);
    let end = if text.ends_with('.') { "" } else { "." };
    first.chain(rest).collect::<String>() + end
}
