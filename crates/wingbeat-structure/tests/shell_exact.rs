//! Shells against closed forms: rigid motions, patch tests, plates with a series, membranes.

mod common;
mod plate;

use common::damping_tangent_error;
use plate::{FREE, Plate, askew, lattice, rectangle};
use wingbeat_math::{DMat3, DQuat, DVec3, MassProperties};
use wingbeat_structure::shell::ShellSection;
use wingbeat_structure::{Configuration, Element, ElementForces, Lamina, ShellError, ShellMesh};

/// A mesh without right angles; its last panel is a triangle.
fn distorted(height: f64) -> ShellMesh {
    let point = |i: usize, j: usize| {
        let (x, y) = (j as f64, i as f64);
        let inner = f64::from(u8::from(!i.is_multiple_of(3) && !j.is_multiple_of(3)));
        let wobble = 0.25 * inner;
        let x = x + wobble * (3.0 * x + 5.0 * y).sin() + 0.1 * y;
        let y = y + wobble * (4.0 * x - 2.0 * y).cos();
        DVec3::new(x, y, height * (x * x - 2.0 * y + x * y).sin())
    };
    let mut points: Vec<DVec3> = (0..16).map(|k| point(k / 4, k % 4)).collect();
    points[15] = points[14];
    ShellMesh::grid(&points, 3, 3).unwrap()
}

/// Largest of some numbers in size.
fn largest(all: &[f64]) -> f64 {
    all.iter().fold(0.0, |m, x| m.max(x.abs()))
}

/// A warped, thin mesh with nodes of any attitude, turned by 2.5 rad and displaced.
#[test]
fn exact_rigid_motion_has_neither_energy_nor_force() {
    let mut mesh = distorted(0.3);
    for (n, r) in mesh.rest.rotation.iter_mut().enumerate() {
        *r = DQuat::from_scaled_axis(DVec3::new(n as f64, 1.0, -0.3 * n as f64));
    }
    let plate = Plate::new(&mesh, askew(1e-3).section().unwrap(), |_| FREE);
    let turn = DQuat::from_scaled_axis(DVec3::new(1.5, -1.6, 1.2));
    let moved = Configuration {
        position: mesh
            .rest
            .position
            .iter()
            .map(|x| turn * *x + DVec3::new(5.0, 1.0, -2.0))
            .collect(),
        rotation: mesh.rest.rotation.iter().map(|r| turn * *r).collect(),
    };
    let (energy, force, _) = plate.assemble(&moved);
    // Membrane stiffness 1e-3: round-off of places of order 10 strains by 1e-15.
    assert!(largest(&force) < 1e-12 * 1e-3, "{:e}", largest(&force));
    assert!(energy < 1e-24 * 1e-3, "{energy:e}");
}

/// Any finite homogeneous stretch of the plane: forces at inner nodes vanish (patch test of finite strains).
#[test]
fn exact_patch_of_constant_stretch_is_in_equilibrium() {
    let mesh = distorted(0.0);
    let plate = Plate::new(&mesh, askew(1e-2).section().unwrap(), |_| FREE);
    let stretch = DMat3::from_cols(
        DVec3::new(1.1, 0.07, 0.0),
        DVec3::new(0.07, 0.95, 0.0),
        DVec3::Z,
    );
    let mut at = mesh.rest.clone();
    at.position.iter_mut().for_each(|x| *x = stretch * *x);
    let (energy, force, _) = plate.assemble(&at);
    assert!(energy > 1e-6);
    for n in [5, 6, 9, 10] {
        // Forces at the rim are 1e-3.
        assert!(
            largest(&force[6 * n..6 * n + 6]) < 1e-16,
            "node {n}: {:?}",
            &force[6 * n..6 * n + 6]
        );
    }
}

/// Any constant curvature at small deflection: forces and moments at inner nodes vanish, the energy is exact, for thin
/// and thick sheets, with quadrilaterals and a triangle.
#[test]
fn exact_patch_of_constant_curvature_is_in_equilibrium() {
    let mesh = distorted(0.0);
    for thickness in [1e-6, 1e-2, 0.5] {
        let section = Lamina {
            axis: DVec3::X,
            ..askew(thickness)
        }
        .section()
        .unwrap();
        let plate = Plate::new(&mesh, section, |_| FREE);
        let k = DVec3::new(0.3, -0.5, 2.0 * 0.2); // 11, 22, 2 x 12
        let bent: Vec<f64> = mesh
            .rest
            .position
            .iter()
            .flat_map(|x| bowl(*x, k))
            .collect();
        let (_, _, tangent) = plate.assemble(&mesh.rest);
        let force = tangent.times(&bent);
        let energy: f64 = 0.5 * bent.iter().zip(&force).map(|(a, b)| a * b).sum::<f64>();
        let area: f64 = plate.shells.iter().map(|s| s.area()).sum();
        let exact = 0.5 * area * k.dot(section.bending * k);
        // Drilling does not move; the rest is bending, and rounds at some ten times its condition.
        assert!(
            (energy / exact - 1.0).abs() < 1e-12,
            "{thickness}: {energy:e} {exact:e}"
        );
        for n in [5, 6, 9, 10] {
            let f = largest(&force[6 * n..6 * n + 6]);
            assert!(f < 1e-13 * largest(&force), "{thickness}, node {n}: {f:e}");
        }
    }
}

