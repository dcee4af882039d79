//! Steps in time allocate nothing after their first.

mod common;
mod plate;

use allocation_counter::measure;
use common::{coupled, straight};
use plate::rectangle;
use wingbeat_math::DVec3;
use wingbeat_structure::shell::ShellSection;
use wingbeat_structure::*;

/// A frame that accelerates as it turns.
const FRAME: FrameMotion = FrameMotion {
    acceleration: DVec3::new(0.3, -0.2, 0.5),
    w: DVec3::new(0.1, 0.4, -0.3),
    w_dot: DVec3::new(-0.2, 0.1, 0.6),
};

/// Step \[s\].
const H: f64 = 1e-3;

fn damped(body: StructureBuilder) -> Structure {
    let damping = Damping {
        strain_rate: 1e-4,
        mass: 0.1,
    };
    body.damping(damping).build().unwrap()
}

/// A square of two by two panels, all numbers held at one edge or only places all round.
fn sheet(section: ShellSection, is_membrane: bool) -> Structure {
    let mesh = rectangle(2, 2, 1.0, 1.0);
    let mut body = StructureBuilder::new(mesh.rest.clone());
    for shell in mesh.shells(|_| Some(section)).unwrap() {
        body = body.element(shell);
    }
    for (n, x) in mesh.rest.position.iter().enumerate() {
        let is_inside = [x.x, x.y].iter().all(|s| (0.1..0.9).contains(s));
        if is_membrane && !is_inside {
            body = body.hold(n, [true, true, true, false, false, false]);
        } else if x.x < 0.1 {
            body = body.clamp(n);
        }
    }
    damped(body)
}

/// A beam, a sheet and a membrane under tension.
fn bodies() -> [Structure; 3] {
    let lamina = Lamina::isotropic(1e4, 0.3, 1e-2, 1.0);
    let stretched = Lamina {
        prestress: [1.0, 1.0, 0.0],
        ..lamina
    };
    let [plain, mut soft] = [lamina, stretched].map(|l| l.section().unwrap());
    soft.bending *= 1e-3;
    [
        damped(straight(3, 1.0, &coupled()).clamp(0)),
        sheet(plain, false),
        sheet(soft, true),
    ]
}

/// A body in motion under loads that stay.
struct Swing {
    body: Structure,
    method: GeneralizedAlpha,
    solver: Solver,
    state: State,
    trial: Trial,
    given: Vec<f64>,
    residual: Vec<f64>,
    change: Vec<f64>,
}

impl Swing {
    fn new(body: Structure) -> Self {
        let state = State::at_rest(body.rest().clone());
        Self {
            method: GeneralizedAlpha::new(0.9).unwrap(),
            solver: Solver::new(&body),
            trial: Trial::of(&state),
            given: vec![1e-3; NODE * body.nodes()],
            residual: vec![0.0; NODE * body.nodes()],
            change: vec![],
            state,
            body,
        }
    }

    /// All that a coupled flight asks in a step, the loads having these derivatives.
    fn step(&mut self, loads: &LoadTangent<'_>) {
        let (body, solver, trial) = (&self.body, &mut self.solver, &mut self.trial);
        self.method.predict(body, &self.state, H, trial);
        solver.look_ahead_from_start(trial);
        for pass in 0..3 {
            let residual = solver.residual(body, trial, &FRAME, &self.given);
            self.residual.clone_from_slice(residual);
            match pass {
                0 => solver.factor_ahead(body, trial, &FRAME, loads),
                _ => solver.factor(body, trial, &FRAME, loads),
            }
            .unwrap();
            let response = solver.frame_response(body, trial, &FRAME, loads);
            assert!(response[0][0] < 0.0);
            self.change.clear();
            let free = body.free_numbers().iter();
            self.change.extend(free.map(|&k| -self.residual[k]));
            solver.solve(&mut self.change);
            trial.add(body, &self.change);
        }
        solver.residual(body, trial, &FRAME, &self.given);
        solver.accept(trial, &mut self.state);
    }
}

#[test]
fn exact_no_allocation_in_steps_after_the_first() {
    for body in bodies() {
        let n = NODE * body.nodes();
        let held_back: Vec<f64> = (0..n * n)
            .map(|k| if k % (n + 1) == 0 { -1e-3 } else { -1e-6 })
            .collect();
        let all = Some(&held_back[..]);
        let none = LoadTangent::default();
        let answers = [
            none,
            LoadTangent {
                velocity: all,
                ..none
            },
            LoadTangent {
                position: all,
                velocity: all,
                acceleration: all,
            },
        ];
        let mut swing = Swing::new(body);
        let mut steps = || answers.iter().for_each(|loads| swing.step(loads));
        steps();
        let counted = measure(|| (0..5).for_each(|_| steps()));
        assert_eq!(counted.count_total, 0, "{n} numbers");
    }
    assert_eq!(
        measure(|| drop(std::hint::black_box(vec![0_u8; 10]))).count_total,
        1
    ); // the counter counts
}
