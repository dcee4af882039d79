//! The quantities of which a wingbeat has a mean: the one list of them that summaries, ensembles, comparisons and
//! campaigns use.

use serde::{Deserialize, Serialize};

/// A number that results have under a name.
#[derive(Clone, Copy, Debug)]
pub struct SummaryQuantity<S, T = f64> {
    /// Its name in files and campaigns, with its unit.
    pub name: &'static str,
    /// Its unit, as units are written: `m s-1`.
    pub unit: &'static str,
    /// How a row of a comparison calls it, with its unit; none where comparisons leave it out.
    pub label: Option<&'static str>,
    /// What it is, in a sentence.
    pub about: &'static str,
    /// Takes it \[`unit`\]; none where it is not known.
    pub of: fn(&S) -> Option<T>,
}

/// A row of a table of them.
pub(super) const fn row<S, T>(
    name: &'static str,
    unit: &'static str,
    label: Option<&'static str>,
    about: &'static str,
    of: fn(&S) -> Option<T>,
) -> SummaryQuantity<S, T> {
    SummaryQuantity {
        name,
        unit,
        label,
        about,
        of,
    }
}

/// A `T` for each quantity of a wingbeat: a mean, or a mean with its error.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct PerBeat<T = f64> {
    /// Air force against gravity \[N\].
    pub lift_newton: T,
    /// The same over the weight; none without gravity \[1\].
    pub lift_over_weight: Option<T>,
    /// Air force along n1 (forward) \[N\].
    pub thrust_newton: T,
    /// Air force along n2 (to the right) \[N\].
    #[serde(default)]
    pub side_force_newton: T,
    /// Power that hinge actuators and prescribed deformation give \[W\].
    pub power_watt: T,
    /// The positive part of it, joint by joint: what actuators give that get nothing back when wings are slowed
    /// down \[W\].
    pub positive_power_watt: T,
    /// Mean lift over the mean dynamic pressure on the wings, `1/2 rho int U^2 dA`, U the velocity of the feathering
    /// axes through the undisturbed air \[1\]; none without wings that move through air of a known density.
    pub lift_coefficient: Option<T>,
    /// The same of the force along n1 \[1\].
    pub thrust_coefficient: Option<T>,
    /// Inviscid air force against gravity, with the suction that pressures lack, without friction \[N\]; none without
    /// a lattice.
    pub inviscid_lift_newton: Option<T>,
    /// The same by another way, the rate of the vortex impulse \[N\]. With vortex particles it depends on the origin.
    pub lift_by_impulse_newton: Option<T>,
}

impl<T: Copy> PerBeat<T> {
    /// All of them, as campaigns list and comparisons show them.
    #[rustfmt::skip]
    pub const QUANTITIES: [SummaryQuantity<Self, T>; 10] = [
        row("lift_over_weight", "1", Some("lift over weight"), "mean air force against gravity over the weight",
            |m| m.lift_over_weight),
        row("lift_newton", "N", Some("lift [N]"), "mean air force against gravity", |m| Some(m.lift_newton)),
        row("thrust_newton", "N", Some("forward force [N]"), "mean air force along n1, forward",
            |m| Some(m.thrust_newton)),
        row("side_force_newton", "N", None, "mean air force along n2, to the right", |m| Some(m.side_force_newton)),
        row("power_watt", "W", Some("power [W]"), "mean power of actuators and of prescribed deformation",
            |m| Some(m.power_watt)),
        row("positive_power_watt", "W", Some("positive power [W]"),
            "mean of its positive part, joint by joint: what actuators give that get nothing back",
            |m| Some(m.positive_power_watt)),
        row("lift_coefficient", "1", Some("lift coefficient [1]"),
            "mean air force against gravity over the mean dynamic pressure on the wings",
            |m| m.lift_coefficient),
        row("thrust_coefficient", "1", Some("thrust coefficient [1]"), "the same of the air force along n1",
            |m| m.thrust_coefficient),
        row("inviscid_lift_newton", "N", None,
            "mean inviscid air force against gravity; none without a lattice", |m| m.inviscid_lift_newton),
        row("lift_by_impulse_newton", "N", None,
            "the same by the rate of the vortex impulse; with vortex particles it depends on the origin",
            |m| m.lift_by_impulse_newton),
    ];

