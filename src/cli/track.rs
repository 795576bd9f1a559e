//! `liftsim track RECORDING`: how far each ride of a recording went, and how well that is known.

use super::air::{self, AirArguments, Measured};
use super::floors::{self, Building, FloorArguments};
use super::found::{self, cell};
use super::output::{self, Output, Ready};
use super::quality::{self, QualityArguments};
use super::rides::{RideArguments, Rides};
use super::rows::{FormatArguments, Rows, Shown};
use super::vibration::{self, VibrationArguments};
use super::{CommandResult, Failure, table, warn};
use anyhow::anyhow;
use clap::{ArgGroup, Args};
use liftsim::detection::no_rides;
use liftsim::figure::track::Beside;
use liftsim::figure::{self, FigureError};
use liftsim::page;
use liftsim::plot::Plot;
use liftsim::track::floors::Floors;
use liftsim::track::{ByRules, Climbs, Move, Track, TrackReport, Tracked, calibrated};
use std::path::PathBuf;
use std::process::ExitCode;

/// Measure how far each ride of a recording went, with its standard deviation.
///
/// The rides are those that `detect` finds, and RECORDING and its flags are read as there. The acceleration is integrated
/// by a Kalman filter of distance, speed and the sensor's bias that knows when the cage stands and when it moves
/// uniformly: then its speed is zero, or does not change.
///
/// `closing` is the speed that is left where the cage stands. Where it is too much for the noise the sensor's gain or tilt
/// was wrong, and the deviation is widened, aloud. The deviation does not hold an error of the gain that is the same in
/// all of the record: 1 % of it is 1 % of every distance. Behind a high-pass filter nothing is measured.
///
/// With `--floors` or `--map` every stop is compared with the floors: at which the car stands, how far off, and an alarm
/// where that is too much. The trip after it judges it again.
///
/// With `--rules` the trips by a published filter and its zero rules stand beside them, for comparison: it needs a record
/// that begins with two seconds of rest, and is the worse of the two.
///
/// With `--quality` each ride is judged: how hard it speeds up and brakes, and how much it shakes. With `--baseline` its
/// horizontal vibration is set beside what is usual in the lift, and what is beyond is located.
#[derive(Debug, Args)]
#[command(group = ArgGroup::new("judged").args(["quality", "report"]).multiple(true))]
#[command(after_help = "Examples:\n  \
    liftsim simulate --out ride.csv && liftsim track ride.csv --figure track.png\n  \
    liftsim track log.csv --time t --acceleration az --unit mg --format csv > rides.csv\n  \
    liftsim track phone.zip --report ride.html\n  \
    liftsim track phone.zip --baseline lift.vibration.json\n  \
    liftsim track ride.csv --floors 0,12 --at 0 --map lift.json")]
pub struct TrackCommand {
    #[command(flatten)]
    format: FormatArguments,
    /// Draw the record, the speed, and the position within two deviations.
    #[arg(long, value_name = "FILE.png|FILE.svg")]
    figure: Option<PathBuf>,
    /// Write a page that stands for itself, to be read and printed: picture, rides, floors, alarms, ride quality (as with
    /// --quality), the sensor, and what was not decided.
    #[arg(long, value_name = "FILE.html")]
    report: Option<PathBuf>,
    /// Find the trips by published rules too: nothing changes the speed while all readings of 0.25 s are below a
    /// threshold, m/s² [default: 5 deviations of a reading at rest].
    #[arg(long, value_name = "THRESHOLD", num_args = 0..=1, require_equals = true, value_parser = threshold)]
    rules: Option<Option<f64>>,
    /// Replace files that exist.
    #[arg(long)]
    force: bool,
    #[command(flatten)]
    floors: FloorArguments,
    #[command(flatten)]
    air: AirArguments,
    #[command(flatten)]
    quality: QualityArguments,
    #[command(flatten)]
    vibration: VibrationArguments,
    #[command(flatten)]
    rides: RideArguments,
}

/// The columns shown of every trip.
const SHOWN: [&str; 9] = [
    "ride",
    "direction",
    "start",
    "stop",
    "distance",
    "deviation",
    "speed",
    "closing_speed",
    "ended",
];

