//! Wakes of rings and vortex particles.

use crate::common::{Run, fly, order, rectangle, total_force, translating};
use std::f64::consts::{PI, TAU};
use wingbeat_air::{
    AirError, AirLoads, AirSettings, AirState, AirWorkspace, CoreModel, Lattice, Method,
    MirrorPairs, NodeMotion, ParticleSettings, Plane, SheddingKinds, Stretching, Surface,
};
use wingbeat_math::{DMat3, DVec3, r1, r2, r3};

const ALL: SheddingKinds = SheddingKinds {
    trailing: true,
    tip: true,
    leading: true,
    root: false,
};

pub(crate) fn particles(
    after: Option<usize>,
    leading_at_once: bool,
    radius: f64,
) -> ParticleSettings {
    ParticleSettings {
        after,
        leading_at_once,
        radius,
        viscosity: 0.0,
        stretching: Stretching::Transpose,
    }
}

/// A wing at 0.2 rad in a stream, accelerating, so that every row of wake has its own circulation.
pub(crate) fn growing(
    particles: Option<ParticleSettings>,
) -> (Lattice, impl Fn(f64) -> NodeMotion) {
    let settings = AirSettings {
        shedding: ALL,
        particles,
        ..AirSettings::accurate(1.2, DVec3::X)
    };
    let lattice = Lattice::new(vec![Surface::grid("wing", 4, 5)], settings).unwrap();
    let flat = rectangle(4, 5, DVec3::X, 2.5 * DVec3::Y);
    let flat: Vec<DVec3> = flat.iter().map(|x| r2(0.2) * *x).collect();
    let motion = move |t: f64| {
        let path = DVec3::new(-0.5 * t * t, 0.0, 0.0);
        let nodes = flat.iter().map(|x| *x + path).collect();
        translating(nodes, DVec3::new(-t, 0.0, 0.0))
    };
    (lattice, motion)
}

/// Total vorticity [m3/s] and impulse per density [m4/s] of filaments and particles, and the sum of
/// the sizes of all strengths.
fn sums(lattice: &Lattice, state: &AirState, ws: &mut AirWorkspace) -> ([DVec3; 2], f64) {
    let impulse = lattice.impulse(state, ws).unwrap() / lattice.settings().density;
    let f = ws.filaments();
    let (mut total, mut size) = (DVec3::ZERO, 0.0);
    for net in [&f.bound, &f.near_wake, &f.wake] {
        for e in 0..net.len() {
            let (a, b) = net.ends(e);
            total += net.gamma[e] * (b - a);
            size += (net.gamma[e] * (b - a)).length();
        }
    }
    for p in &f.particles {
        total += p.strength;
        size += p.strength.length();
    }
    ([total, impulse], size)
}

/// At the moment rows become particles nothing has moved differently yet: circulation and impulse are
/// those of the wake of rings.
#[test]
fn exact_conversion_keeps_vorticity_and_impulse() {
    for (after, at_once, first) in [(Some(3), false, 4), (None, true, 2), (Some(2), true, 2)] {
        let (rings, motion) = growing(None);
        let (hybrid, _) = growing(Some(particles(after, at_once, 0.1)));
        let [a, b] = [&rings, &hybrid].map(|lattice| {
            let mut run = fly(lattice, &motion, 0.25, first - 1, |_, _, _, _| {}).unwrap();
            let events = lattice.convect(&mut run.state, 0.25, &mut run.ws).unwrap();
            let made = events.new_particles as usize;
            assert_eq!(made, run.state.sheets[0].particles.len());
            (sums(lattice, &run.state, &mut run.ws), made)
        });
        assert!(
            a.1 == 0 && b.1 > 5,
            "{after:?} {at_once}: {} particles",
            b.1
        );
        let (([wa, ia], size), ([wb, ib], _)) = (a.0, b.0);
        assert!((wa - wb).length() < 1e-14 * size, "{wa} {wb}");
        assert!(wb.length() < 1e-14 * size, "closed: {wb}");
        assert!((ia - ib).length() < 1e-13 * ia.length(), "{ia} {ib}");
    }
}

