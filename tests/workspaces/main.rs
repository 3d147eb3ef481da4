//! Workspaces against a check that shares nothing with them: brute force over orientations, scan lines, reference data.
//!
//! `ASSUR_TEST_SCALE` multiplies how many random manipulators are asked.

mod assemblies;
mod design;
mod faces;
mod golden;
mod membership;
mod models;
mod oracle;
#[path = "../random/mod.rs"]
mod random;
mod regions;
mod selfcheck;