/// Those of a barometer, and where they stand among them.
const HEIGHT: [&str; 4] = [
    "height",
    "height_deviation",
    "position",
    "position_deviation",
];
const BESIDE: usize = 6;

impl TrackCommand {
    /// Runs the command.
    pub fn run(self) -> CommandResult {
        let picture = |path: &PathBuf| Output::picture("--figure", path, self.force);
        let figure = self.figure.as_ref().map(picture).transpose()?;
        let page = |path: &PathBuf| Output::page(path, self.force);
        let page = self.report.as_ref().map(page).transpose()?;
        self.rides.apart(self.files())?;
        self.air.apart(self.files())?;
        let mut building = self.floors.building(self.force)?;
        let mut kept = self.vibration.kept(self.force)?;
        let is_judged = self.quality.is_wanted() || page.is_some();
        let rides = self
            .rides
            .find(is_judged || kept.is_some() || figure.is_some())?;
        let Measured {
            rides,
            mut track,
            heights,
            unused,
        } = self.air.measure(rides, self.rides.path())?;
        rides.warn();
        let quality = is_judged.then(|| self.quality.judge(&mut track, &rides));
        if let Some(building) = &mut building {
            self.land(&mut track, &rides, building)?;
        }
        let compare = |kept: &mut vibration::Kept| kept.compare(&track, &rides, &self.rides);
        let vibration = kept.as_mut().map(compare).transpose()?;
        for warning in track.warnings() {
            warn(warning);
        }
        if let Some((barometer, climbs)) = &heights {
            barometer.warnings.iter().for_each(warn);
            climbs.warnings(&track.trips).iter().for_each(warn);
        }
        let floors = building.as_ref().map(|building| &building.floors);
        let heights = heights.as_ref().map(|(of, climbs)| (of, climbs));
        let (recording, detection) = (&rides.recording, &rides.detection);
        let name = self.rides.name();
        let by_rules = |threshold| {
            let (samples, rate) = (recording.samples(), recording.rate());
            ByRules::new(samples, rate, &track.level, threshold)
        };
        let report = TrackReport {
            rules: self.rules.map(by_rules),
            vibration,
            ..TrackReport::new(name, recording, detection, &track, floors, heights)
        };
        let mut report = report.with_quality(quality);
        report.warnings.extend(unused);
        let first = recording.facts().start + ByRules::REST;
        let begins = track.trips.first().map(|it| it.trip.start);
        let is_late = begins.is_none_or(|start| start.is_some_and(|start| start >= first));
        if report.rules.is_some() && !is_late {
            let warning = "the published rules need two seconds of rest at the beginning, and the first ride begins sooner: do \
                           not trust their trips";
            warn(warning);
            report.warnings.push(warning.to_owned());
        }
        let is_drawn = figure.is_some() || page.is_some();
        let plot = is_drawn.then(|| self.plot(&rides, &track, floors, heights.map(|it| it.1)));
        let plot = plot.transpose()?;
        let figure = figure.zip(plot.as_ref()).map(|(figure, plot)| {
            let origin = format!("recording {}", report.recording.file);
            figure.draw(plot, &origin)
        });
        let page = page.zip(plot.as_ref()).map(|(page, plot)| {
            let html = page::html(&report, plot).map_err(Failure::run)?;
            page.write(html.as_bytes())
        });
        let ready: Result<Vec<Ready>, Failure> = figure.into_iter().chain(page).collect();
        for it in ready? {
            it.publish()?;
        }
        output::print_beside(self.files(), &self.format.show(&report))?;
        building.map_or(Ok(()), |building| building.save())?;
        kept.map_or(Ok(()), |kept| kept.save())?;
        Ok(ExitCode::SUCCESS)
    }

    fn files(&self) -> impl Iterator<Item = &PathBuf> {
        (self.figure.iter())
            .chain(&self.report)
            .chain(&self.floors.map)
            .chain(self.vibration.outputs())
    }

