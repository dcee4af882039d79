//! Case files, result directories, figures.
