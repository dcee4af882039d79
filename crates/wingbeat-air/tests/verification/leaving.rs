//! What leaves leading edges within a step, where that is part of the solution: what the flow says of it, and
//! what is counted where there is no solution.

use crate::common::{Run, fly, rectangle, total_force};
use crate::implicit_suction::{implicit, pitched, settings};
use crate::wakes::ALL;
use wingbeat_air::{
    AirLoads, AirSettings, AirState, EdgeKind, Lattice, LeadingEdge, Method, SheddingKinds, Surface,
};
use wingbeat_math::{DVec3, r2};
use wingbeat_vortex::Points;

/// The settings of a wing with sharp cores, all of whose edges shed.
fn sharp(threshold: f64) -> AirSettings {
    AirSettings {
        shedding: ALL,
        leading: implicit(threshold),
        summation: Method::Direct,
        ..AirSettings::accurate(1.0, DVec3::X)
    }
}

/// A plate that meets the stream at 45 degrees, in its eighth step: vorticity leaves its whole leading edge.
fn shedding_plate() -> (Lattice, Run) {
    let flat = rectangle(4, 6, DVec3::X, 4.0 * DVec3::Y);
    let lattice = Lattice::new(vec![Surface::grid("wing", 4, 6)], sharp(0.15)).unwrap();
    let held = pitched(&flat, [std::f64::consts::FRAC_PI_4, 0.0]);
    let run = fly(&lattice, |_| held.clone(), 0.05, 8, |_, _, _, _| {}).unwrap();
    assert!(run.loads.leaving.iter().all(|l| *l != 0.0));
    (lattice, run)
}

/// The same state, had nothing left the leading edges within the step.
fn without_leaving(state: &AirState) -> AirState {
    let mut without = state.clone();
    without.leaving.fill(0.0);
    without
}

#[test]
fn exact_velocity_of_an_accepted_step_does_not_go_through_the_panels() {
    let (lattice, mut run) = shedding_plate();
    let mut points = Points::default();
    (run.loads.panels.point.iter()).for_each(|x| points.push(*x));
    let mut through = |state: &AirState| {
        let mut velocity = Points::default();
        (lattice.velocity(state, &points, &mut run.ws, &mut velocity)).unwrap();
        let normal = velocity.iter().zip(&run.loads.panels.normal);
        normal.fold(0.0_f64, |m, (v, n)| m.max(v.dot(*n).abs()))
    };
    let with = through(&run.state);
    let without = through(&without_leaving(&run.state));
    println!("through panels: {with:e}; without what leaves {without}");
    assert!(with < 1e-13 && without > 0.03); // roundings, and a part of the stream's 1
}

/// What leaves within a step is between edge and newest row before wakes are moved, and on both lines of nodes
/// after it. If the motion takes no time that is the same impulse and, far away, the same flow.
#[test]
fn limit_wakes_moved_for_no_time_leave_impulse_and_far_flow() {
    let (lattice, mut run) = shedding_plate();
    let mut points = Points::default();
    let far = [8.0, 16.0, 32.0];
    for r in far {
        points.push(r * DVec3::new(0.3, 0.5, 0.8));
    }
    let mut look = |state: &AirState| {
        let mut velocity = Points::default();
        (lattice.velocity(state, &points, &mut run.ws, &mut velocity)).unwrap();
        (velocity, lattice.impulse(state, &mut run.ws).unwrap())
    };
    let (before, impulse) = look(&run.state);
    let (without, rest) = look(&without_leaving(&run.state));
    let mut moved = run.state.clone();
    lattice
        .convect(&mut moved, 1e-9, &mut lattice.workspace())
        .unwrap();
    assert!(moved.leaving.iter().all(|l| *l == 0.0));
    let (after, later) = look(&moved);
    let lost = later.distance(impulse) / rest.distance(impulse);
    let change = |i: usize| after.get(i).distance(before.get(i));
    let of_leaving = |i: usize| without.get(i).distance(before.get(i));
    let parts = [0, 1, 2].map(|i| change(i) / of_leaving(i));
    println!("of what leaves: impulse {lost:e}, velocity {parts:?}");
    // Rows are not quite parallelograms: the middle of one does not halve its area (8e-4 measured).
    assert!(lost < 5e-3, "{lost:e}");
    // Two lines for one between them: a moment of higher order.
    assert!(parts[0] < 0.02 && parts[2] < 2e-3, "{parts:?}");
}