/// Six numbers of a node where the sheet bends by `k` (11, 22, 2 x 12): `w = -(k11 x^2 + k22 y^2 + 2 k12 x y) / 2`, so
/// that the normal's derivatives are the curvatures.
fn bowl(x: DVec3, k: DVec3) -> [f64; 6] {
    let w = -0.5 * (k.x * x.x * x.x + k.y * x.y * x.y + k.z * x.x * x.y);
    let slope = [
        -(k.x * x.x + 0.5 * k.z * x.y),
        -(k.y * x.y + 0.5 * k.z * x.x),
    ];
    [0.0, 0.0, w, slope[1], -slope[0], 0.0]
}

/// Force and tangent are the derivatives of the energy, far from rest, with prestress, warped, as triangle.
#[test]
fn agrees_force_and_tangent_with_differences() {
    let lamina = Lamina {
        prestress: [0.03, 0.01, -0.005],
        ..askew(0.1)
    };
    for panel in [4, 8] {
        let mesh = distorted(0.3);
        let shell = &mesh.shells(|_| lamina.section().ok()).unwrap()[panel];
        let mut at = mesh.rest.clone();
        let push: Vec<f64> = (0..6 * at.len())
            .map(|k| 0.7 * ((k * k) as f64).sin())
            .collect();
        at.moved(&push);
        let mut out = ElementForces::default();
        shell.internal(&at, true, &mut out);
        let numbers: Vec<usize> = shell
            .nodes()
            .iter()
            .flat_map(|n| 6 * n..6 * n + 6)
            .collect();
        let (h, size) = (1e-5, numbers.len());
        for (k, number) in numbers.iter().enumerate() {
            let side = |h: f64| {
                let (mut there, mut d) = (at.clone(), vec![0.0; push.len()]);
                d[*number] = h;
                there.moved(&d);
                let mut out = ElementForces::default();
                (shell.internal(&there, false, &mut out), out.force)
            };
            let ((ep, fp), (em, fm)) = (side(h), side(-h));
            // Central differences: h^2 times third derivatives of order 0.1.
            assert!(((ep - em) / (2.0 * h) - out.force[k]).abs() < 1e-10);
            for i in 0..size {
                let slope = (fp[i] - fm[i]) / (2.0 * h);
                assert!((slope - out.tangent[i * size + k]).abs() < 1e-10, "{i} {k}");
            }
        }
    }
}

/// Of a warped quadrilateral and a triangle, far from rest.
#[test]
fn agrees_damping_tangent_of_shells_with_differences() {
    for panel in [4, 8] {
        let mesh = distorted(0.3);
        let shell = &mesh.shells(|_| askew(0.1).section().ok()).unwrap()[panel];
        let mut at = mesh.rest.clone();
        let push: Vec<f64> = (0..6 * at.len())
            .map(|k| 0.7 * ((k * k) as f64).sin())
            .collect();
        at.moved(&push);
        let error = damping_tangent_error(shell, &at);
        // Central differences: h^2 = 1e-10 and 1e-16 / h of rounding.
        assert!(error < 1e-9, "{error:e}");
    }
}

/// Rates of bending are damped as bending is stiff (Kelvin and Voigt), those of stretching are not.
#[test]
fn exact_damping_is_that_of_bending_alone() {
    let mesh = distorted(0.0);
    let section = Lamina {
        axis: DVec3::X,
        ..askew(1e-2)
    }
    .section()
    .unwrap();
    let k = DVec3::new(0.3, -0.5, 2.0 * 0.2);
    let bent = |x: &DVec3| bowl(*x, k);
    let stretched = |x: &DVec3| [0.3 * x.x + 0.1 * x.y, -0.2 * x.y, 0.0, 0.0, 0.0, 0.0];
    let power = |v: &dyn Fn(&DVec3) -> [f64; 6]| -> f64 {
        let shells = mesh.shells(|_| Some(section)).unwrap();
        let of = shells.iter().map(|shell| {
            let mut out = ElementForces::default();
            shell.dissipation(&mesh.rest, &mut out);
            let own = shell.nodes().iter();
            let v: Vec<f64> = own.flat_map(|n| v(&mesh.rest.position[*n])).collect();
            let rows = out.tangent.chunks_exact(v.len()).zip(&v);
            rows.map(|(row, w)| w * row.iter().zip(&v).map(|(c, v)| c * v).sum::<f64>())
                .sum::<f64>()
        });
        of.sum()
    };
    let area: f64 = mesh
        .shells(|_| Some(section))
        .unwrap()
        .iter()
        .map(|s| s.area())
        .sum();
    let exact = area * k.dot(section.bending * k);
    let error = power(&bent) / exact - 1.0;
    assert!(error.abs() < 1e-12, "{error:e}");
    assert!(power(&stretched).abs() < 1e-24, "{:e}", power(&stretched));
}

