//! The time series of a flight, history.csv: quantities, their columns, rows written and read back.

pub mod columns;
pub(crate) mod columns_page;
pub mod history;
pub mod quantity;
pub mod records;
pub mod rows;
mod table;
