//! Forces on the nodes of the surfaces that do what forces and couples of the panels do: the same force, the same
//! moment, and the same power in any motion of the nodes.
//!
//! Control point and spin of a panel are linear in the velocities of the corners of its ring, those in the
//! velocities of the surface's nodes; loads go the same way back, transposed. With the diagonals d and e of the
//! ring, n its normal and A = |d x e| the power of a couple C is `C . n x (d' x e + d x e') / A` and, about n,
//! the mean of what turns either diagonal.

use crate::geometry::NodeMotion;
use crate::lattice::Lattice;
use crate::loads::values::AirLoads;
use wingbeat_math::DVec3;

/// Forces at the ends of the diagonals `d` and `e` of a panel that do the power of the `couple` in any motion.
fn couple_forces(couple: DVec3, [d, e]: [DVec3; 2]) -> [DVec3; 2] {
    let across = d.cross(e);
    let n = across.normalize_or_zero();
    let g = couple.cross(n) / across.length();
    let about = 0.5 * couple.dot(n);
    [
        e.cross(g) + about / d.length_squared() * n.cross(d),
        g.cross(d) + about / e.length_squared() * n.cross(e),
    ]
}

impl Lattice {
    /// Forces on the nodes of surface `s` \[N\], N components, node by node into `out`: those of `loads`, computed for
    /// `motion`. `rings` is scratch.
    pub fn nodal_forces(
        &self,
        s: usize,
        loads: &AirLoads,
        motion: &NodeMotion,
        rings: &mut NodeMotion,
        out: &mut Vec<DVec3>,
    ) {
        self.rings().place(motion, rings);
        let nodes = self.nodes_of(s);
        out.clear();
        out.resize(nodes.len(), DVec3::ZERO);
        for p in self.panels_of(s) {
            let corners = self.topology().panels[p];
            let [a, b, c, d] = corners.map(|n| rings.position[n]);
            let [along, across] = match loads.couple[p] == DVec3::ZERO {
                true => [DVec3::ZERO; 2],
                false => couple_forces(loads.couple[p], [c - a, d - b]),
            };
            let [i, j, k, l] = self
                .controls()
                .weights(p, &corners)
                .map(|w| w * loads.force[p]);
            let shares = [i - along, j - across, k + along, l + across];
            for (n, share) in corners.into_iter().zip(shares) {
                self.rings().spread((n, &motion.position), share, |n, f| {
                    out[n - nodes.start] += f
                });
            }
        }
    }
}
