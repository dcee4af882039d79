//! A fly's wing whose pitch is left to an elastic hinge: stroke as measured, feathering predicted.

use std::path::Path;

use crate::lab::hinged::{Air, Flown};
use crate::lab::series::{harmonic, mean};
use crate::{Case, Comparison, Part, Row, VerifyError};

pub(super) const CASES: &[Case] = &[Case {
    name: "fruit-fly-hinge",
    about: "A fruit fly's wing that strokes as measured and whose pitch is left to the spring and damper of Bergou et al. 2010, \
                upright at rest: feathering predicted beside the measured one.",
    part: Part::Experiments,
    quick: false,
    run: fruit_fly,
}];

const FRY: &str = "Fry, Sayaman & Dickinson 2005, hovering fruit flies";
const BERGOU: &str = "5.21e-9 N m/rad, 2.2e-12 N m s/rad; where the axis of the hinge lies along the chord is not given";

/// Spring and damper of Bergou et al. 2010, upright at rest.
const HINGE: &str = "
[wing.right.motion]
psi.constant_deg = 0

[joint.hinge-right]
child = \"right\"
kind = \"revolute\"
axis = [0, 1, 0]

[[joint.hinge-right.element]]
stiffness_newton_m_per_rad = 5.21e-9
damping_newton_m_s_per_rad = 2.2e-12
";

/// Feathering of the fly's wing over a beat [deg], both its ends.
fn feathering(
    (air, hinge): (Air, &str),
    axis: f64,
    [steps, beats]: [usize; 2],
) -> Result<Vec<f64>, VerifyError> {
    let text = include_str!("../../data/fruit_fly_wing.toml");
    let set = [
        format!("wing.right.planform.beta.axis_fraction={axis}"),
        format!("time.steps_per_beat={steps}"),
        format!("time.beats={beats}"),
    ];
    let text = [text, hinge, air.fruit_fly()].concat();
    Ok(Flown::new("fruit-fly-wing", &text, Path::new(""), &set)?.last_beat())
}

fn fruit_fly(_quick: bool) -> Result<Vec<Row>, VerifyError> {
    const POINTS: usize = 40;
    let measured = feathering((Air::Blade, ""), 0.25, [POINTS, 2])?;
    let mut rows = vec![];
    for (model, air, steps, beats) in [
        ("blade elements", Air::Blade, 200, 6),
        ("lattice", Air::Lattice, 80, 3),
    ] {
        for (place, axis) in [("a quarter chord", 0.25), ("the leading edge", 0.0)] {
            let flown = feathering((air, HINGE), axis, [steps, beats])?;
            let own: Vec<f64> = flown.iter().step_by(steps / POINTS).copied().collect();
            let name = match axis > 0.0 {
                true => [model, "hinge at a quarter chord"].join(", "),
                false => [model, "hinge at the leading edge"].join(", "),
            };
            rows.extend(beside(
                &format!("{model}, hinge at {place}"),
                name,
                &own,
                &measured,
            ));
        }
    }
    Ok(rows)
}

/// Error over the beat, first harmonic and mean.
fn beside(what: &str, name: String, own: &[f64], measured: &[f64]) -> Vec<Row> {
    let points = own.len() - 1;
    let drawn = Comparison {
        name: name.into(),
        ..Comparison::over_a_beat("feathering [deg]", "", own, &measured[..points])
    };
    let first = |x: &[f64]| {
        let [a, b] = harmonic(x, points, 1);
        [a.hypot(b), b.atan2(a).to_degrees()]
    };
    let ([size, phase], [size_0, phase_0]) = (first(own), first(measured));
    vec![
        Row::new(
            format!("{what}: rms error of feathering"),
            "deg",
            drawn.rms_error(),
        )
        .against(0.0, FRY)
        .because(BERGOU)
        .drawn(drawn),
        Row::new(format!("{what}: first harmonic"), "deg", size).against(size_0, FRY),
        Row::new(
            format!("{what}: how much later in the beat its first harmonic is"),
            "deg of the beat",
            phase - phase_0,
        ),
        Row::new(format!("{what}: mean"), "deg", mean(own)).against(mean(measured), FRY),
    ]
}
