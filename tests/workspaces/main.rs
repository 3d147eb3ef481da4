//! Workspaces against a check that shares nothing with them: brute force over orientations, scan lines, reference data.
//!
//! `ASSUR_TEST_SCALE` multiplies how many random manipulators are asked.

mod arcs;
mod areas;
mod assemblies;
mod design;
mod faces;
mod golden;
mod gradients;
mod membership;
mod models;
mod oracle;
mod quadrature;
#[path = "../random/mod.rs"]
mod random;
mod reachable;
mod regions;
mod selfcheck;
