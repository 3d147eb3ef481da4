use nalgebra::Vector2;

use super::{CouplerArc, Reach, Workspace, WorkspaceError};

#[allow(missing_docs, unused)]
impl Reach {
    pub fn assembly(&self, pose: &crate::linkage::Pose) -> Result<Workspace, WorkspaceError> {
        unimplemented!()
    }
}
#[allow(missing_docs, unused)]
impl CouplerArc {
    pub(super) fn at(&self, part: f64) -> (Vector2<f64>, Vector2<f64>) {
        unimplemented!()
    }
    pub fn phi_at(&self, part: f64) -> f64 {
        unimplemented!()
    }
}
