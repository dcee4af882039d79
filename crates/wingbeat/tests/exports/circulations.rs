//! Circulations in frames: what they induce is the velocity of the air.

use wingbeat::math::DVec3;
use wingbeat::results::frames::{Frame, Mesh};
use wingbeat::results::particles::Cloud;

use crate::support::{Scratch, flown, wingbeat};

/// Velocity at `x` that a straight vortex filament of unit circulation from `a` to `b` induces [1/m].
fn filament(x: DVec3, a: DVec3, b: DVec3) -> DVec3 {
    let (r1, r2) = (x - a, x - b);
    let cross = r1.cross(r2);
    let along = (b - a).dot(r1.normalize() - r2.normalize());
    let square = cross.length_squared().max(f64::MIN_POSITIVE);
    cross * along / square / (4.0 * std::f64::consts::PI)
}

/// Velocity that vortex filaments along the edges of the panels of a frame induce, each panel with its
/// circulation, right-handed about its corners, and edges that a panel which has become particles shares with
/// one that has not with the shared circulation of the former, too [m/s]; places and velocity in picture axes.
fn induced(mesh: &Mesh, x: [f64; 3]) -> DVec3 {
    let x = DVec3::from(x);
    let corner = |q: &[usize; 4], k: usize| DVec3::from(mesh.points[q[k % 4]]);
    let gamma = mesh.cell("circulation_m2_per_s");
    let ring = |(quad, gamma): (&[usize; 4], &f64)| -> DVec3 {
        let edge = |k: usize| filament(x, corner(quad, k), corner(quad, k + 1));
        (0..4).map(|k| *gamma * edge(k)).sum()
    };
    let rings: DVec3 = mesh.quads.iter().zip(gamma).map(ring).sum();
    let shared = mesh.cell("shared_circulation_m2_per_s");
    let is_ring = |n: &usize| shared[*n] == 0.0;
    let has = |n: usize, p: usize| mesh.quads[n].contains(&p);
    let gone = (0..shared.len()).filter(|n| !is_ring(n));
    let edges = gone.flat_map(|n| (0..4).map(move |k| (n, k)));
    let borders = edges.filter(|&(n, k)| {
        let ends = [k, k + 1].map(|k| mesh.quads[n][k % 4]);
        (0..shared.len()).any(|m| is_ring(&m) && ends.iter().all(|p| has(m, *p)))
    });
    let kept: DVec3 = borders
        .map(|(n, k)| {
            let quad = &mesh.quads[n];
            shared[n] * filament(x, corner(quad, k), corner(quad, k + 1))
        })
        .sum();
    rings + kept
}

/// Velocity that the vortex particles of a frame induce, each as if at a point [m/s]; picture axes.
fn of_particles(cloud: &Cloud, x: [f64; 3]) -> DVec3 {
    let all = cloud.points.iter().zip(cloud.strength.iter());
    all.map(|(at, strength)| {
        let r = DVec3::from(x) - DVec3::from(*at);
        DVec3::from(*strength).cross(r) / (4.0 * std::f64::consts::PI * r.length().powi(3))
    })
    .sum()
}

/// Circulations in files are those of one convention: Biot and Savart's law over surfaces, wakes and particles
/// of one frame gives the velocity of the air.
#[test]
fn agrees_the_velocity_of_exported_circulations_with_that_of_the_flight() {
    // Measured 4e-8 of what is induced (cores smooth filaments near by); with the other sign of the surfaces it
    // is its size. Particles smooth more: up to 1e-5; without what edges share 0.6 to 0.75.
    let particles: [(&[&str], f64); 2] = [
        (&[], 1e-6),
        (&["--set=air.particles={after_rows=4,radius_m=0.02}"], 5e-5),
    ];
    for (set, tolerance) in particles {
        let scratch = Scratch::new(&format!("circulations-{}", set.len()));
        let run = [
            "run",
            "rectangular-wing",
            "--quiet",
            "--out=run",
            "--set=time.steps=12",
            "--set=output.keep_checkpoint=true",
            "--set=output.frames_every=12",
            "--set=output.page=false",
        ];
        flown(&scratch.0, &[&run, set].concat());
        let dir = scratch.0.join("run");
        let frame = Frame::read(&dir, 12).unwrap();
        assert_eq!(frame.particles.points.is_empty(), set.is_empty());
        let places = [
            [0.2, 0.1, 0.05],
            [0.0, 0.2, 0.3],
            [-0.3, 0.6, -0.3],
            [0.0, 0.0, -0.2],
        ];
        let stream = DVec3::new(-10.0, 0.0, 0.0);
        for [x, y, z] in places {
            let point = format!("--point={x},{y},{z}");
            let out = wingbeat(&scratch.0, &["velocity", "run", "--json", &point]);
            let said: serde_json::Value = serde_json::from_slice(&out.stdout).unwrap();
            let of = |k: usize| said["points"][0]["velocity_m_s"][k].as_f64().unwrap();
            let flown = DVec3::new(of(0), of(1), of(2)) - stream;
            let at = [x, -y, -z];
            let sum = induced(&frame.surfaces, at)
                + induced(&frame.wakes, at)
                + of_particles(&frame.particles, at);
            let computed = DVec3::new(sum.x, -sum.y, -sum.z);
            let difference = (computed - flown).length() / flown.length();
            println!("{x} {y} {z}: {difference:.1e} of {:.3}", flown.length());
            assert!(difference < tolerance, "{x} {y} {z}: {computed} {flown}");
        }
    }
}