/// A sheet that leaves a wing all around has its first line of nodes at one corner, between a column that
/// becomes particles at once and one that does not; nothing in a symmetric flow knows which corner.
#[test]
fn invariant_flow_with_particles_is_symmetric_wherever_the_sheet_begins() {
    let settings = AirSettings {
        shedding: SheddingKinds { root: true, ..ALL },
        particles: Some(particles(Some(3), true, 0.2)),
        summation: Method::Direct,
        ..AirSettings::accurate(1.0, DVec3::X)
    };
    let lattice = Lattice::new(vec![Surface::grid("wing", 3, 4)], settings).unwrap();
    let flat = rectangle(3, 4, DVec3::X, 3.0 * DVec3::Y);
    let plate: Vec<DVec3> = flat.iter().map(|x| r2(0.3) * *x).collect();
    let motion = |_| translating(plate.clone(), DVec3::ZERO);
    let (mut along, mut most) = (0.0_f64, 0.0_f64);
    fly(&lattice, motion, 0.2, 20, |_, _, loads, _| {
        let force = total_force(loads);
        (along, most) = (along.max(force.y.abs()), most.max(force.length()));
    })
    .unwrap();
    println!("along the span {:e} of the force", along / most);
    assert!(along < 1e-9 * most); // roundings in a free wake
}

/// From afar particles and the rings they were move the air alike.
#[test]
fn agrees_velocity_of_particles_with_that_of_their_rings() {
    let (rings, motion) = growing(None);
    let (hybrid, _) = growing(Some(particles(Some(1), false, 0.1)));
    let at = [DVec3::new(2.0, 1.0, 9.0), DVec3::new(-6.0, 8.0, 3.0)];
    let points = at.into_iter().collect();
    let [a, b] = [rings, hybrid].map(|lattice| {
        let mut run = fly(&lattice, &motion, 0.25, 1, |_, _, _, _| {}).unwrap();
        lattice.convect(&mut run.state, 0.25, &mut run.ws).unwrap();
        let mut out = Default::default();
        let velocity = lattice.velocity(&run.state, &points, &mut run.ws, &mut out);
        velocity.unwrap();
        [out.get(0) - DVec3::X, out.get(1) - DVec3::X]
    });
    for (a, b) in a.iter().zip(b) {
        // Pieces of 0.1 m as points, cores of 0.1 m: (0.1/8)^2.
        assert!((*a - b).length() < 1e-3 * a.length(), "{a} {b}");
    }
}

/// A wing of a millimetre, a kilometre away from all that matters: air for particles alone.
fn empty_air(radius: f64, stretching: Stretching) -> (Lattice, NodeMotion) {
    let settings = AirSettings {
        particles: Some(ParticleSettings {
            stretching,
            ..particles(Some(1_000_000), false, radius)
        }),
        ..AirSettings::accurate(1.0, DVec3::ZERO)
    };
    let lattice = Lattice::new(vec![Surface::grid("speck", 1, 1)], settings).unwrap();
    let nodes = rectangle(1, 1, 1e-3 * DVec3::X, 1e-3 * DVec3::Y);
    let nodes = nodes.iter().map(|x| *x + 1e3 * DVec3::Z).collect();
    (lattice, translating(nodes, DVec3::ZERO))
}

/// Adds a ring of circulation 1 and radius 1 in `n` particles: `place` maps the circle about e3.
fn add_ring(state: &mut AirState, n: usize, turn: DMat3, centre: DVec3) {
    let set = &mut state.sheets[0].particles;
    for k in 0..n {
        let (s, c) = (TAU * (k as f64 + 0.5) / n as f64).sin_cos();
        let strength = TAU / n as f64 * DVec3::new(-s, c, 0.0);
        let place = turn * DVec3::new(c, s, 0.0) + centre;
        set.push(place, turn * strength, 0.0);
    }
}