    fn land(
        &self,
        track: &mut Track,
        rides: &Rides,
        building: &mut Building,
    ) -> Result<(), Failure> {
        let has_height = track.trips.iter().any(|it| it.climb.is_some());
        if rides.detection.filter.time_constant().is_some() && !has_height {
            return Err(self.rides.refused(anyhow!(
                "behind a high-pass filter no floors are found (record the raw accelerometer, with g, or a barometer beside it, \
                 or leave out --floors and --map)"
            )));
        }
        let samples = rides.recording.samples();
        track.land(&rides.detection, samples, &mut building.floors);
        Ok(())
    }

    fn plot(
        &self,
        rides: &Rides,
        track: &Track,
        floors: Option<&Floors>,
        climbs: Option<&Climbs>,
    ) -> Result<Plot, Failure> {
        let name = self.rides.name();
        let zero = rides.recording.facts().counts_from();
        let floors = floors.into_iter().flat_map(Floors::floors);
        let floors: Vec<f64> = floors.map(|floor| floor.height).collect();
        let barometer = climbs.map_or(&[][..], |climbs| &climbs.readings);
        let beside = Beside {
            horizontal: &track.horizontal(&rides.recording),
            floors: &floors,
            barometer,
        };
        let plot = figure::track::plot(&rides.detection, track, &beside, (&name, zero.as_deref()));
        plot.map_err(|error| match error {
            FigureError::Short => self.rides.refused(error.into()),
            error => Failure::run(error),
        })
    }
}

impl Shown for TrackReport<'_> {
    fn text(&self) -> String {
        let calibration = calibrated(&self.calibration, self.is_followed);
        [
            found::recording(&self.recording),
            calibration
                .map(|(name, it)| format!("{}: {it}\n", name.to_lowercase()))
                .unwrap_or_default(),
            self.barometer.as_ref().map(air::text).unwrap_or_default(),
            trips(self),
            self.rules.as_ref().map(rules).unwrap_or_default(),
            quality(self),
            self.vibration
                .as_ref()
                .map(vibration::text)
                .unwrap_or_default(),
            floors::text(self),
            found::undecided(self.undecided),
            found::events(self.events),
        ]
        .concat()
    }

    fn json(&self) -> String {
        self.json()
    }

    fn rows(&self) -> Rows {
        Rows {
            columns: self.columns(),
            cells: self.rows(),
        }
    }
}

fn threshold(text: &str) -> Result<f64, String> {
    let threshold = text.parse().ok().filter(|it| *it > 0.0 && *it <= 5.0);
    threshold.ok_or_else(|| "must be an acceleration above 0 and up to 5 m/s^2".to_owned())
}

/// The trips by the published rules.
fn rules(of: &ByRules) -> String {
    let title = format!(
        "\nby the published rules, with a threshold of {:.3} m/s²:",
        of.threshold
    );
    if of.trips.is_empty() {
        return title + " no trip from rest to rest\n";
    }
    let row = |it: &Move| {
        let numbers = [it.start, it.stop, it.distance].map(|it| cell(&it.into()));
        let direction = cell(&serde_json::json!(it.direction));
        [vec![direction], numbers.to_vec()].concat()
    };
    let rows: Vec<Vec<String>> = of.trips.iter().map(row).collect();
    title + "\n" + &table(&["direction", "start", "stop", "distance"], &rows)
}

fn quality(report: &TrackReport) -> String {
    let quality = report.quality.as_ref();
    quality
        .map(|it| quality::text(report.rides, it))
        .unwrap_or_default()
}

fn trips(report: &TrackReport) -> String {
    if report.rides.is_empty() {
        return format!("\n{}\n", no_rides(report.undecided, report.events));
    }
    let mut shown = SHOWN.to_vec();
    if report.barometer.is_some() {
        shown.splice(BESIDE..BESIDE, HEIGHT);
    }
    shown.extend(found::dated(&report.recording));
    let row = |ride: &Tracked| {
        let cells = shown.iter().map(|name| cell(&ride.column(name)));
        cells.collect()
    };
    let rows: Vec<Vec<String>> = report.rides.iter().map(row).collect();
    let ends = report.rides.iter();
    let ends: String = ends.map(|ride| found::other_ends(&ride.trip)).collect();
    let legend = "times in s of the recording's clock, distances and their standard deviations in m, speeds in m/s\n";
    "\n".to_owned() + &table(&shown, &rows) + legend + &ends
}