/// Steps of a panel's length and a suction that hardly any edge has: sharp wakes cross the leading panels.
/// Every strip that sheds has the suction it holds, or more where the bound on the effect of what leaves acts,
/// and then it is counted.
#[test]
fn exact_strips_hold_their_suction_or_are_counted_where_sharp_wakes_cross_the_leading_panels() {
    let (held, cols) = (0.05, 12);
    let flat = rectangle(4, cols, DVec3::X, 4.0 * DVec3::Y);
    let lattice = Lattice::new(vec![Surface::grid("wing", 4, cols)], sharp(held)).unwrap();
    let swing = |t: f64| pitched(&flat, [0.3 * t.cos(), -0.3 * t.sin()]);
    let (mut shed, mut bounded) = (0, 0);
    let run = fly(&lattice, swing, 0.25, 24, |step, state, loads, _| {
        let with = loads.leading.iter().zip(&loads.leaving);
        let apart = |suction: f64| (suction / held - 1.0).abs() > 1e-9;
        let mut above = 0;
        for (suction, leaving) in with.filter(|_| step > 0) {
            let sheds = *leaving != 0.0;
            shed += u64::from(sheds);
            above += u64::from(sheds && apart(*suction));
            assert!(sheds || *suction < held * (1.0 + 1e-9));
        }
        assert_eq!(above, loads.unfound);
        bounded += above;
        assert_eq!(state.events.limited, bounded);
        assert!(total_force(loads).is_finite());
    })
    .unwrap();
    println!("{shed} strips shed, {bounded} with a bounded effect");
    assert_eq!(run.state.events.limited, bounded);
    // 202 and 160: hardly any suction is held here, and wings turn into what they have just shed.
    assert!(shed > 100 && bounded > 0 && bounded < shed);
}

/// A wing of 4 x 6 panels at 40 degrees sheds ever more of one sign from its leading edge and of the other from
/// its trailing edge; its roots shed, too. Force and rate of impulse, means over the last of so many chords of
/// travel, the wake cut after so many rows or not at all.
fn steady_separation(
    leading: LeadingEdge,
    [rows, cols, per_chord]: [usize; 3],
    chords: usize,
    max_rows: Option<usize>,
) -> [DVec3; 2] {
    let flat = rectangle(rows, cols, DVec3::X, 4.0 * DVec3::Y);
    let settings = AirSettings {
        shedding: SheddingKinds { root: true, ..ALL },
        wake_overlap: 1.0,
        clearance: 0.1,
        max_rows,
        ..settings(leading)
    };
    let lattice = Lattice::new(vec![Surface::grid("wing", rows, cols)], settings).unwrap();
    let (mut forces, mut impulses) = (vec![], vec![]);
    let held = pitched(&flat, [0.7, 0.0]);
    let dt = 1.0 / per_chord as f64;
    fly(
        &lattice,
        |_| held.clone(),
        dt,
        chords * per_chord,
        |_, _, loads, _| {
            forces.push(loads.inviscid_force);
            impulses.push(loads.impulse);
        },
    )
    .unwrap();
    let last = chords * per_chord;
    let first = last - per_chord;
    let force = forces[first + 1..].iter().sum::<DVec3>() / per_chord as f64;
    [force, impulses[first] - impulses[last]]
}

/// Where edges shed ever more, each row is a third of a panel long or less, and what waits on the edges for its
/// turn to leave is a quarter of the force. Counted half, as what leaves in rows of a panel, it had force and
/// impulse 5 to 11 % apart, and no nearer with half the step (9 to 12 %, now 2 to 3 %).
#[test]
fn agrees_second_method_impulse_of_a_plate_at_40_degrees_in_every_way_of_leading_edges() {
    let (threshold, efficiency) = (0.15, 1.0);
    let explicit = LeadingEdge::Suction {
        threshold,
        efficiency,
    };
    for leading in [LeadingEdge::Always, explicit, implicit(threshold)] {
        let apart = [[4, 6, 10], [5, 8, 12]].map(|mesh| {
            let [force, impulse] = steady_separation(leading, mesh, 5, None);
            impulse.distance(force) / force.length()
        });
        println!("{leading:?}: {apart:.4?}");
        // Measured 1.7 to 1.9 and 1.7 to 2.3 %: quadrature along segments and filaments.
        assert!(apart.iter().all(|apart| *apart < 0.05));
    }
}

/// What all rings have in common does not stay behind at the end of the wake: with it the cut wake pulled the
/// wing down, with a lift of -1.8 instead of 1.9.
#[test]
fn agrees_second_method_impulse_of_a_wing_that_sheds_around_with_its_wake_cut() {
    let [whole, cut] =
        [None, Some(15)].map(|rows| steady_separation(implicit(0.15), [4, 6, 10], 6, rows));
    println!("force, rate of impulse: whole {whole:?}, cut {cut:?}");
    let apart = [whole, cut].map(|[force, impulse]| impulse.distance(force) / force.length());
    // Measured 1.5 % and 13 %: in the cut one the flow of what was dropped is missing.
    assert!(apart[0] < 0.06 && apart[1] < 0.15, "{apart:?}");
    // Measured 2.7 %.
    assert!(cut[0].distance(whole[0]) < 0.1 * whole[0].length());
}

