//! Tests of the program and its library in one program, which is linked once; what runs long, is timed or needs a
//! browser has its own.

mod bad_air;
mod bad_input;
mod batch;
mod benchmark;
mod commands;
mod control;
mod damage;
mod ensembles;
mod examples;
mod exports;
mod figures;
mod files;
mod glides;
mod mechanics;
mod modes;
mod new;
mod pipes;
mod presets;
mod reports;
mod results;
mod support;
mod table1;
mod value;
