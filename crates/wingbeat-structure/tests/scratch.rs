mod plate;
use plate::*;
use wingbeat_math::DVec3;
use wingbeat_structure::*;

#[test]
fn leissa() {
    let h = 1e-3;
    let lam = Lamina::isotropic(1.0, 0.3, h, 1.0);
    let d: f64 = h * h * h / 12.0 / (1.0 - 0.09);
    let exact = [3.471, 8.507, 21.29, 27.20, 30.96];
    for n in [8, 16, 24] {
        let p = Plate::new(&rectangle(n, n, 1.0, 1.0), lam.section().unwrap(), |x| {
            if x.x < 1e-9 { CLAMPED } else { FREE }
        });
        let w = p.frequencies(5, 0.0);
        let f: Vec<_> = w.iter().map(|w| w / (d / h).sqrt()).collect();
        println!(
            "{n} {f:.4?} {:?}",
            f.iter()
                .zip(exact)
                .map(|(a, b)| format!("{:.3}%", 100.0 * (a / b - 1.0)))
                .collect::<Vec<_>>()
        );
    }
}

#[test]
fn tangent() {
    let mut lam = Lamina::isotropic(1.0, 0.3, 0.1, 1.0);
    lam.prestress = [0.3, 0.1, -0.05];
    lam.young[1] = 0.4;
    lam.axis = DVec3::new(0.8, 0.6, 0.1);
    for tri in [false, true] {
        let mut pts = vec![
            DVec3::new(0.0, 0.0, 0.1),
            DVec3::new(1.0, 0.1, 0.0),
            DVec3::new(0.1, 0.9, 0.0),
            DVec3::new(1.3, 1.2, 0.2),
        ];
        if tri {
            pts[3] = pts[1];
        }
        let mesh = ShellMesh::grid(&pts, 1, 1).unwrap();
        let s = mesh.shells(|_| lam.section().ok()).unwrap().remove(0);
        let mut at = mesh.rest.clone();
        let n = 6 * at.len();
        let inc: Vec<f64> = (0..n).map(|k| 0.7 * ((k * k) as f64).sin()).collect();
        at.moved(&inc);
        let mut out = ElementForces::default();
        s.internal(&at, true, &mut out);
        let mut worst: f64 = 0.0;
        let mut worste: f64 = 0.0;
        let big = out.tangent.iter().fold(0.0f64, |a, b| a.max(b.abs()));
        for k in 0..n {
            let e = 1e-5;
            let mut f = vec![];
            let mut en = vec![];
            for sgn in [1.0, -1.0] {
                let mut d = vec![0.0; n];
                d[k] = sgn * e;
                let mut c = at.clone();
                c.moved(&d);
                let mut o = ElementForces::default();
                en.push(s.internal(&c, false, &mut o));
                f.push(o.force);
            }
            worste = worste.max(((en[0] - en[1]) / 2.0 / e - out.force[k]).abs());
            for i in 0..n {
                worst = worst.max(((f[0][i] - f[1][i]) / 2.0 / e - out.tangent[i * n + k]).abs());
            }
        }
        if !tri {
            let (mut o, mut c) = (ElementForces::default(), at.clone());
            for k in 0..n {
                let e = 1e-5;
                let mut en = vec![];
                for g in [1.0, -1.0] {
                    c = at.clone();
                    let mut d = vec![0.0; n];
                    d[k] = g * e;
                    c.moved(&d);
                    en.push(s.internal(&c, false, &mut o));
                }
                println!("{k} {:.6} {:.6}", (en[0] - en[1]) / 2.0 / e, out.force[k]);
            }
        }
        println!("tri {tri} force err {worste:e} tangent err {worst:e} of {big:e}");
    }
}
