//! What the elements of a joint exert along its free directions.
//!
//! Efforts Q_k have the power `sum_k Q_k u_k`. Where the rates u_k are those of the coordinates q_k, an element's
//! effort is its own. The rates of a spherical joint are the angular velocity w in child axes, and its coordinates the
//! rotation vector, `theta' = A w` ([`wingbeat_math::rotation_jacobian`]). There
//!
//! ```text
//! Q = A^T f + m
//! ```
//!
//! with f_k of what acts along theta_k: springs `-k_k (theta_k - rest_k)`, stops, actuators that follow; their
//! power `f . theta'` is the loss of the energy stored, whatever the stiffness of each component. m_k is what
//! acts about axis k of the child: dampers `-c_k w_k` and given moments. Equal springs without rest exert `-k
//! theta`.

use wingbeat_math::DVec3;
use wingbeat_math::rotation_jacobian::{Curve, inverse_right_jacobian};

use crate::{ElementLaw, Joint, JointModel, JointType, Mechanism};

/// What springs, dampers and stops along the free directions of a joint do.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Passive {
    /// Power that they give \[W\].
    pub power: f64,
    /// Energy stored in springs and stops \[J\].
    pub stored: f64,
    /// Power that dampers and stops take up \[W\].
    pub dissipation: f64,
}

impl Mechanism {
    /// Whether any joint has springs, dampers, stops or drives.
    pub fn has_elements(&self) -> bool {
        self.joints().iter().any(|j| !j.model.elements.is_empty())
    }

    /// What springs, dampers and stops of each joint do at time `t` \[s\], in the order of the joints;
    /// `coordinates` are those of [`Self::coordinates`], with their rates.
    pub fn passive<'a>(
        &'a self,
        t: f64,
        coordinates: &'a [[f64; 2]],
    ) -> impl Iterator<Item = Passive> + 'a {
        let mut rest = coordinates;
        self.joints().iter().map(move |joint: &Joint| {
            let n = joint.model.kind.directions().min(rest.len());
            let (own, others) = rest.split_at(n);
            rest = others;
            joint.model.passive(t, own)
        })
    }
}

impl JointModel {
    /// What its springs, dampers and stops do: arguments as for [`Self::efforts`].
    fn passive(&self, t: f64, motion: &[[f64; 2]]) -> Passive {
        if self.elements.is_empty() {
            return Passive::default();
        }
        let mut still = [[0.0; 2]; 3];
        let places = still.iter_mut().zip(motion);
        places.for_each(|([place, _], [q, _])| *place = *q);
        let power = |efforts: [f64; 3]| -> f64 {
            efforts.iter().zip(motion).map(|(f, [_, u])| f * u).sum()
        };
        let given = power(self.efforts(t, motion, |law| law.drive().is_none()));
        // At rest springs and stops exert what they store and give back.
        let given_back = power(self.efforts(t, &still[..motion.len()], ElementLaw::stores));
        let elements = self.elements.iter();
        Passive {
            power: given,
            stored: elements.map(|e| e.law.stored(motion[e.direction][0])).sum(),
            dissipation: given_back - given,
        }
    }

    /// Efforts \[N m or N\] at time `t` \[s\] of the elements that `acts` chooses, for coordinates and rates
    /// `[q, u]` along the free directions, as [`crate::Mechanism::coordinates`] gives them.
    pub fn efforts(
        &self,
        t: f64,
        motion: &[[f64; 2]],
        acts: impl Fn(&ElementLaw) -> bool,
    ) -> [f64; 3] {
        let mut sum = [0.0; 3];
        if self.elements.is_empty() {
            return sum;
        }
        if matches!(
            self.kind,
            JointType::Spherical | JointType::PointOnLine { .. }
        ) {
            return self.moment(t, motion, acts).to_array();
        }
        for e in self.elements.iter().filter(|e| acts(&e.law)) {
            let [q, u] = motion[e.direction];
            sum[e.direction] += e.law.effort(t, q, u);
        }
        sum
    }

    /// `A^T f + m` of a joint that leaves all rotations free.
    fn moment(&self, t: f64, motion: &[[f64; 2]], acts: impl Fn(&ElementLaw) -> bool) -> DVec3 {
        let [theta, w] = [0, 1].map(|part| DVec3::from_array([0, 1, 2].map(|k| motion[k][part])));
        let a = inverse_right_jacobian(&Curve::at(theta), theta);
        let rate = a * w;
        let (mut f, mut m) = (DVec3::ZERO, DVec3::ZERO);
        for e in self.elements.iter().filter(|e| acts(&e.law)) {
            let k = e.direction;
            match e.law {
                ElementLaw::Damper { .. } | ElementLaw::Effort(_) => {
                    m[k] += e.law.effort(t, theta[k], w[k]);
                }
                ElementLaw::Spring { .. } | ElementLaw::Stop { .. } | ElementLaw::Follow { .. } => {
                    f[k] += e.law.effort(t, theta[k], rate[k])
                }
            }
        }
        a.transpose() * f + m
    }
}
