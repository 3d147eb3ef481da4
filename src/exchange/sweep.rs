//! Results over designs: numbers of a model varied over a grid, workspaces measured for each.

use std::fmt;
use std::io::Write;
use std::str::FromStr;
use std::sync::Arc;

use parquet::basic::{ConvertedType, Repetition, Type as PhysicalType};
use parquet::data_type::{ByteArray, ByteArrayType, DoubleType, Int64Type};
use parquet::file::properties::WriterProperties;
use parquet::file::writer::SerializedFileWriter;
use parquet::schema::types::Type;
use rayon::prelude::*;
use thiserror::Error;

use super::batch::RowFormat;
use super::model::{AngleUnit, ModelFile};
use super::workspace_question::{WorkspaceKindError, parse_workspace_kind};
use crate::manipulator::{DesignError, DesignKey, DesignNumber, Manipulator};
use crate::workspace::{Region, WorkspaceKind, WorkspaceModes};

/// Designs are solved in blocks of this many, between which progress is told.
const BLOCK: usize = 256;
/// More designs than this are refused: a table of them would not fit a machine's memory.
const MOST_DESIGNS: usize = 100_000_000;

/// Why there is no sweep.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum SweepError {
    /// A variation is no `KEY=A:B:N`.
    #[error("\"{text}\": must be KEY=A:B:N, as in leg1.platform.at.x=-3:3:100: N values from A to B")]
    Variation {
        /// The text found.
        text: String,
    },
    /// The number is none of the model's.
    #[error(transparent)]
    Design(#[from] DesignError),
    /// A measure is no `WHAT:KIND`.
    #[error(
        "\"{text}\": must be WHAT:KIND with WHAT one of area, perimeter, components, holes, xmin, ymin, xmax, ymax, as in area:maximal"
    )]
    Measure {
        /// The text found.
        text: String,
    },
    /// The kind of workspace of a measure.
    #[error(transparent)]
    Kind(#[from] WorkspaceKindError),
    /// The same number varied twice.
    #[error("\"{key}\" is varied twice")]
    Twice {
        /// The name.
        key: String,
    },
    /// More designs than can be held.
    #[error("{designs} designs, must be at most {MOST_DESIGNS}")]
    TooMany {
        /// How many.
        designs: u128,
    },
}

/// A number of the design and the values it takes.
#[derive(Clone, Debug, PartialEq)]
pub struct Variation {
    /// Its name.
    pub key: DesignKey,
    /// First and last value, angles in the model file's unit.
    pub ends: [f64; 2],
    /// How many values, evenly spaced, the ends included.
    pub count: usize,
}

impl FromStr for Variation {
    type Err = SweepError;

    /// `KEY=A:B:N`.
    fn from_str(text: &str) -> Result<Self, SweepError> {
        let bad = || SweepError::Variation { text: text.to_owned() };
        let (key, values) = text.split_once('=').ok_or_else(bad)?;
        let values: Vec<&str> = values.split(':').collect();
        let &[from, to, count] = &values[..] else { return Err(bad()) };
        let number = |text: &str| text.trim().parse::<f64>().ok().filter(|value| value.is_finite()).ok_or_else(bad);
        let count = count.trim().parse::<usize>().ok().filter(|&count| count >= 1).ok_or_else(bad)?;
        Ok(Self { key: key.trim().parse()?, ends: [number(from)?, number(to)?], count })
    }
}

impl Variation {
    /// Its values, in the model file's unit.
    fn value(&self, index: usize) -> f64 {
        let [from, to] = self.ends;
        if self.count == 1 {
            return from;
        }
        let part = index as f64 / (self.count - 1) as f64;
        // Both ends exactly.
        if index + 1 == self.count { to } else { from + (to - from) * part }
    }
}

