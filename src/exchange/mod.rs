//! Model files and reports: one serialisable form for files, command line, Python and web.
//!
//! A file is read into a tree of plain values first, TOML and JSON alike, then walked by a reader that knows where it is; so every
//! error names the file, the leg, the field and the value. Nothing here knows how anything is solved.
//!
//! ```
//! # fn main() -> Result<(), assur::exchange::FileError> {
//! use assur::exchange::ModelFile;
//! let text = r#"
//! schema = "assur/manipulator/1"
//! leg = [
//!     { joints = "R_P_R", base = { at = [0, 0] }, platform = { at = [0, 0] } },
//!     { joints = "R_P_R", base = { at = [16, 0] }, platform = { at = [17, 0] } },
//!     { joints = "R_P_R", base = { at = [0, 10] }, platform = { at = [13, -3] } },
//! ]
//! "#;
//! assert_eq!(ModelFile::parse(text, "strut.toml")?.manipulator.family(), "3-R_P_R");
//! # Ok(())
//! # }
//! ```

#[cfg(feature = "batch")]
mod batch;
mod check;
mod claims;
mod coupler_file;
mod dxf;
mod error;
mod error_place;
mod group_file;
mod linkage_file;
mod locus_report;
mod model;
mod motion_report;
mod multipteron_file;
mod path_file;
mod questions;
mod reader;
mod report;
mod spatial_check;
mod spatial_file;
mod spatial_report;
#[cfg(feature = "batch")]
mod sweep;
mod tree;
mod triad_file;
mod workspace_question;
mod workspace_report;
mod write;

#[cfg(feature = "batch")]
pub use batch::{
    BatchFileError, BatchWriteError, BatchWriter, InputBlock, InputBlocks, Reject, RowFormat, SolvedBlock,
};
pub use check::{CheckReport, LegReport, RemarkReport};
pub use claims::{ClaimReport, ClaimedPoses, MissingReport, Subject, VerifyReport};
pub use coupler_file::{CouplerFile, CouplerReport};
pub use dxf::workspace_dxf;
pub use error::{FieldProblem, FileError, Format};
pub use error_place::{ErrorPlace, FoundValue};
pub use group_file::{GroupAssemblyReport, GroupReport, parse_group, write_group};
pub use linkage_file::{LinkageReport, is_linkage, parse_linkage};
pub use locus_report::{SingularitiesReport, TracedModes, map_csv};
pub use model::{AngleUnit, ModelFile, read_problem};
pub use motion_report::{InverseReport, Motion, ROW_SCALING, SINGULAR_VALUE_SCALING, VelocityReport};
pub use multipteron_file::{MultipteronFile, multipteron_forward_json, multipteron_inverse_json};
pub use path_file::{PathFileError, PathReport, parse_path, read_path};
pub use questions::{AskedLoci, AskedTilts, HanaTilts, Loci, LociError, MotionAnswer, TiltSections};
pub use report::{CertificateReport, ForwardReport, ModeReport, SubjectReport};
pub use spatial_check::{AnyCheck, SpatialCheckReport};
pub use spatial_file::{HanaFile, TripodFile};
pub use spatial_report::{
    capability_stop_name, hana_capability_json, hana_forward_json, hana_inverse_json, hana_velocity_json,
    hana_workspace_json, tilt_json, tilt_limit_name, tilt_map_json, tripod_determinant_csv, tripod_determinant_json,
    tripod_forward_json, tripod_inverse_json, tripod_pointing_json, tripod_torsions_json, tripod_velocity_json,
};
#[cfg(feature = "batch")]
pub use sweep::{Measure, Sweep, SweepError, SweepTable, Variation};
pub use triad_file::{DyadEntry, TriadFile, read_triad};
pub use workspace_question::{WorkspaceKindError, parse_points, parse_workspace_kind, read_points};
pub use workspace_report::{WorkspaceReport, curve_name, workspace_csv};
