//! Where a listener is: `HOST:PORT`.

use crate::format::shorten;
use std::fmt::{self, Display};
use std::io;
use std::net::{Ipv6Addr, TcpStream, ToSocketAddrs};
use std::str::FromStr;
use std::time::Duration;

/// A host, by its name or its address, and a port.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Address {
    host: String,
    port: u16,
}

/// Why a text is no address.
#[derive(Debug, PartialEq, Eq, thiserror::Error)]
#[allow(missing_docs, reason = "the message says it")]
pub enum AddressError {
    #[error(
        "must be HOST:PORT, got {0} (for example example.org:9000, 192.0.2.7:9000 or [::1]:9000)"
    )]
    Form(String),
    #[error("host: an IPv6 address must stand in brackets, got {0} (for example [::1]:9000)")]
    Bare(String),
    #[error("host: must be an IPv6 address in the brackets, got {0} (for example [::1]:9000)")]
    Bracketed(String),
    #[error("port: must lie in [1, 65535], got {0} (for example {1}:9000)")]
    Port(String, String),
}

impl FromStr for Address {
    type Err = AddressError;

    fn from_str(text: &str) -> Result<Self, AddressError> {
        let form = || AddressError::Form(shorten(text).into_owned());
        let (host, port) = text.rsplit_once(':').ok_or_else(form)?;
        let inner = host.strip_prefix('[').and_then(|it| it.strip_suffix(']'));
        match inner {
            // The interface of a link-local address follows a percent sign.
            Some(inner)
                if inner
                    .split('%')
                    .next()
                    .is_none_or(|it| it.parse::<Ipv6Addr>().is_err()) =>
            {
                return Err(AddressError::Bracketed(shorten(inner).into_owned()));
            }
            None if text.parse::<Ipv6Addr>().is_ok() || host.parse::<Ipv6Addr>().is_ok() => {
                return Err(AddressError::Bare(text.to_owned()));
            }
            None if host.is_empty()
                || host.contains(|c: char| c.is_whitespace() || "[]:/@".contains(c)) =>
            {
                return Err(form());
            }
            _ => {}
        }
        let port = match port.parse() {
            Ok(port @ 1..) => port,
            _ => {
                return Err(AddressError::Port(
                    shorten(port).into_owned(),
                    shorten(host).into_owned(),
                ));
            }
        };
        let host = inner.unwrap_or(host).to_owned();
        Ok(Self { host, port })
    }
}

impl Display for Address {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if self.host.contains(':') {
            write!(f, "[{}]:{}", self.host, self.port)
        } else {
            write!(f, "{}:{}", self.host, self.port)
        }
    }
}

impl Address {
    /// Connects to the first of the host's addresses that answers. Names are looked up each time, for hosts move.
    pub(super) fn connect(&self, within: Duration) -> io::Result<TcpStream> {
        let mut failure = io::Error::new(io::ErrorKind::NotFound, "the name has no address");
        for address in (&*self.host, self.port).to_socket_addrs()? {
            match TcpStream::connect_timeout(&address, within) {
                // Where nobody listens on a high port of this machine, a socket may be given that port, and reach
                // itself.
                Ok(stream) if stream.local_addr().ok() == stream.peer_addr().ok() => {
                    failure = io::ErrorKind::ConnectionRefused.into();
                }
                Ok(stream) => return Ok(stream),
                Err(error) => failure = error,
            }
        }
        Err(failure)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_an_address_is_read_and_written() {
        for text in [
            "localhost:9000",
            "192.0.2.7:1",
            "[::1]:65535",
            "[fe80::1%eth0]:9000",
        ] {
            assert_eq!(text.parse::<Address>().unwrap().to_string(), text);
        }
    }

    #[test]
    fn what_is_none_is_refused_with_an_example() {
        let cases = [
            ("", "must be HOST:PORT, got  ("),
            ("9000", "must be HOST:PORT"),
            (":9000", "must be HOST:PORT"),
            ("tcp://host:9000", "must be HOST:PORT"),
            ("a b:9000", "must be HOST:PORT"),
            ("[::1]", "must be HOST:PORT"),
            ("::1", "must stand in brackets, got ::1"),
            ("::1:9000", "must stand in brackets"),
            (
                "[host]:9000",
                "must be an IPv6 address in the brackets, got host",
            ),
            ("host:", "port: must lie in [1, 65535], got  ("),
            ("host:0", "port: must lie in [1, 65535], got 0"),
            ("host:65536", "port: must lie in [1, 65535], got 65536"),
            ("host:http", "got http (for example host:9000)"),
        ];
        for (text, message) in cases {
            let error = text.parse::<Address>().unwrap_err().to_string();
            assert!(
                error.contains(message) && error.contains(":9000)"),
                "{text}: {error}"
            );
        }
    }
}
