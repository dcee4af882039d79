//! Leading edges that hold suction, what leaves them found together with the circulations.

use crate::common::{fly, rectangle, total_force, with_leading_edges};
use crate::peers::column;
use crate::separated::{core_of, normal_hover, separated_hover};
use crate::wakes::ALL;
use wingbeat_air::{
    AirError, AirLoads, AirSettings, AirState, AirWorkspace, JoinedEdge, Lattice, LeadingEdge,
    LoadMethod, Method, MirrorPairs, NodeMotion, ParticleSettings, Plane, SheddingKinds,
    Stretching, Surface,
};
use wingbeat_math::{DVec3, r2};

const HELD: f64 = 0.18;

pub fn implicit(threshold: f64) -> LeadingEdge {
    LeadingEdge::SuctionImplicit {
        threshold,
        efficiency: 1.0,
    }
}

/// The cores of insects in a unit stream, without clearance and overlap, leading and trailing edges shedding.
pub fn settings(leading: LeadingEdge) -> AirSettings {
    AirSettings {
        bound_core: core_of(0.01)[0],
        wake_core: core_of(0.07)[0],
        summation: Method::Direct, // to the last bits
        ..with_leading_edges(leading, DVec3::X)
    }
}

/// Places and velocities of a flat plate at this incidence, which grows at this rate about its leading edge.
pub fn pitched(flat: &[DVec3], [angle, rate]: [f64; 2]) -> NodeMotion {
    let arm = |x: &DVec3| r2(angle) * DVec3::new(x.x, 0.0, x.z) + x.y * DVec3::Y;
    NodeMotion {
        position: flat.iter().map(arm).collect(),
        velocity: (flat.iter())
            .map(|x| rate * DVec3::Y.cross(arm(x)))
            .collect(),
    }
}

/// Up to 45 degrees within a chord of travel, from 0.4 chords on [Eldredge, Wang, Ol 2009, AIAA 2009-3687].
fn ramp(t: f64) -> [f64; 2] {
    let a = 11.0;
    let [rise, hold] = [a * (t - 0.4), a * (t - 1.4)];
    let eighth = std::f64::consts::FRAC_PI_8;
    [
        eighth * (1.0 + (rise.cosh() / hold.cosh()).ln() / a),
        eighth * (rise.tanh() - hold.tanh()),
    ]
}

/// Circulation that the leading edge of a plate in plane flow has shed after 0.6 and 1.0 chords of the ramp,
/// and the largest suction parameter until then: a column ten chords wide between two that are 500 times as
/// wide.
fn plane_ramp(leading: LeadingEdge, [rows, per_chord]: [usize; 2]) -> ([f64; 2], f64) {
    let stations = [-5e3, -5.0, 5.0, 5e3];
    let row = |i: usize| stations.map(|y| DVec3::new(i as f64 / rows as f64, y, 0.0));
    let flat: Vec<DVec3> = (0..=rows).flat_map(row).collect();
    let lattice = Lattice::new(vec![Surface::grid("plate", rows, 3)], settings(leading)).unwrap();
    let (mut shed, mut most) = (vec![], 0.0_f64);
    let dt = 1.0 / per_chord as f64;
    let last = 7 * per_chord / 5;
    fly(
        &lattice,
        |t| pitched(&flat, ramp(t)),
        dt,
        last,
        |_, state, loads, _| {
            let gamma = &state.sheets[0].gamma;
            shed.push(
                gamma
                    .len()
                    .checked_sub(2)
                    .map_or(0.0, |middle| gamma[middle]),
            );
            most = most.max(loads.leading[1]);
        },
    )
    .unwrap();
    ([per_chord, last].map(|k| shed[k].abs()), most)
}

