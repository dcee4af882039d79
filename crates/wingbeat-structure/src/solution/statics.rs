//! Equilibrium under loads and steady motion of the frame.

use wingbeat_math::larger;

use crate::error::StructureError;
use crate::nodes::configuration::{Configuration, NODE};
use crate::nodes::frame::FrameMotion;
use crate::nodes::inertia::{self, Motion};
use crate::nodes::loads::Loading;
use crate::solution::assembly::Assembly;
use crate::solution::dynamics::{inertial, size};
use crate::structure::{HELD, Structure};

/// How an equilibrium is sought.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StaticSettings {
    /// Parts in which load and motion are applied; halved by itself where Newton's iteration fails.
    pub steps: usize,
    /// Largest last change \[1\]: rotation \[rad\], translation over the size of the body.
    pub tolerance: f64,
    /// Most passes of Newton's iteration for a part of the load.
    pub max_passes: usize,
}

impl Default for StaticSettings {
    fn default() -> Self {
        Self {
            steps: 1,
            tolerance: 1e-10,
            max_passes: 30,
        }
    }
}

/// Largest change \[1\] in one pass: larger ones are scaled down.
const MAX_CHANGE: f64 = 1.0;

/// Corrections beyond this stretch what hardly stretches: the next tangent has the stresses that were foreseen \[1\].
const ROUGH: f64 = 1e-3;

/// Smallest part of the load that is tried.
const MIN_PART: f64 = 1e-4;

/// Equilibrium in a frame that moves steadily, starting from `start`; load and motion grow in parts. Returns the
/// configuration.
///
/// # Errors
/// [`StructureError::NotConverged`] and [`StructureError::Singular`], for the smallest part of the load that was tried.
pub fn equilibrium(
    structure: &Structure,
    start: &Configuration,
    frame: &FrameMotion,
    loads: &(impl Loading + ?Sized),
    settings: &StaticSettings,
) -> Result<Configuration, StructureError> {
    let mut scratch = Scratch::new(structure);
    let mut at = start.clone();
    let (mut part, mut step) = (0.0, 1.0 / settings.steps.max(1) as f64);
    while part < 1.0 {
        let next = if part + step > 1.0 - 1e-9 {
            1.0
        } else {
            part + step
        };
        let mut trial = at.clone();
        let problem = Problem {
            structure,
            frame: partial(frame, next),
            loads,
            part: next,
        };
        match newton(&problem, &mut trial, &mut scratch, settings) {
            Ok(()) => (at, part) = (trial, next),
            Err(error) if step < 2.0 * MIN_PART => return Err(error),
            Err(_) => step *= 0.5,
        }
    }
    Ok(at)
}

/// What is to be solved for one part of the load.
struct Problem<'a, L: ?Sized> {
    structure: &'a Structure,
    frame: FrameMotion,
    loads: &'a L,
    part: f64,
}

struct Scratch {
    assembly: Assembly,
    residual: Vec<f64>,
    change: Vec<f64>,
    all: Vec<f64>,
    still: Vec<f64>,
    /// Where the last correction `all` began, and whether stresses are foreseen from there.
    before: Configuration,
    looks_ahead: bool,
}

impl Scratch {
    fn new(structure: &Structure) -> Self {
        let zero = vec![0.0; NODE * structure.nodes()];
        Self {
            assembly: Assembly::new(structure),
            residual: zero.clone(),
            change: vec![0.0; structure.unknowns()],
            all: zero.clone(),
            still: zero,
            before: structure.rest().clone(),
            looks_ahead: false,
        }
    }
}

/// A frame whose inertial forces are a part of those of another.
fn partial(frame: &FrameMotion, part: f64) -> FrameMotion {
    FrameMotion {
        acceleration: part * frame.acceleration,
        w: part.sqrt() * frame.w,
        w_dot: part * frame.w_dot,
    }
}

