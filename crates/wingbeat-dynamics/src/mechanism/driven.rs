//! Loops that leave nothing free: what their joints do follows from the laws of the others, as a function of
//! time. Such a mechanism is a tree of prescribed joints, and flies in the momentum form.
//!
//! The loops are closed time after time, each from where it was just before ([`Closing`]); the motion of every
//! child against its parent becomes the law of the joint between them. Joints off the loops stay what they are.

mod closing;

use std::sync::Arc;

use wingbeat_math::{DVec3, MovingRotation, RotationLaw};

use self::closing::{Closing, Relative};
use crate::system::joint::Joint;
use crate::system::joint_model::{JointModel, JointType, TravelLaw};
use crate::{DynamicsError, System};

/// Times at which loops are closed over the whole table at least, so that each is near the last.
const MIN_TIMES: usize = 128;

/// Values at the times 0, `step`, 2 `step`, ... \[s\], asked for at these times alone.
#[derive(Clone, Debug)]
struct Table<T> {
    step: f64,
    values: Vec<T>,
}

impl<T: Copy> Table<T> {
    fn value(&self, t: f64) -> T {
        let k = (t / self.step).round();
        let off = (t - k * self.step).abs();
        assert!(
            off <= 8.0 * f64::EPSILON * t.abs().max(self.step),
            "loops are closed at multiples of {} s, asked at {t} s",
            self.step
        );
        self.values[k as usize]
    }
}

impl RotationLaw for Table<MovingRotation> {
    fn at(&self, t: f64) -> MovingRotation {
        self.value(t)
    }
}

impl TravelLaw for Table<[DVec3; 3]> {
    fn at(&self, t: f64) -> [DVec3; 3] {
        self.value(t)
    }
}

/// The system without loops whose joints on loops do at the times 0, `step`, ..., `count step` \[s\] what the
/// loops make them do; it is not to be asked at other times. A system without loops is returned as it is.
///
/// # Errors
/// [`DynamicsError::LooseLoop`] names a loop that leaves something free;
/// [`DynamicsError::SingularPosition`] one that comes near a position in which its motion is not determined;
/// [`DynamicsError::NotAssembled`] and others where it cannot be closed.
pub fn driven(system: System, step: f64, count: usize) -> Result<System, DynamicsError> {
    if system.loops().is_empty() {
        return Ok(system);
    }
    if system.loops().iter().any(|l| l.parent.is_none()) {
        system.refuse_loops("momentum")?; // a root on the ground is not free
    }
    let on_loops = on_loops(&system);
    let laws = closed_positions(&system, &on_loops, (step, count))?;
    let joint = |(h, laws): (&Joint, &Vec<Relative>)| match laws.is_empty() {
        true => h.clone(),
        false => prescribed(h, laws, step),
    };
    System::new(
        system.bodies().to_vec(),
        system.hinges().iter().zip(&laws).map(joint).collect(),
        system.gravity(),
        system.units(),
    )
}

/// A joint whose motion is a law: springs and actuators along it decide on nothing any more.
fn prescribed(joint: &Joint, laws: &[Relative], step: f64) -> Joint {
    let travel: Arc<dyn TravelLaw> = Arc::new(Table {
        step,
        values: laws.iter().map(|l| l.1).collect(),
    });
    let travel = match joint.model.kind {
        JointType::Prismatic { .. } => Some(travel),
        _ => joint.model.travel.clone(),
    };
    Joint {
        law: Some(Arc::new(Table {
            step,
            values: laws.iter().map(|l| l.0).collect(),
        })),
        model: JointModel {
            travel,
            ..JointModel::new(JointType::Weld)
        },
        ..joint.clone()
    }
}

/// Which hinges lie on a loop: those on the way from one end of a closing joint to the other.
fn on_loops(system: &System) -> Vec<bool> {
    let mut on = vec![false; system.hinges().len()];
    for joint in system.loops() {
        let ends = [
            joint.parent.expect("loops of the ground are refused"),
            joint.child,
        ];
        for (k, lies) in on.iter_mut().enumerate() {
            let [a, b] = ends.map(|body| system.behind(k)[body]);
            *lies |= a != b;
        }
    }
    on
}

/// The relative motions of the hinges on loops at all times; none for the others.
fn closed_positions(
    system: &System,
    on_loops: &[bool],
    (step, count): (f64, usize),
) -> Result<Vec<Vec<Relative>>, DynamicsError> {
    let held = held(system, on_loops)?;
    let mut closing = Closing::new(&held)?;
    let between = MIN_TIMES.div_ceil(count.max(1));
    let duration = step / between as f64;
    let mut laws = vec![vec![]; on_loops.len()];
    for k in 0..=count * between {
        let t = (k / between) as f64 * step + (k % between) as f64 * duration;
        closing.close(t, if k == 0 { 0.0 } else { duration })?;
        if k.is_multiple_of(between) {
            let on = laws.iter_mut().enumerate().filter(|(k, _)| on_loops[*k]);
            on.for_each(|(k, laws)| laws.push(closing.relative(t, k)));
        }
    }
    Ok(laws)
}

/// The system with the joints off the loops welded and nothing acting at the others.
fn held(system: &System, on_loops: &[bool]) -> Result<System, DynamicsError> {
    let mut held = system.clone();
    for (k, joint) in system.joints().enumerate() {
        let kind = match on_loops[k] {
            true => joint.kind,
            false => JointType::Weld,
        };
        let joint = JointModel {
            kind,
            elements: vec![],
            ..joint.clone()
        };
        held = held.with_joint(k, joint)?;
    }
    Ok(held)
}
