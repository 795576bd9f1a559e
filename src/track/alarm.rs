//! The alarms of a record: stops that were judged to be at no floor, and what the next trip says of them.

use super::floors::{Fault, Judgement};
use super::record::Tracked;
use std::fmt;

/// A judgement that is an alarm, or that takes one back.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Alarm {
    /// The ride whose stop is judged.
    pub ride: usize,
    /// The ride that judged it again.
    pub by: Option<usize>,
    /// What was found.
    pub judgement: Judgement,
}

impl Alarm {
    /// Those of rides in order of time: at once, and again where the next ride raises or takes back one.
    pub fn all(rides: &[Tracked]) -> Vec<Self> {
        let of_ride = |(place, ride): (usize, &Tracked)| {
            let number = ride.trip.ride;
            let before = place.checked_sub(1).map(|place| &rides[place]);
            let first = at_once(ride).filter(|it| it.fault.is_some());
            let first = first.map(|judgement| Self {
                ride: number,
                by: None,
                judgement,
            });
            let again = again(ride).zip(before).map(|(judgement, before)| {
                let alarm = Self {
                    ride: before.trip.ride,
                    by: Some(number),
                    judgement,
                };
                (alarm, at_once(before))
            });
            let again = again.filter(|(alarm, first)| {
                let was_alarm = first.is_some_and(|it| it.fault.is_some());
                was_alarm || alarm.judgement.fault.is_some()
            });
            again.map(|it| it.0).into_iter().chain(first)
        };
        rides.iter().enumerate().flat_map(of_ride).collect()
    }

    /// The faults that stand at the end, each with its ride: as judged last.
    pub fn standing(rides: &[Tracked]) -> Vec<(usize, Fault)> {
        let last = |(place, ride): (usize, &Tracked)| {
            let again = rides.get(place + 1).and_then(again);
            let fault = again.or(at_once(ride))?.fault?;
            Some((ride.trip.ride, fault))
        };
        rides.iter().enumerate().filter_map(last).collect()
    }
}

fn at_once(ride: &Tracked) -> Option<Judgement> {
    ride.landing?.judgement
}

/// Of the stop before.
fn again(ride: &Tracked) -> Option<Judgement> {
    ride.landing?.earlier
}

impl fmt::Display for Alarm {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "ride {}", self.ride)?;
        if let Some(by) = self.by {
            write!(f, ", judged again by ride {by}")?;
        }
        write!(f, ": {}", self.judgement)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::track::floors::Stop;

    fn judged(fault: Option<Fault>) -> Judgement {
        Judgement {
            floor: 1,
            offset: -0.3,
            deviation: 0.05,
            xi: 36.0,
            fault,
        }
    }

    fn ride(ride: usize, at_once: Option<Fault>, earlier: Option<Judgement>) -> Tracked {
        let landing = Stop {
            position: 0.0,
            deviation: 0.1,
            from: None,
            floor: None,
            probability: 1.0,
            judgement: Some(judged(at_once)),
            earlier,
            added: None,
        };
        Tracked {
            landing: Some(landing),
            ..Tracked::told(ride, [0.0, 10.0], 3.0)
        }
    }

    /// The first is taken back, the second raised late, the third stands as it was.
    #[test]
    fn the_last_judgement_stands() {
        let pit = Some(Fault::Pit);
        let rides = [
            ride(1, pit, None),
            ride(2, None, Some(judged(None))),
            ride(3, pit, Some(judged(pit))),
        ];
        assert_eq!(Alarm::standing(&rides), [(2, Fault::Pit), (3, Fault::Pit)]);
        let lines = Alarm::all(&rides).into_iter().map(|it| it.to_string());
        assert_eq!(
            lines.collect::<Vec<_>>(),
            [
                "ride 1: alarm, in the pit: 0.300 ± 0.050 m below floor 1",
                "ride 1, judged again by ride 2: no alarm: 0.300 ± 0.050 m below floor 1",
                "ride 2, judged again by ride 3: alarm, in the pit: 0.300 ± 0.050 m below floor 1",
                "ride 3: alarm, in the pit: 0.300 ± 0.050 m below floor 1",
            ]
        );
    }
}