fn go_on(lattice: &Lattice, rest: &NodeMotion, state: &mut AirState, dt: f64, steps: usize) {
    let (mut ws, mut loads) = (lattice.workspace(), AirLoads::default());
    for step in 0..steps {
        let t = step as f64 * dt;
        lattice
            .loads(state, t, dt, rest, &mut ws, &mut loads)
            .unwrap();
        lattice.accept(state, rest, &loads).unwrap();
        lattice.convect(state, dt, &mut ws).unwrap();
    }
}

/// A thin ring of circulation G and radius R with this smoothing moves at
/// `G/(4 pi R) (ln(8 R / sigma) - 1/2)`: Rosenhead-Moore's has -1, the difference of the two kernels adds
/// `3/2 sigma^2 integral s^2 / (s^2 + sigma^2)^(5/2) ds = 1/2`.
#[test]
fn agrees_speed_of_a_ring_of_particles_with_theory() {
    let sigma = 0.1;
    let (lattice, rest) = empty_air(sigma, Stretching::Transpose);
    let mut state = lattice.initial_state(&rest);
    add_ring(&mut state, 150, DMat3::IDENTITY, DVec3::ZERO);
    // In the core the air turns at G/(pi sigma^2) = 32 rad/s; the step must follow that.
    go_on(&lattice, &rest, &mut state, 0.01, 200);
    let set = &state.sheets[0].particles;
    let z: Vec<f64> = set.position.iter().map(|x| x.z).collect();
    let speed = z.iter().sum::<f64>() / 150.0 / 2.0;
    // The same velocity as an integral along the ring: distance r = 2 sin(phi/2), (dl x r).e3 = r^2/2.
    let term = |k: usize| {
        let r2 = 4.0 * (PI * (k as f64 + 0.5) / 20_000.0).sin().powi(2);
        let s = r2 + sigma * sigma;
        0.5 * r2 * (r2 + 2.5 * sigma * sigma) / s.powf(2.5)
    };
    let exact = (0..20_000).map(term).sum::<f64>() * TAU / 20_000.0 / (4.0 * PI);
    let theory = ((8.0 / sigma).ln() - 0.5) / (4.0 * PI);
    println!("ring: {speed:.6}, integral {exact:.6}, thin ring {theory:.6}");
    // 150 particles 0.04 apart in balls of 0.1: the midpoint rule leaves exp(-2 pi 0.1/0.042) = 3e-7 of
    // the kernel's peak, a few times that of the speed.
    assert!((speed / exact - 1.0).abs() < 1e-5);
    // Next term of the theory: (sigma/R)^2 ln(R/sigma).
    assert!((speed / theory - 1.0).abs() < 0.02);
    let radius = set.position.iter().map(|x| x.truncate().length());
    let worst = radius.map(|r| (r - 1.0).abs()).fold(0.0, f64::max);
    let strength = set.strength.iter().map(|a| a.length() * 150.0 / TAU);
    let stretched = strength.map(|a| (a - 1.0).abs()).fold(0.0, f64::max);
    println!("ring: radius changes by {worst:e}, strengths by {stretched:e}");
    assert!(worst < 1e-6 && stretched < 1e-6); // roundings, and what the far wing adds
}

/// Two rings at an angle stretch each other: total vorticity and drift of the impulse.
fn two_rings(n: usize, sigma: f64, scheme: Stretching) -> [f64; 2] {
    let (lattice, rest) = empty_air(sigma, scheme);
    let mut state = lattice.initial_state(&rest);
    add_ring(&mut state, n, DMat3::IDENTITY, DVec3::ZERO);
    add_ring(&mut state, n, r1(1.0), DVec3::new(0.3, 1.2, 0.0));
    let before = state.sheets[0].particles.impulse();
    go_on(&lattice, &rest, &mut state, 0.1 / n as f64, 4 * n);
    let set = &state.sheets[0].particles;
    let total: DVec3 = set.strength.iter().sum();
    let drift = (set.impulse() - before).length() / before.length();
    [total.length(), drift]
}

