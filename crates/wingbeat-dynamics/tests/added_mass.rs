//! Air that bodies carry along, on the left-hand side of the equations of motion.

use std::sync::Arc;

use wingbeat_dynamics::{
    AddedMass, Baumgarte, Body, BodyMotion, EulerForm, Formulation, Joint, JointModel, JointType,
    MomentumForm, NaturalUnits, QuaternionForm, Solution, Stabilization, System, Wrench,
    add_by_response,
};
use wingbeat_math::{DMat3, DVec3, EulerSequence, MassProperties, MovingRotation, RotationLaw};

/// Turns about axis 2 by `sin(3 t)`.
#[derive(Debug)]
struct Nod;

impl RotationLaw for Nod {
    fn at(&self, t: f64) -> MovingRotation {
        let (s, c) = (3.0 * t).sin_cos();
        MovingRotation::about(1, [s, 3.0 * c, -9.0 * s])
    }
}

fn body(name: &str, mass: f64, centre: DVec3, inertia: DVec3) -> Body {
    Body {
        name: name.into(),
        mass: MassProperties::about_centre(mass, centre, DMat3::from_diagonal(inertia)),
        sequence: EulerSequence::BODY_231,
    }
}

/// A body with a nodding wing.
fn flyer() -> System {
    let bodies = vec![
        body(
            "body",
            2.0,
            DVec3::new(0.1, 0.0, 0.2),
            DVec3::new(0.3, 0.4, 0.5),
        ),
        body(
            "wing",
            0.2,
            DVec3::new(0.0, 0.5, 0.0),
            DVec3::new(0.03, 0.01, 0.04),
        ),
    ];
    let at = DVec3::new(0.2, 0.1, -0.1);
    let hinge = Joint {
        law: Some(Arc::new(Nod)),
        ..Joint::new("wing", Some(0), 1, JointType::Weld).at(at, DVec3::ZERO)
    };
    let units = NaturalUnits {
        length: 1.0,
        time: 1.0,
    };
    System::new(bodies, vec![hinge], DVec3::new(0.0, 0.0, 9.81), units).expect("a flyer")
}

/// Of a plate: normal force and two moments.
fn plate(body: usize, size: f64) -> AddedMass {
    let mut a = [[0.0; 6]; 6];
    let rows = [[0.5, 0.25, -0.02], [0.25, 0.2, -0.01], [-0.02, -0.01, 0.05]];
    let at = [2, 3, 4];
    for (i, row) in rows.iter().enumerate() {
        for (j, x) in row.iter().enumerate() {
            a[at[i]][at[j]] = size * x;
        }
    }
    AddedMass::new(body, a)
}

fn root() -> BodyMotion {
    BodyMotion {
        p: DVec3::new(0.3, -0.2, 0.1),
        r: wingbeat_math::r2(0.4) * wingbeat_math::r3(-0.7),
        v: DVec3::new(1.0, 0.5, -0.3),
        w: DVec3::new(0.4, -1.0, 0.8),
    }
}

/// Loads with and without added mass, and the accelerations under them.
fn answer(
    form: &dyn Formulation,
    added: &[AddedMass],
    by_response: bool,
) -> (Vec<Wrench>, Solution) {
    let t = 0.3;
    let y = form.initial(t, &root()).expect("a state");
    let (mut ws, mut out) = (form.workspace(), Solution::new(form.system()));
    let push = Wrench {
        force: DVec3::new(0.4, 1.0, -2.0),
        moment: DVec3::new(0.1, 0.3, -0.2),
    };
    let mut loads = vec![push; form.system().bodies().len()];
    let done = match by_response {
        true => add_by_response(form, (t, &y), added, &mut loads, &mut ws, &mut out),
        false => form.add_mass((t, &y), added, &mut loads, &mut ws, &mut out),
    };
    done.expect("added masses that accelerations agree with");
    form.solve(t, &y, &loads, &mut ws, &mut out)
        .expect("a solution");
    (loads, out)
}

