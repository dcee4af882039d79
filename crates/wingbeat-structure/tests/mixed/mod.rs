//! Veins and membranes: beams and shells that share nodes.

use std::f64::consts::PI;

use wingbeat_math::{DVec3, MassProperties};
use wingbeat_structure::shell::ShellSection;
use wingbeat_structure::*;

/// Length and width of the strip, its thickness, the radius of its veins.
const LENGTH: f64 = 1.0;
const WIDTH: f64 = 0.1;
const THICKNESS: f64 = 2e-3;
const RADIUS: f64 = 3e-3;

/// A lattice over `a` x `b` in the 1-2 plane, rows along axis 2.
fn lattice([rows, cols]: [usize; 2], [a, b]: [f64; 2]) -> ShellMesh {
    let point = |k: usize| {
        let (i, j) = (k / (cols + 1), k % (cols + 1));
        DVec3::new(a * j as f64 / cols as f64, b * i as f64 / rows as f64, 0.0)
    };
    let points: Vec<DVec3> = (0..(rows + 1) * (cols + 1)).map(point).collect();
    ShellMesh::grid(&points, rows, cols).unwrap()
}

/// Shells on all panels, and beams of `vein` along the rows given.
fn stiffened(
    mesh: &ShellMesh,
    sheet: ShellSection,
    vein: &BeamSection,
    rows: &[usize],
    cols: usize,
) -> StructureBuilder {
    let mut builder = StructureBuilder::new(mesh.rest.clone());
    for shell in mesh.shells(|_| Some(sheet)).unwrap() {
        builder = builder.element(shell);
    }
    for row in rows {
        for j in 0..cols {
            let nodes = [0, 1].map(|k| row * (cols + 1) + j + k);
            let beam = Beam::straight(&mesh.rest, nodes, DVec3::Y, vein).unwrap();
            builder = builder.element(beam);
        }
    }
    builder
}

/// A strip of E = 1 without lateral contraction.
fn strip() -> ShellSection {
    Lamina::isotropic(1.0, 0.0, THICKNESS, 1.0)
        .section()
        .unwrap()
}

/// A round vein: EI, GJ, mass per length.
fn vein() -> (BeamSection, [f64; 3]) {
    let (young, density) = (20.0, 3.0);
    let second = 0.25 * PI * RADIUS.powi(4);
    let area = PI * RADIUS * RADIUS;
    let [bending, torsion] = [young * second, young / 2.6 * 2.0 * second];
    let stiffness = Stiffness {
        axial: young * area,
        shear: [young * area; 2],
        torsion,
        bending: [bending; 2],
    };
    let mass = density * area;
    let section =
        BeamSection::new(&stiffness).with_mass(mass, [0.0; 2], [0.25 * mass * RADIUS * RADIUS; 2]);
    (section, [bending, torsion, mass])
}

/// EI and mass per length of the strip with veins along both edges.
fn composite() -> [f64; 2] {
    let (_, [bending, _, mass]) = vein();
    let sheet = WIDTH * THICKNESS.powi(3) / 12.0;
    [sheet + 2.0 * bending, WIDTH * THICKNESS + 2.0 * mass]
}

/// A cantilever clamped at all nodes of one end.
fn cantilever(cols: usize) -> Structure {
    let mesh = lattice([2, cols], [LENGTH, WIDTH]);
    let mut builder = stiffened(&mesh, strip(), &vein().0, &[0, 2], cols);
    for row in 0..3 {
        builder = builder.clamp(row * (cols + 1));
    }
    builder.build().unwrap()
}