/// The transpose scheme keeps the total vorticity exactly, the impulse as sigma shrinks (it differs from
/// the classical one by alpha x omega, smoothed vorticity not along the filament); the classical scheme
/// moves a filament as a material line, which keeps the impulse once particles are dense. Orders: first
/// in sigma, second in spacing and step.
#[test]
fn conserves_vorticity_or_impulse_exactly_and_the_other_in_the_limit() {
    let transpose = [16, 32, 64].map(|n| two_rings(n, 7.2 / n as f64, Stretching::Transpose));
    let classical = [16, 32, 64].map(|n| two_rings(n, 0.3, Stretching::Classical));
    println!("two rings, total vorticity and drift of impulse: transpose {transpose:?}");
    println!("classical {classical:?}");
    for [total, _] in transpose {
        assert!(total < 1e-12, "{total}"); // roundings of some ten thousand exactly opposite terms
    }
    let rate = |runs: [[f64; 2]; 3]| order(runs[0][1], runs[2][1]) / 2.0;
    assert!(rate(transpose) > 1.0, "{transpose:?}");
    assert!(rate(classical) > 2.0, "{classical:?}");
}

/// Normal force history of a plunging wing of aspect ratio 4, k = 0.5, amplitude a fifth of the chord.
fn plunging(settings: Option<ParticleSettings>) -> Vec<f64> {
    let core = CoreModel::Scully { radius: 0.1 };
    let all = AirSettings {
        bound_core: core,
        wake_core: core,
        particles: settings,
        ..AirSettings::accurate(1.2, DVec3::X)
    };
    let lattice = Lattice::new(vec![Surface::grid("wing", 4, 8)], all).unwrap();
    let flat = rectangle(4, 8, DVec3::X, 4.0 * DVec3::Y);
    let motion = |t: f64| {
        let path = 0.2 * (1.0 - t.cos()) * DVec3::Z;
        translating(
            flat.iter().map(|x| *x + path).collect(),
            0.2 * t.sin() * DVec3::Z,
        )
    };
    let mut force = Vec::new();
    fly(&lattice, motion, TAU / 25.0, 50, |_, _, loads, _| {
        force.push(total_force(loads).z);
    })
    .unwrap();
    force
}

/// The wake of a plunging wing as particles changes its loads little, the less the later they form.
#[test]
fn agrees_loads_of_a_plunging_wing_with_and_without_particles() {
    let rings = plunging(None);
    let rms = |x: &[f64]| (x.iter().map(|v| v * v).sum::<f64>() / x.len() as f64).sqrt();
    let apart = |after: usize| {
        let hybrid = plunging(Some(particles(Some(after), false, 0.25)));
        let d: Vec<f64> = hybrid.iter().zip(&rings).map(|(a, b)| a - b).collect();
        rms(&d[25..]) / rms(&rings[25..])
    };
    let [one, four, twelve] = [1, 4, 12].map(apart);
    println!(
        "plunge: particles after 1, 4, 12 rows change the force by {one:.1e} {four:.1e} {twelve:.1e}"
    );
    // A row is a quarter of a chord long, so is the core: a row away nothing but the smoothing of one
    // row differs, at four and twelve its distance makes it small.
    assert!(one < 0.03 && four < 0.003 && twelve < 0.001);
}

/// Two wings that flap about the x axis, all edges shedding, particles at once from the leading edges.
pub(crate) fn pair(t: f64) -> NodeMotion {
    let (angle, rate) = (0.5 * (3.0 * t).cos(), -1.5 * (3.0 * t).sin());
    let mut motion = NodeMotion::default();
    for side in [1.0, -1.0] {
        let turn = r1(side * angle) * r2(0.1);
        for x in rectangle(3, 4, DVec3::X, side * 2.0 * DVec3::Y) {
            // Far enough apart that no wake meets the plane between.
            let x = turn * x + side * 0.5 * DVec3::Y;
            motion.position.push(x);
            motion.velocity.push(side * rate * DVec3::X.cross(x));
        }
    }
    motion
}

