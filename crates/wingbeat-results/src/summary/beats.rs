//! Means over wingbeats: the one definition that summary, figures, page and comparison use.
//!
//! A mean is the change of an integral over the beat, divided by its length: the impulse of the air
//! for forces, the work of actuators and deformation for power, the impulse of the vortices for the
//! lift by impulse. The integrals are in every record, so a thinned history has the same means.

use serde::{Deserialize, Serialize};
use wingbeat_flight::{AirModel, FlightSetup, Record};
use wingbeat_math::DVec3;

use super::per_beat::PerBeat;

/// What means are made from: integrals over time from the start to a step, see [`Record`].
#[derive(Clone, Copy, Debug, Serialize, Deserialize)]
pub(super) struct Integrals {
    pub step: usize,
    /// Time \[s\].
    pub time: f64,
    air_impulse: DVec3,
    dynamic_impulse: f64,
    driving_work: f64,
    positive_work: f64,
    inviscid_impulse: DVec3,
    vortex_impulse: DVec3,
}

impl From<&Record> for Integrals {
    fn from(r: &Record) -> Self {
        Self {
            step: r.step,
            time: r.time,
            air_impulse: r.air_impulse,
            dynamic_impulse: r.dynamic_impulse,
            driving_work: r.driving_work(),
            positive_work: r.positive_work,
            inviscid_impulse: r.inviscid_impulse,
            vortex_impulse: r.vortex_impulse,
        }
    }
}

/// Means over one wingbeat.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct BeatMeans {
    /// Number of the beat, from 1.
    pub beat: usize,
    /// The means.
    #[serde(flatten)]
    pub mean: PerBeat,
}

impl BeatMeans {
    /// The means from one step to another; `beat` is their number.
    pub(super) fn between(setup: &FlightSetup, beat: usize, [from, to]: [&Integrals; 2]) -> Self {
        let period = to.time - from.time;
        let mean = |impulse: DVec3| impulse / period;
        let force = mean(to.air_impulse - from.air_impulse);
        let lift_newton = -force.dot(down(setup));
        let dynamic = (to.dynamic_impulse - from.dynamic_impulse) / period;
        let coefficient = |force: f64| (dynamic > 0.0).then(|| force / dynamic);
        let has_lattice = matches!(setup.air, AirModel::VortexLattice(_));
        let of_lattice = |impulse: DVec3| has_lattice.then(|| mean(impulse).dot(down(setup)));
        let mean = PerBeat {
            lift_newton,
            lift_over_weight: over_weight(setup, lift_newton),
            thrust_newton: force.x,
            side_force_newton: force.y,
            power_watt: (to.driving_work - from.driving_work) / period,
            positive_power_watt: (to.positive_work - from.positive_work) / period,
            lift_coefficient: coefficient(lift_newton),
            thrust_coefficient: coefficient(force.x),
            inviscid_lift_newton: of_lattice(from.inviscid_impulse - to.inviscid_impulse),
            lift_by_impulse_newton: of_lattice(to.vortex_impulse - from.vortex_impulse),
        };
        Self { beat, mean }
    }
}

/// Unit vector along gravity; n3 without gravity.
pub fn down(setup: &FlightSetup) -> DVec3 {
    setup.gravity.try_normalize().unwrap_or(DVec3::Z)
}

/// A force over the weight of the animal; none without gravity.
pub fn over_weight(setup: &FlightSetup, force: f64) -> Option<f64> {
    let weight = setup.animal.mass() * setup.gravity.length();
    (weight > 0.0).then(|| force / weight)
}

/// Gathers whole wingbeats, record by record.
pub struct Beats<'a> {
    setup: &'a FlightSetup,
    steps: Option<usize>,
    start: Option<Integrals>,
}

impl<'a> Beats<'a> {
    /// For the flight of `setup`.
    pub fn new(setup: &'a FlightSetup) -> Self {
        Self {
            setup,
            steps: setup.time.steps_per_beat(),
            start: None,
        }
    }

    /// Takes the next record; the means of the beat that ends with it.
    pub fn take(&mut self, record: &Record) -> Option<BeatMeans> {
        let steps = self.steps?;
        if !record.step.is_multiple_of(steps) {
            return None;
        }
        let end = Integrals::from(record);
        let start = self.start.replace(end)?;
        let beat = record.step / steps;
        Some(BeatMeans::between(self.setup, beat, [&start, &end]))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use wingbeat_case::LoadedCase;
    use wingbeat_dynamics::Wrench;
    use wingbeat_flight::record::Integral;

    /// Lift m g cos^2 x has the mean m g / 2, to which the trapezoidal rule is exact; work that grows
    /// by 3 J a step and impulses that change by 3 N s and 4 N s a step are 3 W, 3 N and 4 N over steps of 1 s.
    #[test]
    fn exact_means_of_a_period_from_all_rows_and_from_few() {
        let case = LoadedCase::find("fruit-fly-hover", &[]).unwrap();
        let mut setup = case.setup;
        setup.time = wingbeat_flight::TimeGrid {
            step: 1.0,
            steps: 20,
            period: Some(8.0),
        };
        let weight = setup.animal.mass() * setup.gravity.length();
        let mut impulse = Integral::default();
        let record = |k: usize| {
            let x = k as f64 * std::f64::consts::FRAC_PI_4;
            let force = DVec3::new(1.0, 0.0, -weight * x.cos().powi(2));
            Record {
                step: k,
                time: k as f64,
                hinge_work: 3.0 * k as f64,
                positive_work: 5.0 * k as f64,
                dynamic_impulse: 2.0 * k as f64,
                vortex_impulse: DVec3::new(0.0, 0.0, 3.0 * k as f64),
                inviscid_impulse: DVec3::new(0.0, 0.0, -4.0 * k as f64),
                air: vec![Wrench {
                    force,
                    moment: DVec3::ZERO,
                }],
                ..Record::default()
            }
        };
        let mut records: Vec<Record> = (0..=20).map(record).collect();
        for r in &mut records {
            r.air_impulse = impulse.count(r.time, r.air_force());
        }
        let means = |every: usize| -> Vec<BeatMeans> {
            let mut beats = Beats::new(&setup);
            let rows = records.iter().filter(|r| r.step % every == 0);
            rows.filter_map(|r| beats.take(r)).collect()
        };
        assert_eq!(means(1).len(), 2);
        assert_eq!(means(1), means(4));
        for beat in means(1).into_iter().map(|b| b.mean) {
            let lift = beat.lift_over_weight.unwrap();
            assert!((lift - 0.5).abs() < 1e-14, "{lift}"); // some roundings
            assert!((beat.thrust_newton - 1.0).abs() < 1e-14);
            assert_eq!(beat.power_watt, 3.0);
            assert_eq!(beat.positive_power_watt, 5.0);
            assert_eq!(beat.lift_coefficient, Some(beat.lift_newton / 2.0));
            assert_eq!(beat.thrust_coefficient, Some(beat.thrust_newton / 2.0));
            assert_eq!(beat.lift_by_impulse_newton, Some(3.0));
            assert_eq!(beat.inviscid_lift_newton, Some(4.0));
        }
    }
}