/// What is measured of which workspace.
#[derive(Clone, Debug, PartialEq)]
pub struct Measure {
    text: String,
    what: What,
    /// The workspace.
    pub kind: WorkspaceKind,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum What {
    Area,
    Perimeter,
    Components,
    Holes,
    /// An entry of the bounding box.
    Side(usize),
}

impl Measure {
    /// A measure as `--report` names it: `area:maximal`, `holes:constant:30`; angles in `unit`.
    ///
    /// # Errors
    /// Another word, another kind.
    pub fn parse(text: &str, unit: AngleUnit) -> Result<Self, SweepError> {
        let bad = || SweepError::Measure { text: text.to_owned() };
        let (what, kind) = text.split_once(':').ok_or_else(bad)?;
        let what = match what {
            "area" => What::Area,
            "perimeter" => What::Perimeter,
            "components" => What::Components,
            "holes" => What::Holes,
            "xmin" => What::Side(0),
            "ymin" => What::Side(1),
            "xmax" => What::Side(2),
            "ymax" => What::Side(3),
            _ => return Err(bad()),
        };
        Ok(Self { text: text.to_owned(), what, kind: parse_workspace_kind(kind, unit)? })
    }

    fn of(&self, region: &Region) -> Option<f64> {
        match self.what {
            What::Area => Some(region.area),
            What::Perimeter => Some(region.perimeter),
            What::Components => Some(region.components as f64),
            What::Holes => Some(region.holes as f64),
            What::Side(k) => region.bbox.map(|bbox| bbox[k]),
        }
    }
}

impl fmt::Display for Measure {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.text)
    }
}

/// A grid of designs and what to measure of each.
///
/// ```
/// use assur::exchange::{AngleUnit, Measure, ModelFile, Sweep};
/// use assur::workspace::WorkspaceModes;
/// let (mut robot, _) = assur::Manipulator::of_family("3-RPR")?;
/// robot.legs.iter_mut().for_each(|leg| leg.limits[1] = Some([5.0, 14.0]));
/// let model = ModelFile { manipulator: robot, angle_unit: AngleUnit::Rad };
/// let sweep = Sweep::new(
///     &model,
///     vec!["leg1.limits.max=4:14:3".parse()?],
///     vec![Measure::parse("area:constant:0.3", AngleUnit::Rad)?],
///     WorkspaceModes::Both,
/// )?;
/// let table = sweep.run(|_| ());
/// assert_eq!(table.rows(), 3);
/// // A range that runs backwards is a row with its reason.
/// assert!(table.reason(0).is_some_and(|reason| reason.contains("must not decrease")));
/// assert!(table.value(2, 0) > table.value(1, 0));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug)]
pub struct Sweep {
    robot: Manipulator,
    unit: AngleUnit,
    variations: Vec<Variation>,
    /// The numbers behind each variation.
    numbers: Vec<Vec<DesignNumber>>,
    measures: Vec<Measure>,
    /// Each kind of workspace once, and which of them each measure is about.
    kinds: Vec<WorkspaceKind>,
    kind_of: Vec<usize>,
    modes: WorkspaceModes,
    designs: usize,
}

impl Sweep {
    /// A sweep over every combination of the variations' values; the last variation changes fastest.
    ///
    /// # Errors
    /// A number that the model does not have, one varied twice, too many designs.
    pub fn new(
        model: &ModelFile,
        variations: Vec<Variation>,
        measures: Vec<Measure>,
        modes: WorkspaceModes,
    ) -> Result<Self, SweepError> {
        let robot = model.manipulator.clone();
        let numbers: Vec<Vec<DesignNumber>> =
            variations.iter().map(|one| one.key.numbers(&robot)).collect::<Result<_, _>>()?;
        let mut seen = Vec::new();
        for (variation, numbers) in variations.iter().zip(&numbers) {
            for number in numbers {
                if seen.contains(number) {
                    return Err(SweepError::Twice { key: variation.key.to_string() });
                }
                seen.push(*number);
            }
        }
        let designs: u128 = variations.iter().map(|one| one.count as u128).product();
        if designs > MOST_DESIGNS as u128 {
            return Err(SweepError::TooMany { designs });
        }
        let (mut kinds, mut kind_of): (Vec<WorkspaceKind>, Vec<usize>) = (Vec::new(), Vec::new());
        for measure in &measures {
            let place = kinds.iter().position(|kind| *kind == measure.kind).unwrap_or_else(|| {
                kinds.push(measure.kind);
                kinds.len() - 1
            });
            kind_of.push(place);
        }
        let unit = model.angle_unit;
        Ok(Self { robot, unit, variations, numbers, measures, kinds, kind_of, modes, designs: designs as usize })
    }

