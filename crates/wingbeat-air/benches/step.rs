//! The parts of a step of the lattice: circulations and loads, moving the wake, tree and direct sum.
//!
//! `cargo bench -p wingbeat-air --bench step`

use divan::{Bencher, counter::ItemsCount};
use wingbeat_air::{
    AirLoads, AirSettings, AirState, AirWorkspace, Lattice, NodeMotion, SheddingKinds, Surface,
};
use wingbeat_math::DVec3;
use wingbeat_vortex::{CoreModel, FastSettings, FastSum, Method, Points};

#[path = "../../wingbeat-vortex/tests/wakes/mod.rs"]
mod wakes;

fn main() {
    divan::main();
}

/// Two plunging wings, of 5 x 10 panels if nothing else is said, that shed all around but at the root.
struct Flight {
    panels: [usize; 2],
    lattice: Lattice,
    state: AirState,
    loads: AirLoads,
    ws: AirWorkspace,
    time: f64,
}

const STEP: f64 = 0.2;

impl Flight {
    /// After so many steps.
    fn new(steps: usize) -> Self {
        Self::of([5, 10], false, steps)
    }

    /// With so many panels along chord and span, their shape at rest given or not.
    fn of(panels: [usize; 2], rest: bool, steps: usize) -> Self {
        Self::with(panels, rest, steps, |_| {})
    }

    /// As insects fly: algebraic cores, wakes in single precision.
    fn of_algebraic_cores(steps: usize) -> Self {
        let core = CoreModel::Algebraic {
            radius: 0.05,
            viscosity: 1e-3,
        };
        Self::with([5, 10], true, steps, |settings| {
            (settings.bound_core, settings.wake_core) = (core, core);
            settings.summation = Method::Auto;
        })
    }

    /// With these settings changed.
    fn with(
        panels: [usize; 2],
        rest: bool,
        steps: usize,
        change: impl Fn(&mut AirSettings),
    ) -> Self {
        let core = CoreModel::LambOseen {
            radius: 0.05,
            viscosity: 1e-3,
        };
        let mut settings = AirSettings {
            bound_core: core,
            wake_core: core,
            wake_overlap: 1.0,
            shedding: SheddingKinds {
                tip: true,
                leading: true,
                ..SheddingKinds::TRAILING
            },
            max_rows: Some(steps),
            summation: Method::Direct,
            ..AirSettings::accurate(1.2, DVec3::ZERO)
        };
        change(&mut settings);
        let wings = [("right", 1.0), ("left", -1.0)].map(|(name, side)| {
            let surface = Surface::grid(name, panels[0], panels[1]);
            match rest {
                true => surface.with_rest(wing(panels, side)),
                false => surface,
            }
        });
        let lattice = Lattice::new(wings.to_vec(), settings).expect("two wings");
        let mut flight = Self {
            panels,
            state: lattice.initial_state(&motion(panels, 0.0)),
            loads: AirLoads::default(),
            ws: lattice.workspace(),
            lattice,
            time: 0.0,
        };
        flight.load();
        (0..steps).for_each(|_| flight.step());
        flight
    }

    fn load(&mut self) {
        self.lattice
            .loads(
                &self.state,
                self.time,
                STEP,
                &motion(self.panels, self.time),
                &mut self.ws,
                &mut self.loads,
            )
            .expect("loads");
    }

    fn step(&mut self) {
        let now = motion(self.panels, self.time);
        self.lattice
            .accept(&mut self.state, &now, &self.loads)
            .expect("computed before");
        self.lattice
            .convect(&mut self.state, STEP, &mut self.ws)
            .expect("accepted");
        self.time += STEP;
        self.load();
    }
}

fn wing([rows, columns]: [usize; 2], side: f64) -> Vec<DVec3> {
    let at = |k: usize| [k / (columns + 1), k % (columns + 1)];
    let place = |[i, j]: [usize; 2]| {
        let (x, y) = (i as f64 / rows as f64, 3.0 * j as f64 / columns as f64);
        DVec3::new(x, side * (0.2 + y), 0.0)
    };
    (0..(rows + 1) * (columns + 1))
        .map(|k| place(at(k)))
        .collect()
}

fn motion(panels: [usize; 2], t: f64) -> NodeMotion {
    let shift = DVec3::new(-t, 0.0, 0.3 * t.sin());
    let velocity = DVec3::new(-1.0, 0.0, 0.3 * t.cos());
    let nodes = [1.0, -1.0].into_iter().flat_map(|side| wing(panels, side));
    let position: Vec<DVec3> = nodes.map(|x| x + shift).collect();
    NodeMotion {
        velocity: vec![velocity; position.len()],
        position,
    }
}

/// Influence matrix, its factors, circulations and loads in a frozen wake whose velocities are known:
/// what each pass of the corrector costs.
#[divan::bench]
fn influence_and_loads(bencher: Bencher) {
    let mut flight = Flight::new(40);
    bencher.bench_local(|| flight.load());
}

/// The same for finer wings, in little wake, with and without the shapes at rest.
#[divan::bench(args = [[8, 12], [8, 16], [8, 20], [12, 20], [12, 40], [16, 60]], consts = [true, false], sample_count = 10, sample_size = 1)]
fn influence_of_fine_wings<const REST: bool>(bencher: Bencher, panels: [usize; 2]) {
    let mut flight = Flight::of(panels, REST, 2);
    bencher.bench_local(|| flight.load());
}

/// A whole step with so many rows of wake, of 50 rings each.
#[divan::bench(args = [20, 40, 80])]
fn step(bencher: Bencher, rows: usize) {
    let mut flight = Flight::new(rows);
    bencher
        .counter(ItemsCount::new(50 * rows))
        .bench_local(|| flight.step());
}

/// The same as insects fly.
#[divan::bench(args = [20, 40, 80])]
fn step_of_algebraic_cores(bencher: Bencher, rows: usize) {
    let mut flight = Flight::of_algebraic_cores(rows);
    bencher
        .counter(ItemsCount::new(50 * rows))
        .bench_local(|| flight.step());
}

/// Velocities at the nodes of a hover-like wake of so many edges.
#[divan::bench(args = [10_000, 20_000, 40_000], consts = [true, false], sample_count = 5, sample_size = 1)]
fn wake_on_itself<const TREE: bool>(bencher: Bencher, edges: usize) {
    let model = CoreModel::Vatistas { radius: 0.02 };
    let net = wakes::hover(model, edges);
    let method = if TREE { Method::Tree } else { Method::Direct };
    let mut sum = FastSum::new(FastSettings {
        method,
        ..FastSettings::new(model)
    });
    let mut out = Points::zeros(net.nodes.len());
    bencher.counter(ItemsCount::new(net.len())).bench_local(|| {
        sum.load_network(&net);
        sum.add_velocity(&net.nodes, &mut out)
    });
}
