//! The lift of a building, and a sensor by its data sheet.

use super::{Settings, Simulation};
use liftsim::config::Conflict;
use liftsim::lift::{Building, BuildingError, ExportLayout};

impl Settings {
    /// The ride in a building; what is refused is at its key.
    pub(super) fn of_building(&self, building: &Building) -> Result<Simulation, Conflict> {
        let understood = ["rate", "speed", "acceleration", "jerk"];
        if let Some(name) = self
            .names()
            .into_iter()
            .find(|name| !understood.contains(name))
        {
            let problem = format!("{name}: means nothing with a [building] (leave it out)");
            return Err(Conflict::of([name], problem));
        }
        let sensor = self.sensor.clone().unwrap_or_default();
        let rate = self.rate.unwrap_or(sensor.model.rate());
        let (ride, stops) = building
            .ride(self.drive(), rate, self.seed())
            .map_err(|error| {
                let key = match &error {
                    BuildingError::OutOfRange(error) => error.key.clone(),
                    BuildingError::Journey { .. } => "building.journeys".to_owned(),
                    BuildingError::Ride(_) => "rate".to_owned(),
                };
                Conflict::of([key, "building".to_owned()], error)
            })?;
        let vibration = building.vibration.get();
        let axes = sensor.axes(rate, vibration, self.seed());
        let axes =
            axes.map_err(|error| Conflict::of([error.key.clone(), "sensor".to_owned()], error))?;
        Ok(Simulation {
            ride,
            stops,
            axes,
            layout: ExportLayout::WithGravity,
            jitter: sensor.jitter.get(),
        })
    }
}
