//! Doubts about a setup, said before it is flown: [`FlightSetup::doubts`](crate::FlightSetup::doubts) lists all, and
//! there is a method for each, which answers by what is doubted, and what to do about it. They change nothing of a flight.
//!
//! | what is doubted | module |
//! |---|---|
//! | wings that pass through each other, or through parts of the body | `impossible` |
//! | surfaces that face each other across gaps narrower than their panels | `narrow_gaps` |
//! | roots that meet, tips and roots, edges on planes of images, that are not joined | `unjoined` |
//! | roots on parts of the body, or a little off them | `on_bodies` |
//! | tethers that start otherwise than the wings | `starts_apart` |
//! | smooth starts that last longer than the flight | `long_starts` |
//! | commands that would act after its end | `late_commands` |
//! | angles that scatter, jump or have gaps | `scattered` |
//! | trailing edges ahead, wings that stroke broadside | `edge_ahead` |
//! | wings that revolve with their body, trailing edge ahead | `revolving` |
//! | vorticity of one sign from leading edges, tips of attached wings | `shed_by_motion` |
//! | leading edges of deltas, with vortex lift or that shed | `swept` |
//! | attached flow beyond stall | `beyond_stall` |
//! | cores of wings that are wide beside the panels | `bound_core` |
//! | cores of wakes of leading edges that widen too little | `thin_wake` |
//! | liquids and thin gases with the viscosity of air | `fluid` |
//! | buoyancy that is not computed, bodies light beside the fluid | `displaced` |
//! | gusts that a flight never meets | `late_gusts` |
//! | gusts that its steps do not resolve | `short_gusts` |
//! | gusts that press the air together, past bodies | `pressed_air` |
//! | forces of blade elements that jump | `jumps` |
//! | torsion that blade elements excite | `excited_torsion` |
//! | drag of coefficients of slow wings | `slow_coefficients` |
//!
//! The last one is said with the Reynolds numbers of the wings, so by `check`, `trim`, `power` and the summary alike, and is
//! not in that list.
//!
//! `air_past`: the undisturbed air past a wing in its prescribed motion, by which the motion is judged; `sections`: the same
//! section by section.
//! `on_carriers`: that motion with what carries the wing. `said`: names of wings, and those of which the same is said.
//! `turned_over`, `stops`: what is said of a flight that was flown.

mod air_past;
mod beyond_stall;
mod bound_core;
mod displaced;
mod edge_ahead;
mod excited_torsion;
mod fluid;
mod impossible;
mod jumps;
mod late_commands;
mod late_gusts;
mod list;
mod long_starts;
mod narrow_gaps;
mod on_bodies;
mod on_carriers;
pub(crate) mod pairs;
pub(crate) mod planes;
mod pressed_air;
mod revolving;
mod said;
mod scattered;
mod sections;
mod shed_by_motion;
mod short_gusts;
mod slow_coefficients;
mod starts_apart;
pub(crate) mod stops;
mod swept;
mod thin_wake;
pub(crate) mod turned_over;
mod unjoined;

pub use impossible::CrossingWings;
pub use list::{Doubt, DoubtKind};