#[test]
fn exact_added_mass_of_a_ball_slows_its_fall() {
    // A ball in a heavy fluid falls with m g / (m + m') when buoyancy is left out.
    let ball = body("ball", 2.0, DVec3::ZERO, DVec3::splat(0.1));
    let units = NaturalUnits {
        length: 1.0,
        time: 1.0,
    };
    let g = DVec3::new(0.0, 0.0, 9.81);
    let system = System::new(vec![ball], vec![], g, units).expect("a ball");
    let matrix =
        std::array::from_fn(|i| std::array::from_fn(|j| if i == j && i < 3 { 6.0 } else { 0.0 }));
    let form = MomentumForm::new(system);
    let y = form.initial(0.0, &BodyMotion::REST).expect("a state");
    let (mut ws, mut out) = (form.workspace(), Solution::new(form.system()));
    let mut loads = vec![Wrench::default()];
    let added = [AddedMass::new(0, matrix)];
    form.add_mass((0.0, &y), &added, &mut loads, &mut ws, &mut out)
        .expect("loads");
    form.solve(0.0, &y, &loads, &mut ws, &mut out)
        .expect("a solution");
    let expect = 9.81 * 2.0 / 8.0;
    assert!(
        (out.bodies[0].linear.z - expect).abs() < 1e-14,
        "{:?}",
        out.bodies[0]
    );
}

#[test]
fn agrees_added_mass_of_every_formulation_is_that_of_the_accelerations() {
    for size in [0.1, 1.0, 30.0] {
        let added = [plate(1, size)];
        let forms: [Box<dyn Formulation>; 3] = [
            Box::new(MomentumForm::new(flyer())),
            Box::new(EulerForm::new(flyer(), Baumgarte::OFF)),
            Box::new(QuaternionForm::new(flyer(), Stabilization::None)),
        ];
        let (reference, _) = answer(forms[0].as_ref(), &added, true);
        for form in &forms {
            let (loads, out) = answer(form.as_ref(), &added, false);
            // The loads are those of the accelerations they lead to.
            let t = 0.3;
            let y = form.initial(t, &root()).expect("a state");
            let mut motions = vec![BodyMotion::REST; 2];
            form.motions(t, &y, &mut form.workspace(), &mut motions)
                .expect("motions");
            let push = answer(form.as_ref(), &[], false).0[1];
            let asked = added[0].wrench(&motions[1], &out.bodies[1]);
            let gap = (loads[1] - push) - asked;
            let scale = asked.force.length() + asked.moment.length();
            assert!(
                gap.force.length() + gap.moment.length() < 1e-11 * scale,
                "{size}: {gap:?}"
            );
            // And the same in every form.
            let other = loads[1] - reference[1];
            assert!(
                other.force.length() + other.moment.length() < 1e-10 * scale,
                "{other:?}"
            );
        }
    }
}

#[test]
fn agrees_added_mass_on_a_free_joint() {
    // Passive feathering about axis 2: the response to unit loads serves free joints too.
    let joint = JointModel::new(JointType::Revolute { axis: DVec3::Y });
    let system = flyer().with_joint(0, joint).expect("a joint");
    let added = [plate(1, 1.0)];
    let momentum = MomentumForm::new(system.clone());
    let quaternion = QuaternionForm::new(system, Stabilization::None);
    let (a, _) = answer(&momentum, &added, false);
    let (b, _) = answer(&quaternion, &added, false);
    let gap = a[1] - b[1];
    assert!(
        gap.force.length() + gap.moment.length() < 1e-10 * a[1].force.length(),
        "{gap:?}"
    );
}

/// A workspace keeps what added masses are at a time; it must notice another time and other added masses.
#[test]
fn exact_a_workspace_that_was_used_before_answers_as_a_new_one() {
    let form = MomentumForm::new(flyer());
    let y = form.initial(0.3, &root()).expect("a state");
    let added_load = |t: f64, added: &[AddedMass], ws: &mut _| {
        let mut loads = vec![Wrench::default(); 2];
        let mut out = Solution::new(form.system());
        form.add_mass((t, &y), added, &mut loads, ws, &mut out)
            .expect("an inertia that is not singular");
        loads
    };
    let mut used = form.workspace();
    let mut seen: Vec<Vec<Wrench>> = vec![];
    for (t, size) in [(0.3, 1.0), (0.3, 2.0), (0.4, 2.0), (0.3, 2.0)] {
        let added = [plate(0, size), plate(1, size)];
        let load = added_load(t, &added, &mut used);
        assert_eq!(load, added_load(t, &added, &mut form.workspace()));
        seen.push(load);
    }
    assert_ne!(seen[0], seen[1]);
    assert_ne!(seen[1], seen[2]);
    assert_eq!(seen[1], seen[3]);
}