/// `P L^3 / (3 EI)` with the stiffness of the composite section, and the shear of the sheet that is smaller
/// than the tolerance.
#[test]
fn exact_strip_with_two_veins_bends_as_a_composite_beam() {
    let cols = 4;
    let body = cantilever(cols);
    let [ei, _] = composite();
    let force = 1e-6 * ei;
    // By what the section carries: veins at the edges, the sheet a quarter, a half and a quarter.
    let sheet = WIDTH * THICKNESS.powi(3) / 12.0 / ei;
    let share = [0.5 - 0.25 * sheet, 0.5 * sheet, 0.5 - 0.25 * sheet];
    let loads: Vec<NodeLoad> = (0..3)
        .map(|row| NodeLoad {
            node: row * (cols + 1) + cols,
            force: DVec3::Z * force * share[row],
            moment: DVec3::ZERO,
            follows: false,
        })
        .collect();
    let settings = StaticSettings::default();
    let at = equilibrium(
        &body,
        body.rest(),
        &FrameMotion::REST,
        &loads[..],
        &settings,
    )
    .unwrap();
    let found = at.position[2 * (cols + 1) + cols].z;
    let exact = force * LENGTH.powi(3) / (3.0 * ei);
    assert!(
        (found / exact - 1.0).abs() < 1e-4,
        "{}",
        found / exact - 1.0
    );
}

/// Twisted evenly, `w = k x y`: energy `(4 D66 A + GJ L) k^2 / 2`, a vein along its middle.
#[test]
fn exact_energy_of_a_twisted_strip_with_a_vein() {
    let cols = 3;
    let mesh = lattice([2, cols], [LENGTH, WIDTH]);
    let (section, [_, torsion, _]) = vein();
    let body = stiffened(&mesh, strip(), &section, &[1], cols)
        .build()
        .unwrap();
    let k = 1e-6;
    let mut at = mesh.rest.clone();
    let twisted = mesh.rest.position.iter().flat_map(|x| {
        let y = x.y - 0.5 * WIDTH;
        [0.0, 0.0, k * x.x * y, k * x.x, -k * y, 0.0]
    });
    at.moved(&twisted.collect::<Vec<_>>());
    let mut out = ElementForces::default();
    let parts = body
        .elements()
        .iter()
        .map(|e| e.internal(&at, false, &mut out));
    let energy: f64 = parts.sum();
    let d66 = strip().bending.z_axis.z;
    let exact = 0.5 * k * k * (4.0 * d66 * LENGTH * WIDTH + torsion * LENGTH);
    // Larger turns stretch the sheet: k^2 = 1e-12 over (h / L)^2.
    assert!(
        (energy / exact - 1.0).abs() < 1e-7,
        "{}",
        energy / exact - 1.0
    );
}

/// `3.51602 sqrt(EI / (m L^4))` of the composite section, at second order of the elements.
#[test]
fn order_frequency_of_a_strip_with_two_veins() {
    let [ei, mass] = composite();
    let exact = 3.516_015_269 * (ei / (mass * LENGTH.powi(4))).sqrt();
    let error = |cols: usize| {
        let body = cantilever(cols);
        let all = modes(&body, body.rest(), &FrameMotion::REST, None).unwrap();
        // Out of the plane: the strip is 50 times as stiff in it.
        all[0].frequency() / exact - 1.0
    };
    let [coarse, fine] = [6, 12].map(error);
    assert!(fine.abs() < 1e-3, "{coarse:e} {fine:e}");
    assert!(
        (1.5..2.5).contains(&(coarse / fine).log2()),
        "{coarse:e} {fine:e}"
    );
}

/// Mass, first moment and inertia of a sheet with veins are the sums of those of its parts.
#[test]
fn exact_mass_properties_of_a_strip_with_two_veins() {
    let body = cantilever(5);
    let found = body.mass_properties(body.rest()) + body.remainder();
    let (_, [_, _, mass]) = vein();
    let rod = |y: f64| {
        let about = mass * LENGTH * LENGTH.powi(2) / 12.0;
        let round = 0.25 * mass * LENGTH * RADIUS * RADIUS;
        let inertia = DVec3::new(2.0 * round, about + round, about + round);
        let centre = DVec3::new(0.5 * LENGTH, y, 0.0);
        MassProperties::about_centre(
            mass * LENGTH,
            centre,
            wingbeat_math::DMat3::from_diagonal(inertia),
        )
    };
    let sheet = WIDTH * THICKNESS * LENGTH;
    let slab = |a: f64, b: f64| sheet * (a * a + b * b) / 12.0;
    let inertia = DVec3::new(
        slab(WIDTH, THICKNESS),
        slab(LENGTH, THICKNESS),
        slab(LENGTH, WIDTH),
    );
    let centre = DVec3::new(0.5 * LENGTH, 0.5 * WIDTH, 0.0);
    let plate =
        MassProperties::about_centre(sheet, centre, wingbeat_math::DMat3::from_diagonal(inertia));
    let exact = plate + rod(0.0) + rod(WIDTH);
    assert!((found.mass / exact.mass - 1.0).abs() < 1e-14);
    assert!((found.first_moment - exact.first_moment).length() < 1e-14 * exact.mass);
    // The rod's own turn about its diameters is left to its ends.
    let gap = (found.inertia - exact.inertia).to_cols_array();
    assert!(gap.iter().all(|e| e.abs() < 1e-14), "{gap:?}");
}