pub(crate) fn flapping(stream: DVec3, wings: usize, images: Vec<Plane>) -> Lattice {
    let mut both = ["right", "left"].map(|name| Surface::grid(name, 3, 4));
    both[1].panels.iter_mut().for_each(|c| c.swap(1, 3)); // run as mirror images do
    let wings = both[..wings].to_vec();
    let settings = AirSettings {
        shedding: ALL,
        images,
        particles: Some(ParticleSettings {
            viscosity: 1e-3,
            ..particles(Some(4), true, 0.3)
        }),
        ..AirSettings::accurate(1.2, stream)
    };
    Lattice::new(wings, settings).unwrap()
}

/// Computed on one side of the plane.
pub(crate) fn one_half(lattice: Lattice, plane: Plane) -> Lattice {
    let swap = |n: usize| (0..2 * n).map(|k| (k + n) % (2 * n)).collect();
    let [node, panel] = [20, 12].map(swap);
    let pairs = MirrorPairs { plane, node, panel };
    lattice.with_mirror_symmetry(pairs).unwrap()
}

pub(crate) const STREAM: DVec3 = DVec3::new(2.0, 0.0, 0.3);

fn run(lattice: &Lattice, motion: impl Fn(f64) -> NodeMotion) -> Run {
    fly(lattice, motion, 0.1, 8, |_, _, _, _| {}).unwrap()
}

#[test]
fn invariant_hybrid_wakes_under_rotation_and_observer() {
    let turned = |motion: NodeMotion, r: DMat3, shift: DVec3, velocity: DVec3| NodeMotion {
        position: motion.position.iter().map(|x| r * *x + shift).collect(),
        velocity: motion.velocity.iter().map(|v| r * *v + velocity).collect(),
    };
    let plain = run(&flapping(STREAM, 2, vec![]), pair);
    assert!(plain.state.sheets[0].particles.len() > 50);
    let force = total_force(&plain.loads);
    let r = r1(0.7) * r3(-1.2) * r2(2.0);
    let b = run(&flapping(r * STREAM, 2, vec![]), |t| {
        turned(pair(t), r, DVec3::new(3.0, -2.0, 5.0), DVec3::ZERO)
    });
    // Roundings, amplified by eight steps of a free wake near its own filaments.
    assert!((r * force - total_force(&b.loads)).length() < 1e-9 * force.length());
    let u = DVec3::new(0.5, -1.5, 0.8);
    let b = run(&flapping(STREAM + u, 2, vec![]), |t| {
        turned(pair(t), DMat3::IDENTITY, t * u, u)
    });
    assert!((force - total_force(&b.loads)).length() < 1e-9 * force.length());
}

/// Both halves, one half with its twin, and one wing beside a plane of symmetry.
#[test]
fn agrees_hybrid_wakes_of_both_halves_one_half_and_an_image() {
    let plane = Plane {
        point: DVec3::ZERO,
        normal: DVec3::Y,
    };
    let whole = run(&flapping(STREAM, 2, vec![]), pair);
    let half = run(&one_half(flapping(STREAM, 2, vec![]), plane), pair);
    let image = run(&flapping(STREAM, 1, vec![plane]), |t| {
        let mut motion = pair(t);
        motion.position.truncate(20);
        motion.velocity.truncate(20);
        motion
    });
    let force = whole.loads.surfaces[0].force;
    for (name, other) in [("half", &half), ("image", &image)] {
        let apart = (other.loads.surfaces[0].force - force).length() / force.length();
        assert!(apart < 1e-9, "{name}: {apart:e}"); // roundings, as above
    }
    let [right, left] = [0, 1].map(|k| &half.state.sheets[k].particles);
    assert!(right.len() > 50 && right.len() == left.len());
    for i in 0..right.len() {
        let (x, a) = (right.position.get(i), right.strength.get(i));
        assert_eq!(left.position.get(i), DVec3::new(x.x, -x.y, x.z));
        assert_eq!(left.strength.get(i), DVec3::new(-a.x, a.y, -a.z));
    }
}

