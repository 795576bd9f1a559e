//! XML piece by piece, in bounded memory.

use quick_xml::Reader;
use quick_xml::XmlVersion;
use quick_xml::escape::resolve_predefined_entity;
use quick_xml::events::{BytesRef, BytesStart, Event};
use std::io::BufRead;

/// The longest tag or text, and the most of all, bytes.
const LONGEST: u64 = 1 << 20;
const LARGEST: u64 = 1 << 30;

/// The deepest nesting.
const DEEPEST: usize = 64;

/// A piece of a document. Elements have their names without prefixes.
pub(super) enum Piece<'a> {
    Start(&'a str, &'a BytesStart<'a>),
    /// Text, or a part of it, directly after the start of an element.
    Text(&'a str, &'a str),
    End(&'a str),
}

/// Hands every piece over.
///
/// # Errors
/// What is wrong with the document, or why a piece was refused.
pub(super) fn read(
    text: impl BufRead,
    mut take: impl FnMut(Piece) -> Result<(), String>,
) -> Result<(), String> {
    let mut reader = Reader::from_reader(text.take(LONGEST));
    reader.config_mut().expand_empty_elements = true;
    let (mut buffer, mut inside, mut depth) = (Vec::new(), String::new(), 0);
    loop {
        buffer.clear();
        reader.get_mut().set_limit(LONGEST);
        let event = reader.read_event_into(&mut buffer);
        if reader.get_ref().limit() == 0 || reader.buffer_position() > LARGEST {
            return Err("is too large".to_owned());
        }
        match event.map_err(|error| error.to_string())? {
            Event::Start(tag) => {
                depth += 1;
                if depth > DEEPEST {
                    return Err(format!("is nested more than {DEEPEST} deep"));
                }
                let name = tag.local_name();
                inside.clear();
                inside.push_str(name.as_ref());
                take(Piece::Start(name.as_ref(), &tag))?;
            }
            Event::End(tag) => {
                depth -= 1;
                inside.clear();
                take(Piece::End(tag.local_name().as_ref()))?;
            }
            Event::Text(text) => take(Piece::Text(&inside, &text.xml10_content()))?,
            Event::CData(text) => take(Piece::Text(&inside, &text.xml10_content()))?,
            Event::GeneralRef(name) => take(Piece::Text(&inside, &resolved(&name)?))?,
            Event::Eof if depth > 0 => return Err("ends within an element".to_owned()),
            Event::Eof => return Ok(()),
            _ => {}
        }
    }
}

fn resolved(name: &BytesRef) -> Result<String, String> {
    let letter = name.resolve_char_ref().map_err(|error| error.to_string())?;
    let letter = letter.map(String::from);
    letter
        .or(resolve_predefined_entity(name).map(str::to_owned))
        .ok_or_else(|| format!("has an unknown entity &{};", &**name))
}

/// The value of an attribute, whose name is given without a prefix.
///
/// # Errors
/// What is wrong with the attributes.
pub(super) fn attribute(tag: &BytesStart, name: &str) -> Result<Option<String>, String> {
    for attribute in tag.attributes().with_checks(false) {
        let attribute = attribute.map_err(|error| error.to_string())?;
        if attribute.key.local_name().as_ref() == name {
            let value = attribute.normalized_value(XmlVersion::Implicit1_0);
            return Ok(Some(value.map_err(|error| error.to_string())?.into_owned()));
        }
    }
    Ok(None)
}