/// A square membrane of side 1 under tension 1, held at its rim, with bending stiffness `factor` times that of a sheet.
fn membrane(n: usize, factor: f64) -> Structure {
    let mesh = lattice([n, n], [1.0, 1.0]);
    let lamina = Lamina {
        prestress: [1.0, 1.0, 0.0],
        ..Lamina::isotropic(1e4, 0.3, 1e-2, 1.0)
    };
    let mut sheet = lamina.section().unwrap();
    sheet.bending *= factor;
    let mut builder = StructureBuilder::new(mesh.rest.clone());
    for shell in mesh.shells(|_| Some(sheet)).unwrap() {
        builder = builder.element(shell);
    }
    for (node, x) in mesh.rest.position.iter().enumerate() {
        if [x.x, x.y].iter().any(|s| *s < 1e-9 || *s > 1.0 - 1e-9) {
            builder = builder.hold(node, [true, true, true, false, false, false]);
        }
    }
    builder.build().unwrap()
}

/// Height of the middle of the membrane under the pressure p.
fn height(n: usize, factor: f64, p: f64) -> f64 {
    let body = membrane(n, factor);
    let node = |k: usize| {
        let part = |i: usize| if i == 0 || i == n { 0.5 } else { 1.0 };
        part(k / (n + 1)) * part(k % (n + 1)) / (n * n) as f64
    };
    let loads: Vec<NodeLoad> = (0..(n + 1) * (n + 1))
        .map(|k| NodeLoad {
            node: k,
            force: DVec3::Z * p * node(k),
            moment: DVec3::ZERO,
            follows: false,
        })
        .collect();
    let settings = StaticSettings::default();
    let at = equilibrium(
        &body,
        body.rest(),
        &FrameMotion::REST,
        &loads[..],
        &settings,
    )
    .unwrap();
    at.position[(n / 2) * (n + 2)].z
}

/// Under little pressure `0.0736713 p a^2 / N` [Timoshenko & Goodier 1970, art. 107: the soap film], the smaller
/// bending is the better.
#[test]
fn order_deflection_of_a_stretched_membrane_under_pressure() {
    let exact = 0.073_671_35;
    let error = |n: usize| height(n, 1e-9, 1e-4) / 1e-4 / exact - 1.0;
    let [coarse, fine] = [8, 16].map(error);
    assert!(fine.abs() < 5e-3, "{coarse:e} {fine:e}");
    assert!(
        (1.7..2.3).contains(&(coarse / fine).log2()),
        "{coarse:e} {fine:e}"
    );
}

/// However little it bends, Newton's iteration converges, also where pressure stretches the sheet to many times
/// its tension; what bending adds goes with its stiffness, and 1e-12 of it is a membrane.
#[test]
fn limit_membrane_of_ever_less_bending() {
    let [stiff, soft, softer, none] = [1.0, 1e-2, 1e-4, 1e-12].map(|f| height(8, f, 20.0));
    let [a, b, c] = [stiff, soft, softer].map(|h| (h / none - 1.0).abs());
    assert!(a < 0.1 && b < a && c < 0.3 * b, "{a:e} {b:e} {c:e}");
    // Hundreds of times its tension in balance: it hangs deep.
    assert!(none > 0.05, "{none}");
}
