//! Campaigns: thousands of flights from one file, flown by any number of workers that share a directory.
//!
//! The chapter in order: `raw` is the file as it is written; `axes` turns it into a `plan` (`checks` what its
//! words say of each other, `places` where its keys stand), what is drawn by `sample`; `cases` puts values on
//! top of the case; `file` holds all that is read; `number` knows what may be kept, `trial` tries points and
//! says what is refused, `named` knows the files that values name; `campaign` joins them: point i -> values ->
//! case -> hash, a pure function of the file. `point` does what is to be done at a point (`trimming`, `flight`,
//! `evaluate`), `store` keeps its result, `lease` says who flies which points, `worker` goes from block to
//! block. `rows`, `status`, [`merge`] and [`page`] read what is there; `scripts` writes what other engines
//! need, `cost` tells what a campaign will take. In a store of their own [`KeptMembers`] are the flights of an
//! ensemble, until all are flown; `digest` is what both depend on.
//!
//! What it does not know: processes, command lines, how pages look.
#![warn(missing_docs)]

mod campaign;
mod command;
mod digest;
mod members;
pub mod merge;
pub mod page;
mod plan;
mod scripts;
mod status;
mod store;
mod worker;

pub use campaign::Campaign;
pub use members::KeptMembers;
pub use plan::Plan;
pub use plan::named;
pub use plan::number::Number;
pub use plan::raw::RawCampaign;
pub use plan::value::Value;
pub use scripts::Engine;
pub use status::{Status, retry};
pub use store::Store;
pub use worker::cost::Cost;
pub use worker::{Ended, Worker, inspect, left, plan_name};

/// The JSON schema of the file, for editors.
pub fn schema() -> String {
    let schema = schemars::schema_for!(RawCampaign).to_value();
    serde_json::to_string_pretty(&schema).expect("a schema is JSON")
}
