//! `[motion]` and `[wing.NAME.motion]`: angle laws and shipped data sets.

use wingbeat_model::motion::{
    Adjustment, Fourier, Oval, PeriodicSpline, SmoothSquare, SmoothTriangle, SplitCycle,
};
use wingbeat_model::{AngleLaw, AngleLaws, Side, Start, WingMotion};

use crate::build::fault::Built;
use crate::error::Fault;
use crate::motion::carrier::rides_on_wing;
use crate::motion::own_motion::gives_angles;
use crate::raw::{
    AngleCase, Case, FourierCase, MotionCase, StartCase, TableCase, WingCase, WingMotionCase,
};
use crate::shipped::data::find_data;

/// The motion of `wing`, `name` in the case; what it leaves out is that of `base`, else that of `[motion]`. The axes of
/// a wing that moves with another one are those of its carrier: stroke plane and data set of `[motion]` are not its
/// own a second time.
pub(crate) fn law(
    case: &Case,
    name: &str,
    wing: &WingCase,
    side: Side,
    base: Option<&WingMotion>,
) -> Built<WingMotion> {
    let none = WingMotionCase::default();
    let own = wing.motion.as_ref().unwrap_or(&none);
    let path = format!("wing.{name}.motion");
    let frequency = case.motion.frequency_hz.value();
    let rides = rides_on_wing(case, name);
    let data = case.motion.data.as_deref().filter(|_| !rides);
    let laws = laws(data, &path, own, side, base.map(|b| &b.angles))?;
    let shared = match rides {
        true => 0.0,
        false => case.motion.stroke_plane_pitch_deg.value().to_radians(),
    };
    let pitch = own.stroke_plane_pitch_deg.map(f64::to_radians);
    if frequency == 0.0 && !laws.are_constant() {
        return Err(Fault::new(
            "motion.frequency_hz",
            "the wing angles vary over a beat, but there is no wingbeat frequency",
            "a finite number > 0",
            "add `frequency_hz = ...` to [motion]",
        ));
    }
    Ok(WingMotion {
        angles: laws,
        frequency,
        phase: (own.phase).unwrap_or(base.map_or(case.motion.phase, |b| b.phase)),
        stroke_plane_pitch: pitch.unwrap_or(base.map_or(shared, |b| b.stroke_plane_pitch)),
        start: start(case, frequency),
    })
}

/// The motion of a wing of this side with the adjustments of the case.
pub(crate) fn adjusted(case: &Case, motion: &WingMotion, side: Side) -> WingMotion {
    let MotionCase {
        adjust, difference, ..
    } = &case.motion;
    let by = Adjustment::from(adjust).on(side, &Adjustment::from(difference));
    motion.adjusted(side, &by)
}

fn start(case: &Case, frequency: f64) -> Start {
    match case.motion.start {
        StartCase::Smooth if frequency > 0.0 => Start::Smooth {
            duration: case.motion.start_beats / frequency,
        },
        _ => Start::Impulsive,
    }
}

/// Refuses angles that stand still where only the wing on the other side has any; `has_data`: what is
/// left out comes from the data set of `[motion]`.
pub(crate) fn check_halves(
    has_data: bool,
    (name, own): (&str, &WingMotionCase),
    (other, counterpart): (&str, &WingMotionCase),
) -> Built<()> {
    if !gives_angles(own) || own.data.is_some() || has_data {
        return Ok(());
    }
    let angles = [
        ("phi", &own.phi, &counterpart.phi),
        ("theta", &own.theta, &counterpart.theta),
        ("psi", &own.psi, &counterpart.psi),
    ];
    // A set has all three angles; a deviation of 0 beside it is common.
    let measured = counterpart.data.is_some();
    let still = (angles.into_iter())
        .find(|(key, a, b)| a.is_none() && (measured && *key != "theta" || b.is_some()));
    let Some((key, _, _)) = still else {
        return Ok(());
    };
    let from = match measured {
        true => format!("give wing.{name}.motion.data as that of wing.{other}"),
        false => format!("copy wing.{other}.motion.{key} with the signs of this side"),
    };
    Err(Fault::new(
        format!("wing.{name}.motion.{key}"),
        format!("this angle would stand still at 0, while that of wing `{other}` is given"),
        "an angle of its own beside others of its own; a wing that gives none has those of the other side",
        format!("{from}, or give {{ constant_deg = 0 }}"),
    ))
}

