//! The flags that send what `monitor` prints over a network.

use super::{Failure, output, say, warn};
use clap::Args;
use liftsim::outbox::{Address, LARGEST, Notice, Outbox, Spool, Timing};
use std::env;
use std::path::{Path, PathBuf};
use std::time::Duration;

/// Where events are sent, and kept until they are there.
#[derive(Debug, Args)]
#[command(next_help_heading = "The network")]
pub struct NetworkArguments {
    /// Send the events to this listener too, by TCP: a name, an IPv4 address, or an IPv6 address in brackets.
    ///
    /// Each is the line that is printed, with its number: {"sequence":1,"time":…}. On every connection the first
    /// line names the stream, {"event":"stream","stream":"…"}. The listener then sends the number of the last line of
    /// this stream that it has stored, or 0, on a line by itself, and again after it has stored more, within 10 s. It
    /// is sent what comes after the first number. What does not end in a line break was cut off, and comes again. So
    /// nothing is lost and nothing stored twice, whichever of the two is stopped. `scripts/listen.py` is such a
    /// listener.
    ///
    /// If the listener cannot be reached it is tried again after 0.5 s, then after twice as long, up to 30 s, and
    /// lines wait in the spool. The monitor goes on meanwhile, and if nobody reads what it prints. Nothing is encrypted:
    /// use a network of your own, or a tunnel.
    #[arg(long, value_name = "HOST:PORT")]
    tcp: Option<Address>,
    /// The file where events wait until the listener has acknowledged them; made if it is not there, and kept. The
    /// next start with it sends what is left and goes on with the stream. Each monitor needs its own.
    ///
    /// An event is in it before it is printed, and synced to the disk within about a second. If the disk is
    /// full, events wait in memory.
    #[arg(
        long,
        value_name = "FILE",
        default_value = "liftsim.spool",
        requires = "tcp"
    )]
    spool: PathBuf,
    /// The most that the spool takes, on the disk and in memory, MiB: about 6000 events each. If it is full the
    /// oldest quarter is dropped, and {"sequence":57,"event":"dropped","lines":40} stands in the stream for the 40
    /// lines up to 57.
    #[arg(long, value_name = "MIB", default_value_t = 16, requires = "tcp")]
    #[arg(value_parser = clap::value_parser!(u64).range(1..=LARGEST / MIB))]
    spool_size: u64,
    /// At the end of the samples, wait so long for the listener to acknowledge the rest, s.
    #[arg(long, value_name = "SECONDS", default_value_t = 10, requires = "tcp")]
    #[arg(value_parser = clap::value_parser!(u64).range(0..=86400))]
    tcp_wait: u64,
}

const MIB: u64 = 1 << 20;

/// The way to a listener.
pub struct Network {
    outbox: Outbox,
    /// The listener, and where lines wait for it.
    address: String,
    spool: String,
    /// How many lines of an earlier start the spool held.
    held: u64,
    wait: Duration,
}

/// Seconds before the first new attempt; tests set a shorter time.
const RETRY_AFTER: &str = "LIFTSIM_RETRY_AFTER";

impl NetworkArguments {
    /// The file where events wait, if they are sent.
    pub fn spool(&self) -> Option<&Path> {
        self.tcp.is_some().then_some(&*self.spool)
    }

    /// Begins to deliver, if there is somebody to deliver to.
    pub fn open(&self) -> Result<Option<Network>, Failure> {
        let Some(address) = &self.tcp else {
            return Ok(None);
        };
        output::not_stdout("--spool", output::KEPT, &self.spool)?;
        let (spool, cut) =
            Spool::open(&self.spool, self.spool_size * MIB).map_err(Failure::input)?;
        let name = self.spool.display().to_string();
        if cut > 0 {
            warn(format_args!(
                "{name}: its last {cut} bytes, which were not written to the end, are left out"
            ));
        }
        Ok(Some(Network {
            held: spool.waiting(),
            outbox: Outbox::start(address.clone(), spool, timing(), tell),
            address: address.to_string(),
            spool: name,
            wait: Duration::from_secs(self.tcp_wait),
        }))
    }
}

fn timing() -> Timing {
    let first = env::var(RETRY_AFTER)
        .ok()
        .and_then(|text| text.parse().ok());
    let first = first.and_then(|seconds| Duration::try_from_secs_f64(seconds).ok());
    let usual = Timing::default();
    Timing {
        first: first.unwrap_or(usual.first),
        most: first.map_or(usual.most, |first| 20 * first),
        ..usual
    }
}

fn tell(notice: Notice) {
    if notice.is_warning() {
        warn(notice);
    } else {
        say(notice);
    }
}

impl Network {
    /// Takes a line that is to be delivered.
    pub fn send(&self, line: &str) {
        self.outbox.send(line.trim_end());
    }

    /// Delivers what waits, as long as that may take, and says what is left; how many lines of an earlier start it delivered.
    pub fn close(self) -> u64 {
        let Self {
            outbox,
            address,
            spool,
            held,
            wait,
        } = self;
        let left = outbox.finish(wait);
        let kept = left.lines - left.lost;
        if kept > 0 {
            warn(format_args!(
                "{address}: lines that are not delivered: {kept}, kept in {spool} (start a monitor with --tcp {address} \
                 --spool {spool} to send them, or give more --tcp-wait)"
            ));
        }
        if left.lost > 0 {
            warn(format_args!(
                "{address}: lines that are neither delivered nor in {spool}, which could not be written: {} (they were \
                 printed; free space on the disk)",
                left.lost
            ));
        }
        held.saturating_sub(left.lines)
    }
}
