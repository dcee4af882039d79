//! Motion and deformation of wings.

use wingbeat_math::DVec3;
use wingbeat_model::deformation::{MovingSurface, SpanLaw, Term};
use wingbeat_model::motion::Fourier;
use wingbeat_model::{AngleLaw, Animal, Deformation, Start, WingMotion};

use super::refusal::{Written, no_keys};
use crate::raw::{
    AngleCase, BendingCase, CamberCase, CourseCase, DeformationCase, FourierCase, MotionCase,
    OvalCase, ShapedCase, SplitCycleCase, StartCase, SurfaceCase, TableCase, TwistCase,
    WingMotionCase,
};

/// What all wings share: frequency and start.
pub(super) fn shared(animal: &Animal) -> Written<MotionCase> {
    let Some(first) = animal.wings.first() else {
        return Ok(MotionCase {
            frequency_hz: 0.0.into(),
            ..MotionCase::default()
        });
    };
    let (frequency, begin) = (first.motion.frequency, first.motion.start);
    let alike = |m: &WingMotion| m.frequency == frequency && m.start == begin;
    if let Some(wing) = animal.wings.iter().find(|w| !alike(&w.motion)) {
        let problem = format!(
            "wing `{}` has another frequency or start than the first wing",
            wing.name
        );
        let remedy = "give all wings one frequency and one start";
        return Err(no_keys("motion of the wings", problem, remedy));
    }
    let (start, start_beats) = match begin {
        Start::Smooth { duration } if frequency > 0.0 => (StartCase::Smooth, duration * frequency),
        _ => (StartCase::Impulsive, MotionCase::default().start_beats),
    };
    Ok(MotionCase {
        frequency_hz: frequency.into(),
        start,
        start_beats,
        ..MotionCase::default()
    })
}

/// What each wing has of its own.
pub(super) fn own(motion: &WingMotion) -> WingMotionCase {
    let WingMotion {
        angles,
        frequency: _, // shared
        phase,
        stroke_plane_pitch,
        start: _, // shared
    } = motion;
    WingMotionCase {
        data: None,
        phi: Some(angle(&angles.phi)),
        theta: Some(angle(&angles.theta)),
        psi: Some(angle(&angles.psi)),
        stroke_plane_pitch_deg: Some(stroke_plane_pitch.to_degrees()),
        phase: Some(*phase),
    }
}

fn angle(law: &AngleLaw) -> AngleCase {
    let degrees = |list: &[f64]| list.iter().map(|a| a.to_degrees()).collect();
    let shaped = |[amplitude, shape, shift, mean]: [f64; 4]| ShapedCase {
        amplitude_deg: amplitude.to_degrees(),
        shape,
        shift_deg: shift.to_degrees(),
        mean_deg: mean.to_degrees(),
    };
    match law {
        AngleLaw::Constant(q) => AngleCase::ConstantDeg(q.to_degrees()),
        AngleLaw::Fourier(f) => AngleCase::Fourier(FourierCase {
            mean_deg: f.mean.to_degrees(),
            cosine_deg: degrees(&f.cos),
            sine_deg: degrees(&f.sin),
        }),
        AngleLaw::SmoothTriangle(s) => {
            AngleCase::SmoothTriangle(shaped([s.amplitude, s.shape, s.shift, s.mean]))
        }
        AngleLaw::SmoothSquare(s) => {
            AngleCase::SmoothSquare(shaped([s.amplitude, s.shape, s.shift, s.mean]))
        }
        AngleLaw::Oval(o) => AngleCase::Oval(OvalCase {
            amplitude_deg: o.amplitude.to_degrees(),
            count: o.count,
            shift_deg: o.shift.to_degrees(),
            mean_deg: o.mean.to_degrees(),
        }),
        AngleLaw::SplitCycle(s) => AngleCase::SplitCycle(SplitCycleCase {
            amplitude_deg: s.amplitude.to_degrees(),
            first_share: s.first_share,
            shift_deg: s.shift.to_degrees(),
            mean_deg: s.mean.to_degrees(),
        }),
        AngleLaw::Table(spline) => {
            let row = |(x, q): (f64, f64)| [x, q.to_degrees()];
            AngleCase::Table(TableCase {
                rows_deg: Some(spline.rows().map(row).collect()),
                ..TableCase::default()
            })
        }
    }
}

/// A prescribed deformation.
pub(super) fn deformation(deformation: &Deformation) -> DeformationCase {
    let Deformation {
        axis_fraction,
        camber_peak,
        twist,
        camber,
        bending,
        surface,
    } = deformation;
    let turned = |term: &Term| span(&term.span, f64::to_degrees);
    let plain = |term: &Term| span(&term.span, |x| x);
    let twists = twist.iter().map(|term| {
        let (linear_deg, table_deg) = turned(term);
        TwistCase {
            linear_deg,
            table_deg,
            fourier: Some(course(&term.time)),
        }
    });
    let cambers = camber.iter().map(|term| {
        let (linear, table) = plain(term);
        CamberCase {
            linear,
            table,
            fourier: Some(course(&term.time)),
        }
    });
    let bendings = bending.iter().map(|term| {
        let (linear_m, table_m) = plain(term);
        BendingCase {
            linear_m,
            table_m,
            fourier: Some(course(&term.time)),
        }
    });
    DeformationCase {
        axis_fraction: *axis_fraction,
        camber_peak: *camber_peak,
        twist: twists.collect(),
        camber: cambers.collect(),
        bending: bendings.collect(),
        surface: surface.as_ref().map(measured),
    }
}

fn measured(surface: &MovingSurface) -> SurfaceCase {
    let row = |row: &Vec<DVec3>| row.iter().map(|x| x.to_array()).collect();
    let at = |rows: &Vec<Vec<DVec3>>| rows.iter().map(row).collect();
    SurfaceCase {
        phases: surface.phases.clone(),
        nodes_m: surface.places.iter().map(at).collect(),
        harmonics: surface.harmonics,
    }
}

type Span = (Option<[f64; 2]>, Option<Vec<[f64; 2]>>);

pub(super) fn span(law: &SpanLaw, unit: fn(f64) -> f64) -> Span {
    match law {
        SpanLaw::Linear { root, tip } => (Some([unit(*root), unit(*tip)]), None),
        SpanLaw::Table(rows) => {
            let rows = rows.iter().map(|&(r, v)| [r, unit(v)]).collect();
            (None, Some(rows))
        }
    }
}

fn course(time: &Fourier) -> CourseCase {
    CourseCase {
        mean: time.mean,
        cosine: time.cos.clone(),
        sine: time.sin.clone(),
    }
}