    /// How many designs there are.
    pub fn designs(&self) -> usize {
        self.designs
    }

    /// Measures every design, in parallel, the same table whatever the number of threads. `progress` is told how many are done.
    ///
    /// A design that cannot be asked is a row with a reason and no values.
    pub fn run(&self, progress: impl Fn(usize)) -> SweepTable {
        let mut table = SweepTable {
            names: self.variations.iter().map(|one| one.key.to_string()).collect(),
            measures: self.measures.iter().map(ToString::to_string).collect(),
            designs: Vec::with_capacity(self.designs * self.variations.len()),
            results: Vec::with_capacity(self.designs),
        };
        for first in (0..self.designs).step_by(BLOCK) {
            let block = first..(first + BLOCK).min(self.designs);
            table.designs.extend(block.clone().flat_map(|row| self.design(row)));
            table.results.par_extend(block.clone().into_par_iter().map(|row| self.measured(row)));
            progress(block.end);
        }
        table
    }

    /// The values of a design, in the model file's unit.
    fn design(&self, row: usize) -> Vec<f64> {
        let mut rest = row;
        let mut values: Vec<f64> = self
            .variations
            .iter()
            .rev()
            .map(|one| {
                let value = one.value(rest % one.count);
                rest /= one.count;
                value
            })
            .collect();
        values.reverse();
        values
    }

    fn measured(&self, row: usize) -> Result<Vec<Option<f64>>, String> {
        let mut robot = self.robot.clone();
        for (numbers, value) in self.numbers.iter().zip(self.design(row)) {
            for &number in numbers {
                let value = if number.is_angle(&robot) { self.unit.to_rad(value) } else { value };
                robot.set_design_number(number, value).map_err(|error| error.to_string())?;
            }
        }
        robot.validate().map_err(|error| error.to_string())?;
        let regions: Vec<Region> = self
            .kinds
            .iter()
            .map(|kind| {
                let region = robot.workspace(kind, &self.modes).map_err(|error| error.to_string())?.region;
                let open = region.unclosed.len();
                if open > 0 {
                    return Err(format!("{}: {open} pieces of boundary could not be joined to loops", kind.name()));
                }
                Ok(region)
            })
            .collect::<Result<_, String>>()?;
        Ok(self.measures.iter().zip(&self.kind_of).map(|(measure, &kind)| measure.of(&regions[kind])).collect())
    }
}

/// The designs of a sweep with what was measured.
#[derive(Clone, Debug, PartialEq)]
pub struct SweepTable {
    names: Vec<String>,
    measures: Vec<String>,
    /// The values of each design, row by row.
    designs: Vec<f64>,
    results: Vec<Result<Vec<Option<f64>>, String>>,
}

impl SweepTable {
    /// How many designs.
    pub fn rows(&self) -> usize {
        self.results.len()
    }

    /// How many could not be asked.
    pub fn failures(&self) -> usize {
        self.results.iter().filter(|result| result.is_err()).count()
    }

    /// A measure of a design; `None` where there is no such value.
    pub fn value(&self, row: usize, measure: usize) -> Option<f64> {
        self.results[row].as_ref().ok().and_then(|values| values[measure])
    }

    /// Why a design could not be asked.
    pub fn reason(&self, row: usize) -> Option<&str> {
        self.results[row].as_ref().err().map(String::as_str)
    }

    /// The values of a design, in the order of the variations.
    pub fn design(&self, row: usize) -> &[f64] {
        let width = self.names.len();
        &self.designs[width * row..width * (row + 1)]
    }

    /// The table as bytes: columns `row`, the varied numbers, the measures, `reason`; empty where there is no value.
    pub fn to_bytes(&self, format: RowFormat) -> Vec<u8> {
        match format {
            RowFormat::Csv => self.csv(),
            RowFormat::JsonLines => self.json_lines(),
            RowFormat::Parquet => {
                let mut out = Vec::new();
                let written = self.write_parquet(&mut out);
                written.expect("columns of one length in the order of the schema, written to memory");
                out
            }
        }
    }

