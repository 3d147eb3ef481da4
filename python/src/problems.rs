//! Problem files: triads, groups, linkages, coupler curves.

use assur::exchange::{
    CouplerFile, CouplerReport, ForwardReport, GroupReport, LinkageReport, TriadFile, is_linkage, parse_group,
    parse_linkage,
};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

use crate::answer::Answer;
use crate::refused::Refused;

/// Every way to put a triad together.
#[pyfunction]
pub fn triad(py: Python<'_>, text: &str, name: &str, certify: bool) -> PyResult<Answer> {
    Ok(py.detach(|| {
        let triad = TriadFile::parse(text, name).map_err(Refused::model)?;
        let answer = if certify { triad.certify() } else { triad.assemble() };
        let json = ForwardReport::of_triad(&triad, &answer).to_json();
        Ok::<_, Refused>(Answer::drawn(json, move || assur::plot::draw_assemblies(&triad, &answer)))
    })?)
}

/// Every way to put a group of revolute joints together, or a linkage of such groups with its drivers held.
#[pyfunction]
pub fn group(py: Python<'_>, text: &str, name: &str, inputs: Vec<f64>, complex: bool) -> PyResult<Answer> {
    if is_linkage(text, name) {
        return Ok(py.detach(|| {
            let linkage = parse_linkage(text, name).map_err(Refused::model)?;
            let answer = linkage.assemble(&inputs).map_err(Refused::input)?;
            let json = LinkageReport::new(&inputs, &answer).to_json();
            Ok::<_, Refused>(Answer::drawn(json, move || assur::plot::draw_linkage(&linkage, &answer)))
        })?);
    }
    if !inputs.is_empty() {
        return Err(PyValueError::new_err("a group has no driven joints, so no inputs"));
    }
    Ok(py.detach(|| {
        let truss = parse_group(text, name).map_err(Refused::model)?;
        let answer = truss.assemble();
        let json = GroupReport::new(&truss, &answer, complex).to_json();
        Ok::<_, Refused>(Answer::drawn(json, move || assur::plot::draw_truss(&truss, &answer)))
    })?)
}

/// A coupler curve, and where it meets a line, a circle or another.
#[pyfunction]
pub fn coupler(py: Python<'_>, text: &str, name: &str) -> PyResult<Answer> {
    Ok(py.detach(|| {
        let CouplerFile { curve, with } = CouplerFile::parse(text, name).map_err(Refused::model)?;
        let found = with.as_ref().and_then(|partner| curve.meet(partner));
        let json = CouplerReport::new(&curve, found.as_ref()).to_json();
        Ok::<_, Refused>(Answer::drawn(json, move || assur::plot::draw_coupler(&curve, with.as_ref(), found.as_ref())))
    })?)
}

/// A coupler curve as polygons of about so many points, flat, piece by piece.
#[pyfunction]
pub fn coupler_polygons(py: Python<'_>, text: &str, name: &str, points: usize) -> PyResult<Vec<Vec<f64>>> {
    Ok(py.detach(|| {
        let CouplerFile { curve, .. } = CouplerFile::parse(text, name).map_err(Refused::model)?;
        let flat = |piece: Vec<_>| piece.iter().flat_map(|p: &assur::nalgebra::Vector2<f64>| [p.x, p.y]).collect();
        Ok::<_, Refused>(curve.polygons(points).into_iter().map(flat).collect())
    })?)
}