/// `data`: the set of `[motion]`, for wings that have it.
fn laws(
    data: Option<&str>,
    path: &str,
    own: &WingMotionCase,
    side: Side,
    base: Option<&AngleLaws>,
) -> Built<AngleLaws> {
    let shared = data.map(|n| ("motion.data".to_owned(), n));
    let data = own
        .data
        .as_deref()
        .map(|n| (format!("{path}.data"), n))
        .or(shared);
    let base = match (base.filter(|_| own.data.is_none()), data) {
        (Some(base), _) => base.clone(),
        (None, Some((key, name))) => {
            let right = find_data(&key, name)?.right;
            if side == Side::Right {
                right
            } else {
                right.mirrored()
            }
        }
        (None, None) => {
            let [phi, theta, psi] = [0.0; 3].map(AngleLaw::Constant);
            AngleLaws { phi, theta, psi }
        }
    };
    let angle = |key: &str, own: &Option<AngleCase>, base: AngleLaw| match own {
        Some(case) => angle_law(&format!("{path}.{key}"), case),
        None => Ok(base),
    };
    Ok(AngleLaws {
        phi: angle("phi", &own.phi, base.phi)?,
        theta: angle("theta", &own.theta, base.theta)?,
        psi: angle("psi", &own.psi, base.psi)?,
    })
}

fn angle_law(path: &str, case: &AngleCase) -> Built<AngleLaw> {
    Ok(match case {
        AngleCase::ConstantDeg(q) => AngleLaw::Constant(q.to_radians()),
        AngleCase::Fourier(f) => AngleLaw::Fourier(fourier(f)),
        AngleCase::SmoothTriangle(s) => {
            if !(0.0..1.0).contains(&s.shape) {
                return Err(Fault::new(
                    format!("{path}.smooth_triangle.shape"),
                    "the shape of a smooth triangle is out of range",
                    "[0, 1): 0 is a sine, towards 1 a triangle wave",
                    "0.99 is a triangle with rounded corners",
                ));
            }
            AngleLaw::SmoothTriangle(SmoothTriangle {
                amplitude: s.amplitude_deg.to_radians(),
                shape: s.shape,
                shift: s.shift_deg.to_radians(),
                mean: s.mean_deg.to_radians(),
            })
        }
        AngleCase::SmoothSquare(s) => AngleLaw::SmoothSquare(SmoothSquare {
            amplitude: s.amplitude_deg.to_radians(),
            shape: s.shape,
            shift: s.shift_deg.to_radians(),
            mean: s.mean_deg.to_radians(),
        }),
        AngleCase::Oval(o) => AngleLaw::Oval(Oval {
            amplitude: o.amplitude_deg.to_radians(),
            count: o.count,
            shift: o.shift_deg.to_radians(),
            mean: o.mean_deg.to_radians(),
        }),
        AngleCase::SplitCycle(s) => AngleLaw::SplitCycle(SplitCycle {
            amplitude: s.amplitude_deg.to_radians(),
            first_share: s.first_share,
            shift: s.shift_deg.to_radians(),
            mean: s.mean_deg.to_radians(),
        }),
        AngleCase::Table(t) => table(&format!("{path}.table"), t)?,
    })
}

fn fourier(case: &FourierCase) -> Fourier {
    let radians = |list: &[f64]| list.iter().map(|a| a.to_radians()).collect();
    Fourier {
        mean: case.mean_deg.to_radians(),
        cos: radians(&case.cosine_deg),
        sin: radians(&case.sine_deg),
    }
}

fn table(path: &str, table: &TableCase) -> Built<AngleLaw> {
    let Some(rows) = &table.rows_deg else {
        return Err(Fault::new(
            path,
            "the table has no rows",
            "rows_deg = [[phase, angle], ...] or file = \"NAME.csv\"",
            "add one of them",
        ));
    };
    let radians = radians(rows);
    let law = match table.harmonics {
        None => PeriodicSpline::new("the table", &radians).map(AngleLaw::Table),
        Some(n) => Fourier::fitted("the table", &radians, n).map(|fit| AngleLaw::Fourier(fit.0)),
    };
    law.map_err(|e| {
        let row = match &e {
            wingbeat_model::ModelError::Table { row, .. } if (1..=rows.len()).contains(row) => {
                format!("[{}]", row - 1)
            }
            _ => String::new(),
        };
        let [allowed, remedy] = match table.harmonics {
            None => [
                "at least 4 rows [phase, angle], phases rising, the last row one beat after the first with the same angle",
                "repeat the first angle in a last row whose phase is 1 larger; measured samples, of one beat or several, are fitted by `harmonics = 4` or so; where the first column has times, give beats_per_unit",
            ],
            Some(_) => [
                "at least 4 rows [phase, angle], phases in wingbeats that do not fall, neighbours within a beat less than 1 / (2 harmonics) apart",
                "give beats_per_unit where these are times; give more samples, or fewer harmonics",
            ],
        };
        Fault::new(format!("{path}.rows_deg{row}"), e.to_string(), allowed, remedy)
    })
}

/// Rows of a table in radians.
pub(crate) fn radians(rows: &[[f64; 2]]) -> Vec<(f64, f64)> {
    rows.iter().map(|&[x, q]| (x, q.to_radians())).collect()
}
