//! The hot loop allocates nothing: a counting allocator watches right-hand sides and steps.
#![allow(unsafe_code)] // an allocator is unsafe by its trait

mod common;

use std::alloc::{GlobalAlloc, Layout, System as Heap};
use std::cell::Cell;

use common::*;
use wingbeat_dynamics::{
    AddedMass, Baumgarte, ElementLaw, EulerForm, Formulation, JointModel, JointType, MomentumForm,
    QuaternionForm, Solution, Stabilization, Wrench,
};
use wingbeat_math::DVec3;
use wingbeat_math::ode::Rk4;

struct Counting;

thread_local! {
    /// Of this thread alone: the test's harness allocates when it likes.
    static COUNT: Cell<usize> = const { Cell::new(0) };
}

// SAFETY: every call is handed to the system's allocator unchanged.
unsafe impl GlobalAlloc for Counting {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        COUNT.set(COUNT.get() + 1);
        // SAFETY: the caller keeps the contract of `alloc`.
        unsafe { Heap.alloc(layout) }
    }
    unsafe fn dealloc(&self, p: *mut u8, layout: Layout) {
        // SAFETY: the caller keeps the contract of `dealloc`.
        unsafe { Heap.dealloc(p, layout) }
    }
}

#[global_allocator]
static ALLOCATOR: Counting = Counting;

/// Every form, of a fly whose right wing stands on a spring where the form takes free joints.
fn forms() -> [Box<dyn Formulation>; 4] {
    let spring = ElementLaw::Spring {
        stiffness: 1e-9,
        rest: 0.0,
    };
    let passive = JointModel::new(JointType::Revolute { axis: DVec3::Y }).with(0, spring);
    let hinged = fly(GRAVITY).with_joint(1, passive).unwrap();
    [
        Box::new(MomentumForm::new(fly(GRAVITY))),
        Box::new(MomentumForm::new(hinged.clone())),
        Box::new(QuaternionForm::new(hinged, Stabilization::Projection)),
        Box::new(EulerForm::new(
            fly(GRAVITY),
            Baumgarte::for_step(BEAT / 80.0),
        )),
    ]
}

#[test]
fn exact_no_allocation_in_steps_of_any_form() {
    for form in &forms() {
        let mut flight = Flight::new(form.as_ref(), applied);
        let mut y = form.initial(0.0, &start()).unwrap();
        let (mut rk4, h, mut ws) = (Rk4::new(y.len()), BEAT / 80.0, form.workspace());
        let mut step = |n: usize, y: &mut [f64]| {
            rk4.advance(n as f64 * h, h, y, |t, y, dy| flight.rates(t, y, dy))
                .unwrap();
            form.normalise((n + 1) as f64 * h, y, &mut ws).unwrap();
            flight.solve((n + 1) as f64 * h, y).unwrap();
        };
        step(0, &mut y);
        let before = COUNT.get();
        (1..40).for_each(|n| step(n, &mut y));
        assert_eq!(COUNT.get() - before, 0);
    }
    let before = COUNT.get();
    drop(vec![0_u8; 10]);
    assert_eq!(COUNT.get() - before, 1); // the counter counts
}

/// A wing that carries air along, where its joint is free and where it is not.
#[test]
fn exact_no_allocation_in_rates_with_added_mass() {
    let mut plate = [[0.0; 6]; 6];
    (plate[2][2], plate[3][3], plate[4][4]) = (WING_MASS, WING_MASS * LENGTH * LENGTH, 1e-15);
    let added = [AddedMass::new(1, plate), AddedMass::new(2, plate)];
    for form in &forms() {
        let mut y = form.initial(0.0, &start()).unwrap();
        let (mut ws, mut out) = (form.workspace(), Solution::new(form.system()));
        let (mut loads, mut dy) = (vec![Wrench::default(); 3], vec![0.0; y.len()]);
        let (mut rk4, h) = (Rk4::new(y.len()), BEAT / 80.0);
        let mut step = |n: usize, y: &mut [f64]| {
            rk4.advance(n as f64 * h, h, y, |t, y, dy| {
                loads.fill(Wrench::default());
                form.rates_with((t, y), &added, &mut loads, &mut ws, &mut out, dy)
            })
            .unwrap();
            loads.fill(Wrench::default());
            let at = ((n + 1) as f64 * h, &*y);
            form.rates_with(at, &added, &mut loads, &mut ws, &mut out, &mut dy)
                .unwrap();
            form.solve(at.0, y, &loads, &mut ws, &mut out).unwrap();
        };
        step(0, &mut y);
        let before = COUNT.get();
        (1..40).for_each(|n| step(n, &mut y));
        assert_eq!(COUNT.get() - before, 0);
    }
}