#[test]
fn invariant_bits_of_hybrid_wakes_for_threads_and_restart() {
    let lattice = flapping(STREAM, 2, vec![]);
    let with = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build();
        pool.unwrap().install(|| run(&lattice, pair))
    };
    let (one, three) = (with(1), with(3));
    assert_eq!(one.loads, three.loads);
    assert_eq!(one.state, three.state);
    let mut state = fly(&lattice, pair, 0.1, 7, |_, _, _, _| {}).unwrap().state;
    let (mut ws, mut loads) = (lattice.workspace(), AirLoads::default());
    lattice.convect(&mut state, 0.1, &mut ws).unwrap();
    let (mut ws, t) = (lattice.workspace(), 8.0 * 0.1);
    lattice
        .loads(&state, t, 0.1, &pair(t), &mut ws, &mut loads)
        .unwrap();
    assert_eq!(loads, one.loads);
}

/// What is dropped by age or distance leaves; what stays goes on, and the impulse of all is kept in
/// the account.
#[test]
fn exact_dropped_wakes_stay_in_the_account_of_impulse() {
    let short = |max_age, max_distance, max_rows, particles| {
        let (lattice, motion) = growing(particles);
        let settings = AirSettings {
            max_age,
            max_distance,
            max_rows,
            ..lattice.settings().clone()
        };
        let short = Lattice::new(lattice.surfaces().to_vec(), settings).unwrap();
        let mut run = fly(&short, motion, 0.25, 7, |_, _, _, _| {}).unwrap();
        short.convect(&mut run.state, 0.25, &mut run.ws).unwrap();
        let left = short.impulse(&run.state, &mut run.ws).unwrap();
        (left, run.state)
    };
    let some = Some(particles(Some(2), true, 0.2));
    for (age, far, rows, settings) in [
        (None, None, Some(3), None),
        (Some(0.8), None, None, None),
        (None, Some(2.0), None, None),
        (Some(0.8), None, None, some),
        (None, Some(2.0), None, some),
    ] {
        let (_, state) = short(age, far, rows, settings);
        let events = state.events;
        assert!(
            events.dropped_rows + events.dropped_particles > 0,
            "{events:?}"
        );
        assert!(state.impulse.cut.length() > 0.0);
        if let Some(age) = age {
            let left = &state.sheets[0].particles.shed_time;
            assert!(left.iter().all(|t| state.time - t <= age));
        }
    }
    // Dropping happens at one step: up to it nothing differs, and what is lost is in the account.
    let (rings, motion) = growing(None);
    let settings = AirSettings {
        max_rows: Some(4),
        ..rings.settings().clone()
    };
    let short = Lattice::new(rings.surfaces().to_vec(), settings).unwrap();
    let [whole, cut] = [&rings, &short].map(|lattice| {
        let mut run = fly(lattice, &motion, 0.25, 4, |_, _, _, _| {}).unwrap();
        lattice.convect(&mut run.state, 0.25, &mut run.ws).unwrap();
        let left = lattice.impulse(&run.state, &mut run.ws).unwrap();
        left + run.state.impulse.dropped()
    });
    assert!(
        (whole - cut).length() < 1e-13 * whole.length(),
        "{whole} {cut}"
    );
}

#[test]
fn exact_settings_of_particles_name_the_key() {
    type Spoil = fn(&mut AirSettings, &mut ParticleSettings);
    let spoil: [(&str, Spoil); 5] = [
        ("particles: after", |_, p| p.after = Some(0)),
        ("particles", |_, p| p.after = None),
        ("particles: radius", |_, p| p.radius = 0.0),
        ("particles: viscosity", |_, p| p.viscosity = f64::NAN),
        ("max_rows", |s, _| s.max_rows = Some(5)),
    ];
    for (name, spoil) in spoil {
        let mut all = AirSettings::benchmark(1.2, DVec3::X);
        let mut p = particles(Some(3), false, 0.1);
        spoil(&mut all, &mut p);
        all.particles = Some(p);
        let e = Lattice::new(vec![Surface::grid("wing", 2, 2)], all).unwrap_err();
        assert!(
            matches!(e, AirError::Setting { key, .. } if key == name),
            "{e}"
        );
    }
}
