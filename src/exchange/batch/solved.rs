//! A block of rows, solved, and as bytes.

use std::io::Write;
use std::sync::Arc;

use parquet::basic::{ConvertedType, Repetition, Type as PhysicalType};
use parquet::data_type::{ByteArray, ByteArrayType, DoubleType, Int32Type, Int64Type};
use parquet::file::properties::{EnabledStatistics, WriterProperties, WriterPropertiesPtr};
use parquet::file::writer::SerializedFileWriter;
use parquet::schema::types::{Type, TypePtr};

use super::{InputBlock, RowFormat};
use crate::exchange::model::AngleUnit;
use crate::linkage::{MOST_MODES, Status};
use crate::manipulator::{Manipulator, ModesBatch};

/// A row that cannot be asked.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Reject {
    /// Row of data, from 1.
    pub row: u64,
    /// Why.
    pub reason: String,
}

/// A block of rows with its modes.
#[derive(Clone, Debug)]
pub struct SolvedBlock {
    /// Numbers of the rows solved, from 1.
    numbers: Vec<u64>,
    /// Their inputs as they stand in the file.
    inputs: Vec<f64>,
    width: usize,
    batch: ModesBatch,
    /// Which row of the batch each number belongs to.
    places: Vec<usize>,
    /// Orientations are given in this unit.
    unit: AngleUnit,
    /// Rows that could not be asked, in order.
    pub rejects: Vec<Reject>,
}

fn status_name(status: Status) -> &'static str {
    match status {
        Status::Complete => "complete",
        Status::SelfMotion => "self_motion",
        Status::Undecided => "undecided",
    }
}

impl SolvedBlock {
    /// Reads and solves the rows of a block; angles in the file and in the result in `unit`.
    pub fn of(block: &InputBlock, robot: &Manipulator, unit: AngleUnit) -> Self {
        let rows = block.rows();
        let kinds: Vec<_> = robot.actuated_joints().map(|(leg, joint)| robot.legs[leg].joints[joint]).collect();
        let in_radians: Vec<f64> = rows
            .inputs
            .iter()
            .zip(kinds.iter().cycle())
            .map(|(&value, &kind)| unit.joint_to_rad(kind, value))
            .collect();
        let batch = robot.forward_batch(&in_radians);
        let refused = batch.errors().iter().map(|(row, error)| Reject {
            row: rows.numbers[*row],
            reason: unit.of_lock_error(robot, error.clone()).to_string(),
        });
        let mut rejects: Vec<Reject> = rows.rejects.iter().cloned().chain(refused).collect();
        rejects.sort_by_key(|reject| reject.row);
        let mut refused = batch.errors().iter().map(|(row, _)| *row).peekable();
        let places: Vec<usize> = (0..rows.numbers.len()).filter(|row| refused.next_if_eq(row).is_none()).collect();
        let numbers = places.iter().map(|&row| rows.numbers[row]).collect();
        Self { numbers, inputs: rows.inputs, width: kinds.len(), batch, places, unit, rejects }
    }

    /// How many rows were solved.
    pub fn rows(&self) -> usize {
        self.numbers.len()
    }

    /// How many modes they have together.
    pub fn modes(&self) -> u64 {
        self.places.iter().map(|&row| u64::from(self.batch.counts()[row])).sum()
    }

    fn status(&self, row: usize) -> Status {
        self.batch.statuses()[row].expect("rows with an error are among the rejects")
    }

    fn inputs(&self, row: usize) -> &[f64] {
        &self.inputs[self.width * row..self.width * (row + 1)]
    }