/// A discrete-vortex method for plane flow: what the edge sheds while the plate pitches, on coarse and fine
/// panels, and never more suction than is held. What leaves with the row after next, by the suction of the
/// lattice alone, is half of that and grows with the number of panels.
#[test]
fn agrees_second_method_circulation_shed_by_a_plate_that_pitches_to_45_degrees() {
    let table = include_str!("../../../wingbeat-verify/data/ramp_discrete_vortices.csv");
    let [travel, shed] = ["travel", "leading_edge_circulation"].map(|name| column(table, name));
    let at = |s: f64| shed[travel.iter().position(|x| (x - s).abs() < 1e-6).unwrap()];
    let theirs = [at(0.6), at(1.0)];
    for mesh in [[6, 20], [12, 40]] {
        let (ours, most) = plane_ramp(implicit(HELD), mesh);
        println!("{mesh:?}: {ours:?}, theirs {theirs:?}, suction {most}");
        // Measured 20 and 16 % less after 0.6 chords, 1 % less from there to the end. Theirs begins sooner: its
        // lift half a chord after a sudden start is 8 % more than Wagner's (the command wagner of the script).
        assert!((ours[0] / theirs[0] - 0.8).abs() < 0.1);
        assert!(((ours[1] - ours[0]) / (theirs[1] - theirs[0]) - 1.0).abs() < 0.1);
        assert!((most / HELD - 1.0).abs() < 1e-9);
    }
    let explicit = LeadingEdge::Suction {
        threshold: HELD,
        efficiency: 1.0,
    };
    let (late, most) = plane_ramp(explicit, [6, 20]);
    println!("explicit: {late:?}, suction {most}");
    assert!(late[1] < 0.6 * theirs[1] && most > 1.5 * HELD);
}

/// Complementarity: an edge with less than it holds sheds nothing, what leaves has the sign of what is held,
/// and edges that shed have what they hold; but for those whose wing has turned into its newest row, which are
/// counted and have a little more.
#[test]
fn exact_edges_shed_only_while_they_have_what_they_hold() {
    let flat = rectangle(4, 6, DVec3::X, 4.0 * DVec3::Y);
    let lattice = Lattice::new(vec![Surface::grid("wing", 4, 6)], settings(implicit(0.2))).unwrap();
    let swing = |t: f64| [0.7 * (2.0 * t).sin(), 1.4 * (2.0 * t).cos()];
    let [mut shedding, mut not, mut counted] = [0; 3];
    let mut most = 0.0_f64;
    let mut signs = [false; 2];
    let see = |step: usize, _: &AirState, loads: &AirLoads, _: &mut AirWorkspace| {
        if step == 0 {
            return; // no vortex has a place to go yet
        }
        let mut more = 0;
        for (suction, leaving) in loads.leading.iter().zip(&loads.leaving) {
            let over = suction / 0.2 - 1.0;
            match *leaving == 0.0 {
                true => {
                    not += 1;
                    assert!(over <= 1e-12, "{suction}");
                }
                false => {
                    shedding += 1;
                    signs[usize::from(*leaving > 0.0)] = true;
                    assert!(over >= -1e-12, "{suction}");
                    more += u64::from(over > 1e-12);
                    most = most.max(over);
                }
            }
        }
        assert_eq!(more, loads.unfound);
        counted += more;
    };
    fly(&lattice, |t| pitched(&flat, swing(t)), 0.1, 60, see).unwrap();
    println!("{shedding} strips shed, {not} did not, {counted} had up to {most} more");
    assert!(shedding > 50 && not > 50 && signs == [true; 2]);
    assert!(counted < shedding / 8 && most < 0.05);
}

#[test]
fn agrees_second_method_impulse_in_hover_with_implicit_suction() {
    let beats = separated_hover::<3>(|s| {
        s.leading = LeadingEdge::SuctionImplicit {
            threshold: 0.15,
            efficiency: 0.0,
        };
        (s.bound_core, s.wake_core) = (core_of(0.01)[0], core_of(0.07)[0]);
    });
    println!("force, rate of impulse: {beats:?}");
    // Measured 5.1 in the beat of the start, then 2.1 and 1.0 %. With half the step 4.0, 3.4 and 1.0 %, and
    // the same forces to 2 %; they differed by 8 % where half of what waits on edges was counted.
    for ([force, impulse], most) in beats.into_iter().zip([0.065, 0.04, 0.02]) {
        assert!((impulse / force - 1.0).abs() < most, "{beats:?}");
    }
}

