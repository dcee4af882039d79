//! Whole steps allocate nothing once they have been through a size, and memory is linear in the wake.

use allocation_counter::measure;
use wingbeat_air::{
    AirLoads, AirSettings, AirState, AirWorkspace, Lattice, LeadingEdge, LoadMethod, NodeMotion,
    ParticleSettings, Stretching, Surface, VortexLift, WakeSheet,
};
use wingbeat_math::DVec3;
use wingbeat_vortex::Method;

/// Calls `f` on one thread: what rayon keeps for handing work to others is not ours to count.
fn on_one_thread<T: Send>(f: impl FnOnce() -> T + Send) -> T {
    let pool = rayon::ThreadPoolBuilder::new()
        .num_threads(1)
        .build()
        .unwrap();
    pool.install(f)
}

/// A wing, of 4 x 20 panels if nothing else is said, that flies along -x and plunges.
struct Flight {
    lattice: Lattice,
    flat: Vec<DVec3>,
    motion: NodeMotion,
    state: AirState,
    loads: AirLoads,
    ws: AirWorkspace,
    time: f64,
    /// Velocity with which the wing rises at first, over that forward \[1\].
    rise: f64,
}

const COLUMNS: usize = 20;
const STEP: f64 = 0.25;

impl Flight {
    fn new(max_rows: Option<usize>, method: Method) -> Self {
        Self::of(4, max_rows, method)
    }

    /// With so many panels along the chord.
    fn of(panels: usize, max_rows: Option<usize>, method: Method) -> Self {
        Self::with(panels, max_rows, method, |_| {})
    }

    /// With these settings changed.
    fn with(
        panels: usize,
        max_rows: Option<usize>,
        method: Method,
        change: impl Fn(&mut AirSettings),
    ) -> Self {
        let mut settings = AirSettings {
            max_rows,
            clearance: 0.01,
            summation: method,
            ..AirSettings::accurate(1.2, DVec3::ZERO)
        };
        change(&mut settings);
        let at = |k: usize| {
            let (i, j) = (k / (COLUMNS + 1), k % (COLUMNS + 1));
            DVec3::new(i as f64 / panels as f64, j as f64 / 4.0, 0.0)
        };
        let flat: Vec<DVec3> = (0..(panels + 1) * (COLUMNS + 1)).map(at).collect();
        let wing = Surface::grid("wing", panels, COLUMNS).with_rest(flat.clone());
        let lattice = Lattice::new(vec![wing], settings).unwrap();
        let velocity = vec![-DVec3::X; flat.len()];
        let motion = NodeMotion {
            position: flat.clone(),
            velocity,
        };
        Self {
            state: lattice.initial_state(&motion),
            loads: AirLoads::default(),
            ws: lattice.workspace(),
            lattice,
            flat,
            motion,
            time: 0.0,
            rise: 0.1,
        }
    }

    fn step(&mut self) {
        let (lattice, state, ws) = (&self.lattice, &mut self.state, &mut self.ws);
        if state.step > 0 {
            lattice.convect(state, STEP, ws).unwrap();
            self.time += STEP;
        }
        let (sin, cos) = self.time.sin_cos();
        for (k, x) in self.flat.iter().enumerate() {
            self.motion.position[k] = *x + DVec3::new(-self.time, 0.0, self.rise * sin);
            self.motion.velocity[k] = DVec3::new(-1.0, 0.0, self.rise * cos);
        }
        let (motion, loads) = (&self.motion, &mut self.loads);
        lattice
            .loads(state, self.time, STEP, motion, ws, loads)
            .unwrap();
        lattice.accept(state, motion, loads).unwrap();
    }
}

#[test]
fn exact_no_allocation_in_steps_of_a_wake_that_keeps_its_size() {
    on_one_thread(|| {
        // By factors, and by iteration from what the wing does to itself.
        for panels in [4, 16] {
            let mut flight = Flight::of(panels, Some(12), Method::Direct);
            (0..20).for_each(|_| flight.step());
            let five = measure(|| (0..5).for_each(|_| flight.step()));
            assert_eq!(five.count_total, 0, "{panels}");
        }
    });
}

