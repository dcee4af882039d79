//! Bad input: each gives an error that names what is wrong.

use wingbeat_math::DVec3;
use wingbeat_model::motion::{Fourier, PeriodicSpline, SmoothTriangle};
use wingbeat_model::planform::{Beta, ChordSize};
use wingbeat_model::species::{FlyOptions, drosophila_melanogaster};
use wingbeat_model::{
    AngleLaw, BodyMass, MassInput, ModelError, Planform, Profile, Revolution, Side, Start,
    WingMotion, WingShape,
};

fn says<T: std::fmt::Debug>(result: Result<T, ModelError>, parts: &[&str]) {
    let text = result.unwrap_err().to_string();
    for part in parts {
        assert!(text.contains(part), "`{text}` does not say `{part}`");
    }
}

#[test]
fn invariant_bad_tables_name_the_row() {
    let good = [
        (0.0, 0.0),
        (0.25, 1.0),
        (0.5, 0.0),
        (0.75, -1.0),
        (1.0, 0.0),
    ];
    let with = |row: usize, value: (f64, f64)| {
        let mut rows = good;
        rows[row - 1] = value;
        PeriodicSpline::new("phi table", &rows)
    };
    assert!(PeriodicSpline::new("phi table", &good).is_ok());
    says(with(3, (0.5, f64::NAN)), &["phi table", "row 3", "NaN"]);
    says(with(4, (0.5, -1.0)), &["row 4", "increase"]);
    says(with(5, (1.0, 0.3)), &["row 5", "not periodic", "0.3"]);
    says(with(5, (0.9, 0.0)), &["row 5", "spans 0.9"]);
    says(
        PeriodicSpline::new("phi table", &good[..3]),
        &["at least 4"],
    );
    says(PeriodicSpline::new("phi table", &[]), &["at least 4"]);
}

#[test]
fn invariant_zero_panels_and_bad_sizes_are_refused() {
    let rectangle = |chord: f64| Planform::Rectangle {
        chord,
        span: 1.0,
        root_offset: 0.0,
        axis_fraction: 0.25,
    };
    let mesh = |p, rows, cols| WingShape::uniform(p, rows, cols).mesh("left", Side::Left);
    says(mesh(rectangle(1.0), 0, 3), &["left.rows = 0", ">= 1"]);
    says(mesh(rectangle(1.0), 3, 0), &["left.cols = 0"]);
    says(mesh(rectangle(f64::NAN), 3, 3), &["chord = NaN"]);
    says(mesh(rectangle(-1.0), 3, 3), &["chord = -1"]);
    let beta = |r2_hat: f64, least_chord: f64| {
        Planform::Beta(Beta {
            length: 1.0,
            size: ChordSize::Mean(0.3),
            r2_hat,
            root_offset: 0.0,
            axis_fraction: 0.25,
            least_chord,
        })
    };
    says(
        mesh(beta(0.95, 0.2), 3, 3),
        &["r2_hat = 0.95", "out of reach"],
    );
    says(mesh(beta(0.55, 0.0), 3, 3), &["least_chord = 0"]);
    let body = |stations, meridians, length| {
        Revolution::ellipsoid(DVec3::ZERO, length, 0.1, [stations, meridians]).mesh("head")
    };
    says(body(1, 8, 1.0), &["head.stations = 1"]);
    says(body(4, 7, 1.0), &["head.meridians = 7", "even"]);
    says(body(4, 8, f64::INFINITY), &["head.length = inf"]);
    let table = Revolution {
        profile: Profile::Table(vec![(0.0, 0.0), (0.4, 1.0), (0.4, 0.5), (1.0, 0.0)]),
        ..Revolution::ellipsoid(DVec3::ZERO, 1.0, 0.1, [4, 8])
    };
    says(table.mesh("head"), &["head.profile", "row 3"]);
}

#[test]
fn invariant_bad_masses_are_refused() {
    let shape = Revolution::ellipsoid(DVec3::ZERO, 1.0, 0.1, [4, 8]);
    let part = |mass| wingbeat_model::BodyPart::revolution("head", &shape, &mass);
    says(part(MassInput::Total(-1.0)), &["head.mass = -1"]);
    says(part(MassInput::Density(f64::NAN)), &["head.mass = NaN"]);
    says(
        part(MassInput::SpanTable(vec![(0.0, 1.0)])),
        &["head.mass", "wings only"],
    );
    let mut impossible = wingbeat_math::MassProperties::point(1.0, DVec3::X);
    impossible.inertia.x_axis.x = -1.0;
    says(part(MassInput::Given(impossible)), &["head", "inertia"]);
    let parts = vec![part(MassInput::Total(1.0)).unwrap()];
    let animal = wingbeat_model::Animal::new("x", BodyMass::Total(-2.0), parts, Vec::new());
    says(animal, &["body.mass = -2"]);
}

#[test]
fn invariant_a_hinge_far_outside_the_body_is_refused() {
    let mut fly = drosophila_melanogaster(&FlyOptions::default()).unwrap();
    fly.wings[1].hinge_b = DVec3::new(0.6, 0.36, -0.15); // millimetres taken for metres
    says(fly.check(), &["hinge of wing `right`", "half their extent"]);
    fly.wings[1].hinge_b = DVec3::new(0.0, 0.4e-3 + 1.2e-3, 0.0); // just inside the limit
    assert_eq!(fly.check(), Ok(()));
    fly.wings[1].hinge_b.y = f64::NAN;
    says(fly.check(), &["right.hinge[1] = NaN"]);
}

#[test]
fn invariant_bad_motions_name_wing_and_number() {
    let mut motion = WingMotion::fixed(0.0, [0.0; 3]);
    motion.frequency = -1.0;
    says(motion.check("left"), &["left.motion.frequency = -1"]);
    motion.frequency = 1.0;
    motion.start = Start::Smooth { duration: 0.0 };
    says(motion.check("left"), &["left.motion.start.duration = 0"]);
    motion.start = Start::Impulsive;
    motion.angles.phi = AngleLaw::SmoothTriangle(SmoothTriangle {
        amplitude: 1.0,
        shape: 1.0,
        shift: 0.0,
        mean: 0.0,
    });
    says(motion.check("left"), &["phi.shape = 1", "triangle"]);
    motion.angles.phi = AngleLaw::Fourier(Fourier {
        mean: 0.0,
        cos: vec![1.0, f64::NAN],
        sin: vec![],
    });
    says(motion.check("left"), &["phi.cos[1] = NaN"]);
    let options = FlyOptions {
        scale: 0.0,
        ..Default::default()
    };
    says(drosophila_melanogaster(&options), &["scale = 0"]);
}