/// Two wings that hover as each other's mirror image, the wakes' clearance on. Edges that by the state's
/// criterion shed and then hold have filaments in the newest row whose circulation is zero or a rounding: which
/// of both must not matter.
#[test]
fn invariant_left_and_right_wing_in_hover() {
    let explicit = LeadingEdge::Suction {
        threshold: 0.15,
        efficiency: 0.0,
    };
    let angle = LeadingEdge::AngleOfAttack {
        threshold: 15_f64.to_radians(),
    };
    for leading in [implicit(0.15), explicit, angle] {
        let settings = AirSettings {
            shedding: ALL,
            wake_overlap: 1.0,
            clearance: 0.1,
            free_stream: DVec3::ZERO,
            ..settings(leading)
        };
        let wings = ["right", "left"].map(|name| Surface::grid(name, 4, 6));
        let lattice = Lattice::new(wings.to_vec(), settings).unwrap();
        let (mut apart, mut largest) = (0.0_f64, 0.0_f64);
        fly(&lattice, normal_hover, 0.025, 45, |_, _, loads, _| {
            let [right, left] = [0, 1].map(|s| loads.surfaces[s].force);
            let image = DVec3::new(left.x, -left.y, left.z);
            apart = apart.max(right.distance(image));
            largest = largest.max(right.length());
        })
        .unwrap();
        println!("{leading:?}: {apart:e} of {largest}");
        // Roundings, which grow in a wake that is chaotic.
        assert!(apart < 1e-6 * largest);
    }
}

/// Two halves in pairs of mirror images or not; joined at the root, or apart, and then they shed all around.
fn halves(symmetric: bool, is_joined: bool) -> (Lattice, Vec<DVec3>) {
    let (rows, cols) = (3, 4);
    let mut left = Surface::grid("left", rows, cols);
    left.panels.iter_mut().for_each(|c| c.reverse());
    let joined = JoinedEdge {
        surfaces: [0, 1],
        nodes: (0..=rows).map(|i| [i * (cols + 1); 2]).collect(),
    };
    let settings = AirSettings {
        shedding: SheddingKinds {
            leading: true,
            tip: true,
            root: !is_joined,
            ..SheddingKinds::TRAILING
        },
        wake_overlap: 1.0,
        ..settings(implicit(0.15))
    };
    let wings = vec![Surface::grid("right", rows, cols), left];
    let joined = if is_joined { vec![joined] } else { vec![] };
    let lattice = Lattice::joined(wings, &joined, settings).unwrap();
    let other = |n: usize| (0..2 * n).map(|k| (k + n) % (2 * n)).collect();
    let pairs = MirrorPairs {
        plane: Plane {
            point: DVec3::ZERO,
            normal: DVec3::Y,
        },
        node: other((rows + 1) * (cols + 1)),
        panel: other(rows * cols),
    };
    let lattice = match symmetric {
        true => lattice.with_mirror_symmetry(pairs).unwrap(),
        false => lattice,
    };
    let apart = if is_joined { 0.0 } else { 0.3 };
    let right = rectangle(rows, cols, DVec3::X, 2.0 * DVec3::Y);
    let right: Vec<DVec3> = right.iter().map(|x| *x + apart * DVec3::Y).collect();
    let image: Vec<DVec3> = right.iter().map(|x| DVec3::new(x.x, -x.y, x.z)).collect();
    (lattice, [right, image].concat())
}