#[test]
fn exact_no_allocation_in_steps_of_leading_edges_that_shed() {
    on_one_thread(|| {
        for panels in [4, 16] {
            let mut flight = Flight::with(panels, Some(12), Method::Direct, |s| {
                s.shedding.leading = true;
                s.leading = LeadingEdge::SuctionImplicit {
                    threshold: 0.15,
                    efficiency: 1.0,
                };
            });
            flight.rise = 1.0; // at 45 degrees at first
            (0..20).for_each(|_| flight.step());
            let mut shed = 0;
            let some = measure(|| {
                for _ in 0..10 {
                    flight.step();
                    shed += flight.loads.leaving.iter().filter(|l| **l != 0.0).count();
                }
            });
            assert!(shed > COLUMNS, "{shed}");
            assert_eq!(some.count_total, 0, "{panels}");
        }
    });
}

#[test]
fn exact_no_allocation_in_steps_with_vortex_lift() {
    on_one_thread(|| {
        let mut flight = Flight::with(4, Some(12), Method::Direct, |s| {
            s.shedding.leading = true;
            s.loads = LoadMethod::Joukowski;
            s.leading = LeadingEdge::VortexLift(VortexLift::default());
        });
        flight.rise = 1.0; // at 45 degrees at first
        (0..20).for_each(|_| flight.step());
        let five = measure(|| (0..5).for_each(|_| flight.step()));
        assert_eq!(five.count_total, 0);
    });
}

/// Rows become particles, and the oldest of these go.
#[test]
fn exact_no_allocation_in_steps_of_particles_that_come_and_go() {
    on_one_thread(|| {
        let mut flight = Flight::with(4, None, Method::Direct, |s| {
            s.max_age = Some(3.0);
            s.particles = Some(ParticleSettings {
                after: Some(4),
                leading_at_once: false,
                radius: 1.0, // one for each filament
                viscosity: 0.0,
                stretching: Stretching::Transpose,
            });
        });
        (0..40).for_each(|_| flight.step());
        let before = flight.state.events.dropped_particles;
        let five = measure(|| (0..5).for_each(|_| flight.step()));
        assert!(flight.state.events.dropped_particles > before);
        assert_eq!(five.count_total, 0);
    });
}

/// A flat sheet of `rows` rows behind the wing, as if it had left it long ago.
fn old_wake(rows: usize, looks_back: bool) -> WakeSheet {
    let mut sheet = WakeSheet {
        columns: COLUMNS,
        converted: vec![0; COLUMNS],
        ..WakeSheet::default()
    };
    for r in (0..rows).rev() {
        for c in 0..=COLUMNS {
            let x = DVec3::new(1.3 + STEP * r as f64, c as f64 / 4.0, 0.0);
            sheet.nodes.push(x);
            if looks_back {
                sheet.velocity.push(DVec3::ZERO);
            }
        }
        sheet.gamma.extend([1e-3; COLUMNS]);
        sheet.shed_time.push(-STEP * r as f64);
    }
    sheet
}

/// State and workspace together, for the direct sum and for the tree. Arrays that grow double: up to
/// half of each is unused.
#[test]
fn exact_memory_is_linear_in_the_wake() {
    on_one_thread(|| {
        let methods = [
            (Method::Direct, 850.0),
            (Method::Single, 1050.0),
            (Method::Tree, 1950.0),
        ];
        for (method, most) in methods {
            let held = |rows: usize| {
                let mut flown = None;
                let info = measure(|| {
                    let mut flight = Flight::new(None, method);
                    flight.step();
                    flight.state.sheets[0] = old_wake(rows, true);
                    flight.step();
                    flight.step();
                    flown = Some(flight);
                });
                info.bytes_current as f64
            };
            held(1); // what threads keep for themselves
            let empty = held(1);
            for rows in [150, 300, 450] {
                let per_ring = (held(rows) - empty) / (rows * COLUMNS) as f64;
                println!("{method:?}: {rows} rows, {per_ring:.0} bytes a ring");
                assert!(
                    per_ring < most,
                    "{method:?}, {rows} rows: {per_ring} bytes a ring"
                );
            }
        }
    });
}