    /// Each quantity of `all`, one or more, as one: `of` its values in their order; none where one of them is none.
    pub fn joined<'a, U>(
        all: impl IntoIterator<Item = &'a Self>,
        of: impl Fn(&[T]) -> U,
    ) -> PerBeat<U>
    where
        T: 'a,
    {
        let all: Vec<&Self> = all.into_iter().collect();
        let each = |value: fn(&Self) -> T| of(&all.iter().map(|m| value(m)).collect::<Vec<T>>());
        let where_known = |value: fn(&Self) -> Option<T>| {
            let values: Option<Vec<T>> = all.iter().map(|m| value(m)).collect();
            values.map(|values| of(&values))
        };
        PerBeat {
            lift_newton: each(|m| m.lift_newton),
            lift_over_weight: where_known(|m| m.lift_over_weight),
            thrust_newton: each(|m| m.thrust_newton),
            side_force_newton: each(|m| m.side_force_newton),
            power_watt: each(|m| m.power_watt),
            positive_power_watt: each(|m| m.positive_power_watt),
            lift_coefficient: where_known(|m| m.lift_coefficient),
            thrust_coefficient: where_known(|m| m.thrust_coefficient),
            inviscid_lift_newton: where_known(|m| m.inviscid_lift_newton),
            lift_by_impulse_newton: where_known(|m| m.lift_by_impulse_newton),
        }
    }

    /// The quantities that comparisons show and both have, beside each other: label, this, the other.
    pub(super) fn beside(&self, other: &Self) -> Vec<(&'static str, T, T)> {
        let row = |q: SummaryQuantity<Self, T>| Some((q.label?, (q.of)(self)?, (q.of)(other)?));
        Self::QUANTITIES.into_iter().filter_map(row).collect()
    }
}

impl PerBeat {
    /// Magnitude of the mean force, however the flyer heads \[N\].
    pub(super) fn force(&self) -> f64 {
        force([self.lift_newton, self.thrust_newton, self.side_force_newton])
    }
}

/// Magnitude of a force of these parts: lift, along n1, along n2 \[N\].
pub(super) fn force([lift, along, across]: [f64; 3]) -> f64 {
    lift.hypot(along).hypot(across)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The table has the fields of the struct under their names, each with its own value.
    #[test]
    fn exact_the_table_takes_each_quantity_by_its_name() {
        let names: Vec<&str> = PerBeat::<f64>::QUANTITIES.iter().map(|q| q.name).collect();
        let numbered = (0..).map(f64::from);
        let fields: serde_json::Map<String, serde_json::Value> = (names.iter().zip(numbered))
            .map(|(n, k)| ((*n).to_owned(), k.into()))
            .collect();
        let means: PerBeat = serde_json::from_value(fields.into()).unwrap();
        for (k, q) in PerBeat::QUANTITIES.iter().enumerate() {
            assert_eq!((q.of)(&means), Some(k as f64), "{}", q.name);
        }
        let written = serde_json::to_value(means).unwrap();
        assert_eq!(written.as_object().unwrap().len(), names.len());
    }

    #[test]
    fn exact_a_quantity_that_one_lacks_is_none_of_both() {
        let means: PerBeat = PerBeat {
            lift_newton: 1.0,
            lift_over_weight: None,
            thrust_newton: 2.0,
            side_force_newton: 8.0,
            power_watt: 3.0,
            positive_power_watt: 4.0,
            lift_coefficient: Some(5.0),
            thrust_coefficient: Some(6.0),
            inviscid_lift_newton: Some(7.0),
            lift_by_impulse_newton: None,
        };
        let other = PerBeat {
            lift_coefficient: None,
            ..means
        };
        let sum = PerBeat::joined([&means, &other], |x| x.iter().sum::<f64>());
        assert_eq!([sum.lift_newton, sum.thrust_newton], [2.0, 4.0]);
        assert_eq!(sum.lift_coefficient, None);
        assert_eq!(sum.inviscid_lift_newton, Some(14.0));
        let labels: Vec<&str> = means.beside(&other).iter().map(|row| row.0).collect();
        assert_eq!(labels[..2], ["lift [N]", "forward force [N]"]);
        assert_eq!(labels.len(), 5);
    }
}
