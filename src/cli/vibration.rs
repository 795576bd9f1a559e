//! Vibration beside a baseline, for `track`: its flags, and what is printed of it.

use super::Failure;
use super::output::Output;
use super::rides::{RideArguments, Rides};
use super::table;
use clap::Args;
use liftsim::figure;
use liftsim::track::vibration::{Baseline, GuardLine};
use liftsim::track::{Track, Used, VibrationReport};
use std::path::PathBuf;

/// One window in a thousand.
const ALARM_RATE: f64 = 1e-3;

/// What is usual in the lift, and how rarely what is usual may alarm.
#[derive(Debug, Args)]
#[command(next_help_heading = "Vibration")]
pub struct VibrationArguments {
    /// A baseline of the horizontal vibration of the lift that is kept: whole rides are learnt until it has settled, after
    /// some 1000 windows of 0.5 s, and judged from then on. Begun if it is not there. For one lift, and one sensor in one place.
    #[arg(long, value_name = "FILE")]
    baseline: Option<PathBuf>,
    /// How many of the windows of ordinary rides may be above the guard line [default: 0.001].
    #[arg(long, value_name = "SHARE", requires = "baseline", value_parser = alarm_rate)]
    alarm_rate: Option<f64>,
    /// Draw the energy against the position, with the guard line.
    #[arg(long, value_name = "FILE.png|FILE.svg", requires = "baseline")]
    spectrum: Option<PathBuf>,
}

/// A baseline, where it is kept, and where its picture goes.
pub struct Kept {
    spectrum: Option<Output>,
    baseline: Option<Baseline>,
    file: Output,
    rate: f64,
}

fn alarm_rate(text: &str) -> Result<f64, String> {
    let rate = text.parse().ok().filter(|it| (1e-9..=0.1).contains(it));
    rate.ok_or_else(|| "must be a share of 1e-9 to 0.1".to_owned())
}

impl VibrationArguments {
    /// The files that are written.
    pub fn outputs(&self) -> impl Iterator<Item = &PathBuf> {
        self.baseline.iter().chain(&self.spectrum)
    }

    /// Reads the baseline; none where it is not asked for.
    pub fn kept(&self, replaces: bool) -> Result<Option<Kept>, Failure> {
        let Some(path) = &self.baseline else {
            return Ok(None);
        };
        let picture = |path: &PathBuf| Output::picture("--spectrum", path, replaces);
        let spectrum = self.spectrum.as_ref().map(picture).transpose()?;
        let file = Output::kept("--baseline", path)?;
        let known = path.exists().then(|| Baseline::load(path));
        Ok(Some(Kept {
            baseline: known.transpose().map_err(Failure::input)?,
            file,
            spectrum,
            rate: self.alarm_rate.unwrap_or(ALARM_RATE),
        }))
    }
}

impl Kept {
    /// Sets rides beside it; it learns them as long as it has not settled.
    pub fn compare(
        &mut self,
        track: &Track,
        rides: &Rides,
        arguments: &RideArguments,
    ) -> Result<VibrationReport, Failure> {
        let recording = &rides.recording;
        let baseline = self
            .baseline
            .get_or_insert_with(|| Baseline::new(recording.rate()));
        let report = VibrationReport::new(track, recording, baseline, self.rate);
        let report = report.map_err(|error| arguments.refused(error.into()))?;
        if let Some(file) = self.spectrum.take() {
            let name = arguments.name();
            let plot = figure::vibration::plot(track, &report, &name);
            let plot = plot.map_err(|error| arguments.refused(error.into()))?;
            file.draw(&plot, &format!("recording {name}"))?.publish()?;
        }
        Ok(report)
    }

    /// Writes it, if it has learnt anything.
    pub fn save(&self) -> Result<(), Failure> {
        let learnt = self.baseline.as_ref();
        let learnt = learnt.filter(|it| !it.trips().is_empty());
        learnt.map_or(Ok(()), |baseline| {
            baseline.save(self.file.path()).map_err(Failure::input)
        })
    }
}

const LEGEND: &str = "energies of horizontal vibration in m²/s⁴, of a window of 0.5 s: the mean, and the largest; that at which position, m from the stop \
                      before\n";

/// The vibration of all rides, in lines.
pub fn text(report: &VibrationReport) -> String {
    let title = "\nvibration\n".to_owned() + &baseline(report);
    if report.rides.is_empty() {
        return title + "no ride was recorded from its start to its stop\n";
    }
    let rows = report.rides.iter().map(|ride| {
        let used = match ride.used {
            Used::Learnt => "learnt".to_owned(),
            Used::Known => "learnt before".to_owned(),
            Used::Judged if ride.alarms.is_empty() => "usual".to_owned(),
            Used::Judged => format!("{} alarms", ride.alarms.len()).replace("1 alarms", "1 alarm"),
        };
        let energies = [ride.energy, ride.most.energy].map(|it| format!("{it:.5}"));
        let [energy, largest] = energies;
        let position = metres(ride.most.position);
        vec![ride.ride.to_string(), energy, largest, position, used]
    });
    let rows: Vec<Vec<String>> = rows.collect();
    let names = ["ride", "energy", "largest", "position", "baseline"];
    let alarms = report.alarms().into_iter().map(|it| it + "\n");
    title + &table(&names, &rows) + LEGEND + &alarms.collect::<String>()
}

fn baseline(of: &VibrationReport) -> String {
    let (trips, windows) = (of.trips, of.windows);
    let known = of.mean.map_or_else(String::new, |mean| {
        let error = of
            .standard_error
            .map(|it| format!(" ± {:.0} %", 100.0 * it / mean));
        format!(": mean {mean:.5} m²/s⁴{}", error.unwrap_or_default())
    });
    let Some(guard) = of.guard.filter(|_| of.settled) else {
        let expected = of.expected_trips.map(|it| format!(" of about {it}"));
        let expected = expected.unwrap_or_default();
        return format!(
            "{trips}{expected} trips, {windows} windows{known}; the baseline has not settled, so nothing is judged (record more \
             rides)\n"
        );
    };
    format!("settled with {trips} trips, {windows} windows{known}\n") + &line(&guard)
}

fn line(of: &GuardLine) -> String {
    format!(
        "guard line {:.5} m²/s⁴, {}, for {} of the windows of ordinary rides\n\
         each trip beside the line that the others give: {:.5} of the windows and {:.3} of the trips are above it\n",
        of.energy,
        of.guard.words(),
        of.rate,
        of.per_window,
        of.per_trip
    )
}

fn metres(of: Option<f64>) -> String {
    of.map_or_else(|| "-".to_owned(), |it| format!("{it:.2}"))
}