/// A closed sheet begins and ends at one corner of the wing, and nothing in the flow knows which; nor whether
/// filaments whose circulation is zero by symmetry have a rounding of it.
#[test]
fn invariant_flow_of_a_wing_that_sheds_around_is_symmetric_wherever_its_sheet_begins() {
    let flat = rectangle(4, 6, DVec3::X, 4.0 * DVec3::Y);
    let (threshold, efficiency) = (0.15, 1.0);
    let explicit = LeadingEdge::Suction {
        threshold,
        efficiency,
    };
    for leading in [LeadingEdge::Always, explicit, implicit(threshold)] {
        let settings = AirSettings {
            shedding: SheddingKinds { root: true, ..ALL },
            wake_overlap: 1.0,
            clearance: 0.1,
            ..settings(leading)
        };
        let lattice = Lattice::new(vec![Surface::grid("wing", 4, 6)], settings).unwrap();
        let held = pitched(&flat, [0.7, 0.0]);
        let (mut along, mut total) = (0.0_f64, 0.0_f64);
        fly(
            &lattice,
            |_| held.clone(),
            0.1,
            60,
            |_, _, loads, _| {
                along = along.max(loads.inviscid_force.y.abs());
                total = total.max(loads.inviscid_force.length());
            },
        )
        .unwrap();
        println!(
            "{leading:?}: {:.1e} of the force along the span",
            along / total
        );
        // Roundings: measured 2e-16 at most; 1e-4 where the sheet knew where it begins.
        assert!(along < 1e-14 * total);
    }
}

/// Rings of a leading edge that holds have no circulation: nothing is common to all, and where the wake is cut
/// an attached wing whose roots shed has the force of one whose roots do not, up to what roots do to the newest
/// rows.
#[test]
fn agrees_attached_wing_with_its_wake_cut_whether_its_roots_shed_or_not() {
    let flat = rectangle(4, 6, DVec3::X, 4.0 * DVec3::Y);
    let force = |root: bool, max_rows: Option<usize>| {
        let settings = AirSettings {
            shedding: SheddingKinds { root, ..ALL },
            max_rows,
            ..settings(implicit(0.15))
        };
        let lattice = Lattice::new(vec![Surface::grid("wing", 4, 6)], settings).unwrap();
        let held = pitched(&flat, [0.08, 0.0]);
        let run = fly(&lattice, |_| held.clone(), 0.1, 30, |_, _, _, _| {}).unwrap();
        total_force(&run.loads)
    };
    let [whole, cut] = [None, Some(8)].map(|rows| [true, false].map(|root| force(root, rows)));
    let apart = |[a, b]: [DVec3; 2]| a.distance(b) / b.length();
    println!("{} {}", apart(whole), apart(cut));
    assert!(apart(cut) < apart(whole) + 1e-3);
}

/// What leaves the middle of a leading edge whose newest free nodes lie, a panel away from it, at this angle
/// from straight ahead [deg], and the pull of what lies at the edge [N].
fn with_newest_row_at(angle: f64) -> [f64; 2] {
    let (lattice, run) = shedding_plate();
    let motion = pitched(
        &rectangle(4, 6, DVec3::X, 4.0 * DVec3::Y),
        [std::f64::consts::FRAC_PI_4, 0.0],
    );
    let mut state = run.state;
    let mut ws = lattice.workspace();
    lattice.convect(&mut state, 0.05, &mut ws).unwrap();
    let (sin, cos) = angle.to_radians().sin_cos();
    let [ahead, above] = [-DVec3::X, DVec3::Z].map(|x| r2(std::f64::consts::FRAC_PI_4) * x);
    for (sheet, root) in state.sheets.iter_mut().zip(lattice.sheets()) {
        let leading = (0..sheet.columns).filter(|&c| root.kinds[c] == EdgeKind::Leading);
        for node in leading.flat_map(|c| [c, c + 1]) {
            let edge = motion.position[root.nodes[node]];
            let at = edge + 0.25 * (cos * ahead + sin * above);
            sheet
                .nodes
                .set((sheet.rows() - 1) * (sheet.columns + 1) + node, at);
        }
    }
    let mut loads = AirLoads::default();
    lattice
        .loads(&state, 0.45, 0.05, &motion, &mut ws, &mut loads)
        .unwrap();
    [loads.leaving[3].abs(), total_force(&loads).length()]
}

/// Where a wing turns into its newest row, a vortex that leaves along it has no effect on the suction of the
/// edge, and what leaves had no bound. The sheet leaves the edge straight ahead before it bends, so what leaves
/// stays finite.
#[test]
fn limit_what_leaves_stays_finite_where_a_wing_turns_into_its_newest_row() {
    let angles = [90.0, 120.0, 140.0, 150.0, 160.0, 170.0, 175.0, 179.0];
    let all = angles.map(with_newest_row_at);
    println!("{all:?}");
    let [beside, push] = all[0];
    // Measured 3.3 and 2.3 at most; 32 and 8.7 at 160 degrees without a bound to the effect of what leaves,
    // none beyond.
    for [left, force] in all {
        assert!((0.5..5.0).contains(&(left / beside)), "{all:?}");
        assert!(force < 4.0 * push, "{all:?}");
    }
}
