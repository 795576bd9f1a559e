//! A ride of trips that are typed, and a phone that lies level in it.

use super::request::Request;
use super::{Settings, Simulation};
use anyhow::{Context, anyhow};
use liftsim::lift::{ExportLayout, Pickup, Ride};
use liftsim::recording::GRAVITY;
use liftsim::signal::Digitiser;

impl Settings {
    /// The ride, without a building.
    pub(super) fn of_trips(&self) -> anyhow::Result<Simulation> {
        let upright = self.pickup()?;
        let level = Pickup {
            cosine: 0.0,
            bias: 0.0,
            ..upright.clone()
        };
        let layout = if self.with_gravity {
            ExportLayout::WithGravity
        } else {
            ExportLayout::Linear
        };
        Ok(Simulation {
            ride: self.ride()?,
            stops: Vec::new(),
            axes: [level.clone(), level, upright],
            layout,
            jitter: 0.0,
        })
    }

    fn ride(&self) -> anyhow::Result<Ride> {
        let drive = self.drive();
        let jam_within = self.jam_within.unwrap_or(0.1);
        let there_and_back = [12.0, -12.0].map(|distance| Request {
            distance,
            jam: None,
        });
        let requests = self.trip.as_deref().unwrap_or(&there_and_back);
        let trips = (1..)
            .zip(requests)
            .map(|(number, request)| {
                let trip = request.trip(drive, jam_within);
                trip.with_context(|| format!("trip {number}"))
            })
            .collect::<anyhow::Result<Vec<_>>>()?;
        let rests = match self.rest.as_deref().unwrap_or(&[8.0]) {
            [rest] => vec![*rest; trips.len() + 1],
            rests => rests.to_vec(),
        };
        Ok(Ride::new(self.rate.unwrap_or(100.0), rests, trips)?)
    }

    /// The sensor of the vertical axis.
    fn pickup(&self) -> anyhow::Result<Pickup> {
        let sigma = self.sigma.unwrap_or(0.012);
        let pickup = Pickup {
            vibration: self.vibration.unwrap_or(2.2),
            bias: if self.with_gravity { GRAVITY } else { 0.0 },
            ..Pickup::white(sigma)
        };
        let pickup = pickup.checked().context("sensor")?;
        let digitiser = Digitiser::new(self.step.map(|step| step / sigma), None).map_err(|_| {
            anyhow!(
                "step must lie in [1e-9, 1e9] times sigma, got {} (leave it out for no steps)",
                self.step.unwrap_or_default()
            )
        })?;
        Ok(Pickup {
            digitiser,
            ..pickup
        })
    }
}