    fn csv(&self) -> Vec<u8> {
        let quoted = |text: &str| {
            if text.contains([',', '"', '\n']) { format!("\"{}\"", text.replace('"', "\"\"")) } else { text.to_owned() }
        };
        let mut out = b"row".to_vec();
        // Writing to memory does not fail.
        self.names.iter().chain(&self.measures).for_each(|name| _ = write!(out, ",{}", quoted(name)));
        out.extend(b",reason\n");
        for row in 0..self.rows() {
            let _ = write!(out, "{}", row + 1);
            self.design(row).iter().for_each(|value| _ = write!(out, ",{value}"));
            for measure in 0..self.measures.len() {
                let _ = write!(out, ",{}", self.value(row, measure).map_or(String::new(), |value| value.to_string()));
            }
            let _ = writeln!(out, ",{}", quoted(self.reason(row).unwrap_or_default()));
        }
        out
    }

    fn json_lines(&self) -> Vec<u8> {
        let mut out = Vec::new();
        let text = |value: &str| serde_json::Value::from(value).to_string();
        for row in 0..self.rows() {
            // Writing to memory does not fail.
            let _ = write!(out, "{{\"row\":{}", row + 1);
            for (name, value) in self.names.iter().zip(self.design(row)) {
                let _ = write!(out, ",{}:{value}", text(name));
            }
            for (k, name) in self.measures.iter().enumerate() {
                let _ = write!(out, ",{}:{}", text(name), serde_json::Value::from(self.value(row, k)));
            }
            if let Some(reason) = self.reason(row) {
                let _ = write!(out, ",\"reason\":{}", text(reason));
            }
            out.extend(b"}\n");
        }
        out
    }

    fn write_parquet(&self, out: &mut Vec<u8>) -> parquet::errors::Result<()> {
        let field = |name: &str, kind, repetition, meaning| {
            let field =
                Type::primitive_type_builder(name, kind).with_repetition(repetition).with_converted_type(meaning);
            Arc::new(field.build().expect("a plain column"))
        };
        let mut fields = vec![field("row", PhysicalType::INT64, Repetition::REQUIRED, ConvertedType::NONE)];
        fields.extend(
            self.names.iter().map(|name| field(name, PhysicalType::DOUBLE, Repetition::REQUIRED, ConvertedType::NONE)),
        );
        fields.extend(
            self.measures
                .iter()
                .map(|name| field(name, PhysicalType::DOUBLE, Repetition::OPTIONAL, ConvertedType::NONE)),
        );
        fields.push(field("reason", PhysicalType::BYTE_ARRAY, Repetition::OPTIONAL, ConvertedType::UTF8));
        let schema = Type::group_type_builder("designs").with_fields(fields).build().expect("columns of a table");
        let mut file = SerializedFileWriter::new(out, Arc::new(schema), Arc::new(WriterProperties::builder().build()))?;
        let mut group = file.next_row_group()?;
        let rows = 0..self.rows();
        let mut column = group.next_column()?.expect("row");
        let numbers: Vec<i64> = rows.clone().map(|row| row as i64 + 1).collect();
        column.typed::<Int64Type>().write_batch(&numbers, None, None)?;
        column.close()?;
        for k in 0..self.names.len() {
            let values: Vec<f64> = rows.clone().map(|row| self.design(row)[k]).collect();
            let mut column = group.next_column()?.expect("a varied number");
            column.typed::<DoubleType>().write_batch(&values, None, None)?;
            column.close()?;
        }
        for k in 0..self.measures.len() {
            let values: Vec<f64> = rows.clone().filter_map(|row| self.value(row, k)).collect();
            let levels: Vec<i16> = rows.clone().map(|row| i16::from(self.value(row, k).is_some())).collect();
            let mut column = group.next_column()?.expect("a measure");
            column.typed::<DoubleType>().write_batch(&values, Some(&levels), None)?;
            column.close()?;
        }
        let reasons: Vec<ByteArray> = rows.clone().filter_map(|row| self.reason(row)).map(ByteArray::from).collect();
        let levels: Vec<i16> = rows.map(|row| i16::from(self.reason(row).is_some())).collect();
        let mut column = group.next_column()?.expect("reason");
        column.typed::<ByteArrayType>().write_batch(&reasons, Some(&levels), None)?;
        column.close()?;
        group.close()?;
        file.close()?;
        Ok(())
    }
}