fn newton<L: Loading + ?Sized>(
    p: &Problem<'_, L>,
    at: &mut Configuration,
    s: &mut Scratch,
    settings: &StaticSettings,
) -> Result<(), StructureError> {
    let (mut change, mut residual) = (f64::INFINITY, f64::INFINITY);
    s.looks_ahead = false;
    for _ in 0..settings.max_passes {
        residual = unbalanced(p, at, s);
        tangent(p, at, s)?;
        change = correct(p.structure, at, s);
        if change <= settings.tolerance {
            return Ok(());
        }
        s.looks_ahead = change > ROUGH;
        if !change.is_finite() {
            break;
        }
    }
    Err(StructureError::NotConverged {
        what: "Newton's iteration for an equilibrium",
        passes: settings.max_passes,
        change,
        tolerance: settings.tolerance,
        residual,
        remedy: "apply the load in more steps, or look whether the body buckles under it",
    })
}

/// Fills the residual; returns its largest free entry.
fn unbalanced<L: Loading + ?Sized>(p: &Problem<'_, L>, at: &Configuration, s: &mut Scratch) -> f64 {
    s.residual.fill(0.0);
    p.loads.add(at, &mut s.residual);
    s.residual.iter_mut().for_each(|r| *r *= -p.part);
    s.assembly
        .internal(p.structure, at, &s.still, &mut s.residual);
    let motion = Motion {
        at,
        velocity: &s.still,
        acceleration: &s.still,
    };
    inertial(p.structure, &motion, &p.frame, &mut s.residual);
    let free = p.structure.number.iter().map(|&k| s.residual[k].abs());
    free.fold(0.0, larger)
}

/// Assembles and factorises the tangent.
fn tangent<L: Loading + ?Sized>(
    p: &Problem<'_, L>,
    at: &Configuration,
    s: &mut Scratch,
) -> Result<(), StructureError> {
    s.assembly.matrix.clear(false);
    let ahead = s.looks_ahead.then_some((&s.before, &s.all[..]));
    steady_tangent(p.structure, (at, ahead), &p.frame, &mut s.assembly);
    for n in 0..p.structure.nodes() {
        if let Some(block) = p.loads.tangent(at, n) {
            let less = block.map(|row| row.map(|k| -p.part * k));
            s.assembly.add(p.structure, [n, n], &less);
        }
    }
    s.assembly.factor(p.structure)
}

/// Adds the derivative of internal and inertial forces by the configuration, nothing moving relative to the
/// frame; stresses may be foreseen ([`crate::Element::tangent_ahead`]).
pub(crate) fn steady_tangent(
    structure: &Structure,
    (at, ahead): (&Configuration, Option<(&Configuration, &[f64])>),
    frame: &FrameMotion,
    assembly: &mut Assembly,
) {
    let unit = |_: usize| wingbeat_math::DMat3::IDENTITY;
    assembly.tangent(structure, (at, ahead), None, &unit);
    for (n, m) in structure.masses.iter().enumerate() {
        let t = inertia::tangents(m, frame, &inertia::NodeMotion::still(at, n));
        assembly.add(structure, [n, n], &t.position);
    }
    for m in &structure.between {
        let [a, b] = m.nodes.map(|n| inertia::NodeMotion::still(at, n));
        let node = inertia::NodeMotion::between(&a, &b);
        let point = m.point();
        let t = inertia::tangents(&point, frame, &node);
        assembly.add_between(structure, m.nodes, &t.position);
    }
}

/// One correction; returns its size before it was limited.
fn correct(structure: &Structure, at: &mut Configuration, s: &mut Scratch) -> f64 {
    for (x, &k) in s.change.iter_mut().zip(&structure.number) {
        *x = -s.residual[k];
    }
    s.assembly.matrix.solve(&mut s.change);
    for (k, x) in s.all.iter_mut().enumerate() {
        let u = structure.unknown[k];
        *x = if u == HELD { 0.0 } else { s.change[u] };
    }
    let mut largest = 0.0_f64;
    for six in s.all.as_chunks::<NODE>().0 {
        largest = larger(largest, size(six, structure.size()));
    }
    let limit = if largest > MAX_CHANGE {
        MAX_CHANGE / largest
    } else {
        1.0
    };
    s.all.iter_mut().for_each(|x| *x *= limit);
    s.before.clone_from(at);
    at.moved(&s.all);
    largest
}