    /// `x, y, phi` of each mode of a row, angles in the file's unit.
    fn poses(&self, row: usize) -> impl Iterator<Item = [f64; 3]> + '_ {
        let poses = &self.batch.poses()[3 * MOST_MODES * row..];
        let count = usize::from(self.batch.counts()[row]);
        poses.chunks_exact(3).take(count).map(|p| [p[0], p[1], self.unit.from_rad(p[2])])
    }

    /// The rows as bytes: lines without a header, or a Parquet file of one row group.
    ///
    /// Columns: `row, q1, q2, q3, status, count, x1, y1, phi1, …, x6, y6, phi6`, empty beyond the count; JSON objects have the same keys, without those beyond
    /// the count.
    pub fn to_bytes(&self, format: RowFormat) -> Vec<u8> {
        match format {
            RowFormat::Csv => self.csv(),
            RowFormat::JsonLines => self.json_lines(),
            RowFormat::Parquet => self.parquet(),
        }
    }

    fn csv(&self) -> Vec<u8> {
        let mut out = Vec::with_capacity(160 * self.rows());
        for (number, &row) in self.numbers.iter().zip(&self.places) {
            // Writing to memory does not fail.
            let _ = write!(out, "{number}");
            self.inputs(row).iter().for_each(|q| _ = write!(out, ",{q}"));
            let count = usize::from(self.batch.counts()[row]);
            let _ = write!(out, ",{},{count}", status_name(self.status(row)));
            self.poses(row).flatten().for_each(|x| _ = write!(out, ",{x}"));
            out.extend(std::iter::repeat_n(b',', 3 * (MOST_MODES - count)));
            out.push(b'\n');
        }
        out
    }

    fn json_lines(&self) -> Vec<u8> {
        let mut out = Vec::with_capacity(240 * self.rows());
        for (number, &row) in self.numbers.iter().zip(&self.places) {
            let _ = write!(out, "{{\"row\":{number}");
            self.inputs(row).iter().zip(1..).for_each(|(q, k)| _ = write!(out, ",\"q{k}\":{q}"));
            let status = status_name(self.status(row));
            let _ = write!(out, ",\"status\":\"{status}\",\"count\":{}", self.batch.counts()[row]);
            for ([x, y, phi], k) in self.poses(row).zip(1..) {
                let _ = write!(out, ",\"x{k}\":{x},\"y{k}\":{y},\"phi{k}\":{phi}");
            }
            out.extend(b"}\n");
        }
        out
    }

    fn parquet(&self) -> Vec<u8> {
        let mut out = Vec::new();
        let written = self.write_parquet(&mut out);
        written.expect("columns of one length in the order of the schema, written to memory");
        out
    }

    fn write_parquet(&self, out: &mut Vec<u8>) -> parquet::errors::Result<()> {
        let mut file = SerializedFileWriter::new(out, schema(self.width), properties())?;
        let mut group = file.next_row_group()?;
        let rows = || self.places.iter().copied();
        let mut integers: Vec<i64> = self.numbers.iter().map(|&n| n as i64).collect();
        let mut column = group.next_column()?.expect("row");
        column.typed::<Int64Type>().write_batch(&integers, None, None)?;
        column.close()?;
        integers.clear();
        let mut numbers: Vec<f64> = Vec::with_capacity(self.rows());
        for k in 0..self.width {
            numbers.clear();
            numbers.extend(rows().map(|row| self.inputs(row)[k]));
            let mut column = group.next_column()?.expect("an input");
            column.typed::<DoubleType>().write_batch(&numbers, None, None)?;
            column.close()?;
        }
        let names = [Status::Complete, Status::SelfMotion, Status::Undecided].map(|s| ByteArray::from(status_name(s)));
        let statuses: Vec<ByteArray> = rows().map(|row| names[self.status(row) as usize].clone()).collect();
        let mut column = group.next_column()?.expect("status");
        column.typed::<ByteArrayType>().write_batch(&statuses, None, None)?;
        column.close()?;
        let counts: Vec<i32> = rows().map(|row| i32::from(self.batch.counts()[row])).collect();
        let mut column = group.next_column()?.expect("count");
        column.typed::<Int32Type>().write_batch(&counts, None, None)?;
        column.close()?;
        let mut levels: Vec<i16> = Vec::with_capacity(self.rows());
        let poses = self.batch.poses();
        for k in 0..3 * MOST_MODES {
            levels.clear();
            levels.extend(counts.iter().map(|&count| i16::from((k / 3) < count as usize)));
            numbers.clear();
            let present = rows().zip(&counts).filter(|&(_, &count)| (k / 3) < count as usize);
            let place = |row: usize| poses[3 * MOST_MODES * row + k];
            if k % 3 == 2 {
                numbers.extend(present.map(|(row, _)| self.unit.from_rad(place(row))));
            } else {
                numbers.extend(present.map(|(row, _)| place(row)));
            }
            let mut column = group.next_column()?.expect("a coordinate");
            column.typed::<DoubleType>().write_batch(&numbers, Some(&levels), None)?;
            column.close()?;
        }
        group.close()?;
        file.close()?;
        Ok(())
    }
}

/// The header of a CSV file.
pub(super) fn header(inputs: usize) -> String {
    let mut names = vec!["row".to_owned()];
    names.extend((1..=inputs).map(|k| format!("q{k}")));
    names.extend(["status".to_owned(), "count".to_owned()]);
    names.extend((1..=MOST_MODES).flat_map(|k| ["x", "y", "phi"].map(|name| format!("{name}{k}"))));
    names.join(",") + "\n"
}

pub(super) fn schema(inputs: usize) -> TypePtr {
    let field = |name: &str, kind, repetition, meaning| {
        let field = Type::primitive_type_builder(name, kind).with_repetition(repetition).with_converted_type(meaning);
        Arc::new(field.build().expect("a plain column"))
    };
    let (required, none) = (Repetition::REQUIRED, ConvertedType::NONE);
    let mut fields = vec![field("row", PhysicalType::INT64, required, none)];
    fields.extend((1..=inputs).map(|k| field(&format!("q{k}"), PhysicalType::DOUBLE, required, none)));
    fields.push(field("status", PhysicalType::BYTE_ARRAY, required, ConvertedType::UTF8));
    fields.push(field("count", PhysicalType::INT32, required, none));
    for k in 1..=MOST_MODES {
        let coordinate = |name: &str| field(&format!("{name}{k}"), PhysicalType::DOUBLE, Repetition::OPTIONAL, none);
        fields.extend(["x", "y", "phi"].map(coordinate));
    }
    Arc::new(Type::group_type_builder("modes").with_fields(fields).build().expect("columns of a table"))
}

/// Coordinates hardly ever repeat: no dictionaries but for the status.
pub(super) fn properties() -> WriterPropertiesPtr {
    let properties = WriterProperties::builder()
        .set_dictionary_enabled(false)
        .set_column_dictionary_enabled("status".into(), true)
        .set_statistics_enabled(EnabledStatistics::None);
    Arc::new(properties.build())
}
