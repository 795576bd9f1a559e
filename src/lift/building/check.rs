//! Whether a building makes sense, before its lift moves.

use super::{Building, FaultKind, Journeys};
use crate::rule::{OutOfRange, Rule};

/// A building with more journeys than this is a mistake.
const MOST_JOURNEYS: usize = 100_000;

/// No car stops farther out of level than this, m, nor farther beyond its shaft; and no brake is weaker or stronger, m/s².
const LEVEL: f64 = 1.0;
const BEYOND: f64 = 20.0;
const EMERGENCY: (f64, f64) = (0.5, 50.0);

impl Building {
    pub(super) fn check(&self) -> Result<(), OutOfRange> {
        if self.floors.len() < 2 {
            let refused = OutOfRange::new("building.floors", "be two or more", self.floors.len());
            return Err(refused.explained(" (a lift needs somewhere to go)"));
        }
        for (place, pair) in self.floors.windows(2).enumerate() {
            let increases = pair[0] < pair[1];
            if !increases {
                let key = format!("building.floors[{}]", place + 1);
                let rule = format!("lie above the floor before it, {}", pair[0]);
                let refused = OutOfRange::new(key, rule, pair[1]);
                return Err(refused.explained(" (give heights in m from the lowest floor up)"));
            }
        }
        let [least, most] = self.dwell;
        if least > most {
            let rule = format!("be at least the shortest, {}", least.get());
            let refused = OutOfRange::new("building.dwell[1]", rule, most.get());
            return Err(refused.explained(" (exchange them)"));
        }
        let journeys = self.check_journeys()?;
        self.check_faults(journeys)
    }

    /// Returns their number.
    fn check_journeys(&self) -> Result<usize, OutOfRange> {
        let limits = |key: &str, number: usize| {
            let rule = Rule::Within(1.0, MOST_JOURNEYS as f64, "journeys");
            rule.check(key, &number).map(|()| number)
        };
        let visited = match &self.journeys {
            Journeys::Random { random } => return limits("building.journeys.random", *random),
            Journeys::Given(visited) => visited,
        };
        for (place, floor) in visited.iter().enumerate() {
            let key = format!("building.journeys[{place}]");
            let highest = self.floors.len() - 1;
            if *floor > highest {
                let refused = OutOfRange::new(key, format!("be a floor, 0 to {highest}"), floor);
                return Err(refused.explained(" (count floors from 0, the lowest)"));
            }
            if place > 0 && visited[place - 1] == *floor {
                let refused = OutOfRange::new(key, "differ from the floor before it", floor);
                return Err(refused.explained(" (leave it out)"));
            }
        }
        limits("building.journeys", visited.len().saturating_sub(1))
    }

    fn check_faults(&self, journeys: usize) -> Result<(), OutOfRange> {
        for (place, fault) in self.faults.iter().enumerate() {
            let key = format!("building.faults[{place}].journey");
            let number = fault.journey;
            if !(1..=journeys).contains(&number) {
                let rule = format!("be a journey, 1 to {journeys}");
                let refused = OutOfRange::new(key, rule, number);
                return Err(refused.explained(" (the first journey is 1)"));
            }
            if self.faults[..place].iter().any(|of| of.journey == number) {
                let refused = OutOfRange::new(key, "have one fault only", number);
                return Err(refused.explained(" (leave one)"));
            }
            let (rule, value) = match fault.kind {
                FaultKind::MisLevelling(offset) => (Rule::Within(-LEVEL, LEVEL, "m"), offset),
                FaultKind::Pit(way) | FaultKind::Overrun(way) => {
                    (Rule::Within(0.0, BEYOND, "m"), way.get())
                }
                FaultKind::EmergencyStop(brake) => {
                    (Rule::Within(EMERGENCY.0, EMERGENCY.1, "m/s²"), brake.get())
                }
                FaultKind::BetweenFloors(_) => continue,
            };
            let key = format!("building.faults[{place}].kind.{}", fault.kind.name());
            rule.check(&key, &value)?;
        }
        Ok(())
    }
}