#[test]
fn invariant_half_of_a_symmetric_flow_is_that_of_the_whole() {
    for is_joined in [true, false] {
        let [whole, half] = [false, true].map(|symmetric| {
            let (lattice, flat) = halves(symmetric, is_joined);
            let (mut forces, mut left) = (vec![], 0.0);
            let motion = |t| pitched(&flat, ramp(t));
            fly(&lattice, motion, 0.05, 40, |_, _, loads, _| {
                forces.push(total_force(loads));
                left += loads.leaving.iter().map(|l| l.abs()).sum::<f64>();
            })
            .unwrap();
            assert!(left > 1.0, "edges shed: {left}");
            forces
        });
        let apart = whole
            .iter()
            .zip(&half)
            .map(|(a, b)| a.distance(*b) / (1.0 + a.length()));
        let apart = apart.fold(0.0, f64::max);
        println!("joined {is_joined}: {apart:e}");
        // Roundings.
        assert!(apart < 1e-11);
    }
}

/// On one thread, on two, and on from the middle with new scratch memory: the same bits.
#[test]
fn exact_same_bits_on_any_threads_and_from_any_step() {
    let (lattice, flat) = halves(true, true);
    let go_on = |mut state: AirState, last: u64| -> Result<AirState, AirError> {
        let (mut ws, mut loads) = (lattice.workspace(), AirLoads::default());
        while state.step < last {
            let t = 0.05 * state.step as f64;
            if state.step > 0 {
                lattice.convect(&mut state, 0.05, &mut ws)?;
            }
            let motion = pitched(&flat, ramp(t));
            lattice.loads(&state, t, 0.05, &motion, &mut ws, &mut loads)?;
            lattice.accept(&mut state, &motion, &loads)?;
        }
        Ok(state)
    };
    let start = || lattice.initial_state(&pitched(&flat, ramp(0.0)));
    let on = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build();
        pool.unwrap().install(|| go_on(start(), 30).unwrap())
    };
    let one = on(1);
    assert!(one.leaving.iter().any(|l| *l != 0.0));
    assert!(one == on(2));
    assert!(one == go_on(go_on(start(), 17).unwrap(), 30).unwrap());
}

/// Pressures, the first-order scheme, particles from the leading edge: the edge has what it holds in all of them.
#[test]
fn behaves_with_pressures_the_first_order_scheme_and_particles() {
    let flat = rectangle(4, 4, DVec3::X, 4.0 * DVec3::Y);
    let base = settings(implicit(HELD));
    let first_order = AirSettings {
        shedding: base.shedding,
        leading: base.leading,
        ..AirSettings::benchmark(1.0, DVec3::X)
    };
    let particles = AirSettings {
        bound_core: core_of(0.01)[1],
        wake_core: core_of(0.07)[1],
        particles: Some(ParticleSettings {
            after: None,
            leading_at_once: true,
            radius: 0.1,
            viscosity: 0.0,
            stretching: Stretching::Transpose,
        }),
        ..base.clone()
    };
    let pressures = AirSettings {
        loads: LoadMethod::Pressure,
        ..base
    };
    for settings in [pressures, first_order, particles] {
        let lattice = Lattice::new(vec![Surface::grid("wing", 4, 4)], settings).unwrap();
        let (mut least, mut shed, mut lift) = (f64::INFINITY, 0.0, 0.0);
        fly(
            &lattice,
            |t| pitched(&flat, ramp(t)),
            0.05,
            30,
            |_, _, loads, _| {
                // Edges that shed have the suction they hold, or are counted.
                let above = loads.leading.iter().filter(|s| **s > HELD * (1.0 + 1e-9));
                assert!(above.count() as u64 <= loads.unfound);
                let all = loads.leading.iter().zip(&loads.leaving);
                let shedding = all.filter(|(_, leaving)| **leaving != 0.0);
                least = shedding.fold(least, |m, (s, _)| m.min(*s));
                shed += loads.leaving.iter().sum::<f64>();
                lift = total_force(loads).z;
            },
        )
        .unwrap();
        println!("suction {least} and more, shed {shed}, lift {lift}");
        assert!((least / HELD - 1.0).abs() < 1e-9 && shed > 1.0 && lift.is_finite());
    }
}
