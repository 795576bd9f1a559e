//! The text of a spool: a line that names its stream, and one for each line that waits. Each begins with the CRC-32 of
//! what follows in it, so that damage shows.

use flate2::Crc;
use std::collections::VecDeque;
use std::str;

/// What every spool begins with, after its checksum, and the version of its text.
const KIND: &str = "liftsim-spool";
const VERSION: &str = "1";

/// What a record adds to a line at most: checksum, number, two spaces and the end of the line.
pub(super) const OVERHEAD: usize = 8 + 20 + 3;

/// The content of a spool.
#[derive(Debug)]
pub(super) struct Contents {
    pub stream: String,
    /// The number before that of the first line.
    pub after: u64,
    pub lines: VecDeque<Box<str>>,
    /// How many bytes are whole; others, half written, may follow.
    pub whole: usize,
}

/// Why a text is no spool.
#[derive(Debug, thiserror::Error)]
pub(super) enum Unreadable {
    #[error("is no spool of liftsim")]
    Foreign,
    #[error("is a spool of another version of liftsim")]
    Version,
    #[error("is damaged in line {0}")]
    Damaged(usize),
}

/// The first line of a spool.
pub(super) fn header(stream: &str, after: u64) -> String {
    checked(&format!("{KIND} {VERSION} {stream} {after}"))
}

/// The line of a spool for a line that waits.
pub(super) fn record(number: u64, line: &str) -> String {
    checked(&format!("{number} {line}"))
}

fn checked(content: &str) -> String {
    format!("{:08x} {content}\n", sum(content.as_bytes()))
}

fn sum(bytes: &[u8]) -> u32 {
    let mut crc = Crc::new();
    crc.update(bytes);
    crc.sum()
}

/// A line without its checksum, if that is right.
fn content(line: &[u8]) -> Option<&str> {
    let line = str::from_utf8(line).ok()?.strip_suffix('\n')?;
    let (written, content) = line.split_once(' ')?;
    (written == format!("{:08x}", sum(content.as_bytes()))).then_some(content)
}

/// Reads a spool. What is not whole at its end was being written when the program was killed, and is left out; where
/// something whole follows, it was damaged since.
pub(super) fn read(bytes: &[u8]) -> Result<Contents, Unreadable> {
    let mut lines = bytes.split_inclusive(|byte| *byte == b'\n');
    let mut contents = begin(lines.next().unwrap_or_default())?;
    let mut broken = None;
    for (line, index) in lines.zip(2..) {
        let number = contents.after + contents.lines.len() as u64 + 1;
        let Some(content) = content(line) else {
            broken = broken.or(Some(index));
            continue;
        };
        match content.strip_prefix(&format!("{number} ")) {
            Some(text) if broken.is_none() => contents.lines.push_back(text.into()),
            _ => return Err(Unreadable::Damaged(broken.unwrap_or(index))),
        }
        contents.whole += line.len();
    }
    Ok(contents)
}

/// A spool of which only the first line is read.
fn begin(line: &[u8]) -> Result<Contents, Unreadable> {
    let is_ours = line
        .get(9..)
        .is_some_and(|rest| rest.starts_with(KIND.as_bytes()));
    if !is_ours {
        return Err(Unreadable::Foreign);
    }
    let content = content(line).ok_or(Unreadable::Damaged(1))?;
    let parts: Vec<&str> = content.split(' ').collect();
    match parts[..] {
        [_, VERSION, stream, after] => Ok(Contents {
            stream: stream.to_owned(),
            after: after.parse().map_err(|_| Unreadable::Damaged(1))?,
            lines: VecDeque::new(),
            whole: line.len(),
        }),
        _ => Err(Unreadable::Version),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn spool() -> String {
        let lines = (8..12).map(|number| record(number, &format!("{{\"time\":{number}}}")));
        header("cafe", 7) + &lines.collect::<String>()
    }

    fn texts(contents: &Contents) -> Vec<&str> {
        contents.lines.iter().map(|line| &**line).collect()
    }

    #[test]
    fn what_is_written_is_read() {
        let text = spool();
        let contents = read(text.as_bytes()).unwrap();
        assert_eq!(
            (&*contents.stream, contents.after, contents.whole),
            ("cafe", 7, text.len())
        );
        let expected = [8, 9, 10, 11].map(|number| format!("{{\"time\":{number}}}"));
        assert_eq!(texts(&contents), expected);
    }

    /// Cut anywhere, every line that is whole is kept.
    #[test]
    fn a_cut_loses_no_whole_line() {
        let text = spool();
        let head = text.find('\n').unwrap() + 1;
        for length in 0..text.len() {
            let cut = &text.as_bytes()[..length];
            match read(cut) {
                Ok(contents) => {
                    let whole = text[head..length].matches('\n').count();
                    assert_eq!(contents.lines.len(), whole, "cut at {length}");
                    assert!(text[..contents.whole].ends_with('\n'));
                }
                Err(error) => assert!(length < head, "cut at {length}: {error}"),
            }
        }
    }

    /// A byte that was changed is never read as something else: the spool is refused, or its end is left out.
    #[test]
    fn a_changed_byte_is_seen() {
        let text = spool().into_bytes();
        let last = text[..text.len() - 1]
            .iter()
            .rposition(|byte| *byte == b'\n')
            .unwrap();
        for at in 0..text.len() {
            let mut changed = text.clone();
            changed[at] ^= 4;
            match read(&changed) {
                // Without the line break before it, the last line is part of another.
                Ok(contents) => assert_eq!(contents.lines.len(), 3 - usize::from(at == last)),
                Err(_) => assert!(at < last, "byte {at}"),
            }
        }
    }

    #[test]
    fn what_is_not_a_spool_is_refused() {
        for (text, message) in [
            ("time,acc\n0,9.8\n".to_owned(), "no spool"),
            (checked("liftsim-spool 2 cafe 7"), "another version"),
            (header("cafe", 7) + &record(9, "{}"), "damaged in line 2"),
            (
                spool().replacen("\"time\":9", "\"time\":7", 1),
                "damaged in line 3",
            ),
        ] {
            let error = read(text.as_bytes()).unwrap_err().to_string();
            assert!(error.contains(message), "{text}: {error}");
        }
    }
}