/// Lumped quarters have mass, first moment and inertia of the whole sheet, those of long panels with the masses midway
/// between their corners and what both lack.
#[test]
fn exact_mass_properties_are_those_of_the_sheet() {
    let lamina = Lamina {
        thickness: 0.02,
        ..askew(0.02)
    };
    let sum_of = |cols: usize| {
        let mesh = rectangle(3, cols, 2.0, 1.0);
        let plate = Plate::new(&mesh, lamina.section().unwrap(), |_| FREE);
        let nodes = plate.masses.iter().zip(&plate.rest.position);
        let sum = nodes.fold(MassProperties::ZERO, |a, (m, x)| {
            assert_eq!(m.validate(), Ok(()));
            a + m.moved(DMat3::IDENTITY, *x)
        });
        let mut between = 0;
        let sum = plate.shells.iter().fold(sum, |sum, shell| {
            let points = shell.masses_between().into_iter();
            let points = points.fold(MassProperties::ZERO, |a, m| {
                between += 1;
                let [p, q] = m.nodes.map(|n| plate.rest.position[n]);
                a + MassProperties::point(m.mass, p.midpoint(q))
            });
            sum + points + shell.remainder()
        });
        (sum, between)
    };
    let mass = 2.0 * (0.02 + 0.5);
    let plate_inertia = |a: f64| mass * a * a / 12.0;
    let thick = 2.0 * 0.02_f64.powi(3) / 12.0;
    let inertia = DVec3::new(
        plate_inertia(1.0) + thick,
        plate_inertia(2.0) + thick,
        plate_inertia(5.0_f64.sqrt()),
    );
    let exact = MassProperties::about_centre(
        mass,
        DVec3::new(1.0, 0.5, 0.0),
        DMat3::from_diagonal(inertia),
    );
    for (cols, middles) in [(2, 0), (1, 6)] {
        let (sum, between) = sum_of(cols);
        assert_eq!(between, middles);
        assert!((sum.mass - exact.mass).abs() < 1e-15 * 10.0);
        assert!((sum.first_moment - exact.first_moment).length() < 1e-14);
        let gap = (sum.inertia - exact.inertia).to_cols_array();
        assert!(gap.iter().all(|e| e.abs() < 1e-14), "{gap:?}");
    }
}

/// Wrong numbers are named.
#[test]
fn refuses_what_is_no_shell() {
    let wrong = Lamina {
        poisson: 1.7,
        ..askew(0.1)
    }
    .section();
    assert!(matches!(
        wrong,
        Err(ShellError::Material {
            name: "poisson",
            ..
        })
    ));
    let wrong = Lamina {
        thickness: f64::NAN,
        ..askew(0.1)
    }
    .section();
    assert!(matches!(
        wrong,
        Err(ShellError::Material {
            name: "thickness",
            ..
        })
    ));
    let mesh = rectangle(1, 1, 1.0, 1.0);
    let good = askew(0.1).section().unwrap();
    let with = |section: ShellSection| mesh.shells(|_| Some(section)).map(|s| s.len());
    assert_eq!(with(good), Ok(1));
    assert!(matches!(
        with(ShellSection {
            axis: DVec3::Z,
            ..good
        }),
        Err(ShellError::Axis { .. })
    ));
    assert!(matches!(
        with(ShellSection { shear: 0.0, ..good }),
        Err(ShellError::Material { name: "shear", .. })
    ));
    let shell = |corners| {
        wingbeat_structure::Shell::new(&mesh.rest, corners, &good).map(|s| s.nodes().len())
    };
    assert_eq!(shell([0, 1, 3, 3]), Ok(3));
    assert!(matches!(
        shell([0, 1, 1, 0]),
        Err(ShellError::NoArea { .. })
    ));
    assert!(matches!(
        shell([0, 1, 3, 4]),
        Err(ShellError::NoNode { node: 4, nodes: 4 })
    ));
    let grid = ShellMesh::grid(&mesh.rest.position, 2, 2);
    assert_eq!(
        grid,
        Err(ShellError::Lattice {
            found: 4,
            expected: 9
        })
    );
    let _ = lattice(1, 1, |r, c| DVec3::new(c, r, 0.0));
}
