//! All keys of the case language, read off the types of [`crate::raw`]: the JSON schema for
//! editors, the checks that need no physics, and the page of all keys.
//!
//! The chapter in order: `schema` makes the schema; `bounds` checks the number at a key and says
//! what is allowed; `needs` knows which keys have an effect beside which others; `check` walks a
//! case with both; `unit` reads units from names; `places` finds keys by name and tells what they are; `page`
//! writes docs/case-keys.md.

mod bounds;
mod check;
mod needs;
mod page;
mod places;
mod schema;
mod unit;

pub(crate) use check::{alone, beside_own_air, effective, together};
pub use page::page;
pub use places::described;
pub(crate) use places::places;
pub use schema::{SCHEMA_FILE, schema, with_schema};
pub(crate) use unit::without_unit;
