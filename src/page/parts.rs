//! What pages and their sections have in common.

use maud::{DOCTYPE, Markup, PreEscaped, Render, html};

/// Nothing but what is in the page.
const POLICY: &str = "default-src 'none'; img-src data:; style-src 'unsafe-inline'; base-uri 'none'; form-action 'none'";

/// A page that asks for nothing, in these colour schemes.
pub(super) fn shell(title: &str, schemes: &str, style: &str, body: Markup) -> String {
    let page = html! {
        (DOCTYPE)
        html lang="en" {
            head {
                meta charset="utf-8";
                meta http-equiv="Content-Security-Policy" content=(POLICY);
                meta name="viewport" content="width=device-width, initial-scale=1";
                meta name="color-scheme" content=(schemes);
                title { (title) }
                style { (PreEscaped(style)) }
            }
            body { (body) }
        }
    };
    page.into_string() + "\n"
}

/// A section with its title.
pub(super) fn section(id: &str, title: impl Render, content: Markup) -> Markup {
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
