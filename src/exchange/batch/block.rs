//! A file of rows, cut into blocks of whole lines.

use std::hash::{DefaultHasher, Hash, Hasher};
use std::io::{self, BufRead};

use thiserror::Error;

use super::{Reject, RowFormat};

/// Why a file of rows cannot be begun or gone on with.
#[derive(Debug, Error)]
pub enum BatchFileError {
    /// Reading failed.
    #[error("{file}: cannot be read: {error}")]
    Unreadable {
        /// The file.
        file: String,
        /// What the system says.
        error: io::Error,
    },
    /// The header lacks an input, or has none.
    #[error("{file}: header \"{found}\" has no column {missing}; it must have {expected}")]
    Header {
        /// The file.
        file: String,
        /// The header found.
        found: String,
        /// The column that is not there.
        missing: String,
        /// The columns that must be there.
        expected: String,
    },
    /// Parquet cannot be read here.
    #[error("{file}: rows are read from CSV or JSON lines, not from Parquet")]
    Parquet {
        /// The file.
        file: String,
    },
    /// The first line does not end.
    #[error(
        "{file}: the header does not end: lines end with a line feed, and none is longer than {LONGEST_LINE} bytes"
    )]
    Endless {
        /// The file.
        file: String,
    },
}

/// Bytes after which a block ends with its line: some ten thousand rows.
const BLOCK_BYTES: usize = 1 << 20;

/// No row of numbers is longer than this, in bytes; a file without line ends must not fill memory.
const LONGEST_LINE: usize = 1 << 16;

/// Whole lines of a file of rows.
#[derive(Clone, Debug)]
pub struct InputBlock {
    /// Which block of the file it is, from 0.
    pub number: u64,
    /// The number of its first row of data, from 1.
    pub first_row: u64,
    lines: Vec<u8>,
    layout: Layout,
}

/// Stands in a block for a line that is too long.
const TOO_LONG: &[u8] = b"\0\n";

/// Where the inputs are in a line.
#[derive(Clone, Debug)]
enum Layout {
    /// Columns of the inputs, from 0, and how many columns the header has.
    Csv(Vec<usize>, usize),
    /// Lists, or objects with keys `q1`, `q2`, …; so many.
    JsonLines(usize),
}

/// The rows of a block that are numbers.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Rows {
    /// Row numbers, from 1.
    pub numbers: Vec<u64>,
    /// Inputs as they stand in the file, row by row.
    pub inputs: Vec<f64>,
    /// Rows that are none.
    pub rejects: Vec<Reject>,
}

/// The blocks of a file, in order.
pub struct InputBlocks<R> {
    file: String,
    reader: R,
    layout: Layout,
    number: u64,
    next_row: u64,
    failed: bool,
}

impl<R: BufRead> InputBlocks<R> {
    /// Begins a file: CSV with columns `q1`, `q2`, … among others, in any order, or JSON lines of lists or of objects with these keys. `inputs`: how many there are.
    ///
    /// Lines end with a line feed, with or without a carriage return before it; commas part fields even between quotes. Blank lines are no rows; a line of more than 65,536 bytes is
    /// a row that cannot be asked.
    ///
    /// # Errors
    /// A header without one of the inputs or without an end, an unreadable file, Parquet.
    pub fn new(mut reader: R, file: &str, format: RowFormat, inputs: usize) -> Result<Self, BatchFileError> {
        let layout = match format {
            RowFormat::Csv => {
                let mut header = Vec::new();
                let unreadable = |error| BatchFileError::Unreadable { file: file.to_owned(), error };
                limited(&mut reader).read_until(b'\n', &mut header).map_err(unreadable)?;
                if header.len() == LONGEST_LINE && !header.ends_with(b"\n") {
                    return Err(BatchFileError::Endless { file: file.to_owned() });
                }
                csv_layout(&header, file, inputs)?
            }
            RowFormat::JsonLines => Layout::JsonLines(inputs),
            RowFormat::Parquet => return Err(BatchFileError::Parquet { file: file.to_owned() }),
        };
        Ok(Self { file: file.to_owned(), reader, layout, number: 0, next_row: 1, failed: false })
    }

    fn block(&mut self) -> Result<Option<InputBlock>, BatchFileError> {
        let (mut lines, mut rows) = (Vec::with_capacity(BLOCK_BYTES + 256), 0);
        while lines.len() < BLOCK_BYTES {
            let before = lines.len();
            let unreadable = |error| BatchFileError::Unreadable { file: self.file.clone(), error };
            let read = limited(&mut self.reader).read_until(b'\n', &mut lines).map_err(unreadable)?;
            if read == 0 {
                break;
            }
            if read == LONGEST_LINE && !lines.ends_with(b"\n") {
                lines.truncate(before);
                lines.extend(TOO_LONG);
                let mut rest = Vec::new();
                while limited(&mut self.reader).read_until(b'\n', &mut rest).map_err(unreadable)? == LONGEST_LINE
                    && !rest.ends_with(b"\n")
                {
                    rest.clear();
                }
            }
            rows += u64::from(!is_blank(&lines[before..]));
        }
        if rows == 0 && lines.is_empty() {
            return Ok(None);
        }
        let block = InputBlock { number: self.number, first_row: self.next_row, lines, layout: self.layout.clone() };
        self.number += 1;
        self.next_row += rows;
        Ok(Some(block))
    }
}

impl<R: BufRead> Iterator for InputBlocks<R> {
    type Item = Result<InputBlock, BatchFileError>;

    fn next(&mut self) -> Option<Self::Item> {
        if self.failed {
            return None;
        }
        let block = self.block().transpose();
        self.failed = matches!(block, Some(Err(_)));
        block
    }
}

/// The reader up to the longest line.
fn limited<R: BufRead>(reader: &mut R) -> io::Take<&mut R> {
    io::Read::take(reader, LONGEST_LINE as u64)
}

/// Blank lines are no rows.
fn is_blank(line: &[u8]) -> bool {
    line.iter().all(|byte| matches!(byte, b'\n' | b'\r'))
}

fn csv_layout(header: &[u8], file: &str, inputs: usize) -> Result<Layout, BatchFileError> {
    let header = String::from_utf8_lossy(header);
    let text = header.trim_start_matches('\u{feff}').trim_end_matches(['\r', '\n']);
    if text.contains('\r') {
        return Err(BatchFileError::Endless { file: file.to_owned() });
    }
    let names: Vec<&str> = text.split(',').map(|name| name.trim().trim_matches('"')).collect();
    let wanted: Vec<String> = (1..=inputs).map(|k| format!("q{k}")).collect();
    let column = |name: &String| {
        names.iter().position(|found| found == name).ok_or_else(|| BatchFileError::Header {
            file: file.to_owned(),
            found: text.chars().take(80).collect(),
            missing: name.clone(),
            expected: wanted.join(","),
        })
    };
    Ok(Layout::Csv(wanted.iter().map(column).collect::<Result<_, _>>()?, names.len()))
}

impl InputBlock {
    /// A number that tells this block's content from others'.
    pub fn fingerprint(&self, of_the_rest: &impl Hash) -> u64 {
        let mut hasher = DefaultHasher::new();
        of_the_rest.hash(&mut hasher);
        self.number.hash(&mut hasher);
        self.first_row.hash(&mut hasher);
        self.lines.hash(&mut hasher);
        if let Layout::Csv(columns, count) = &self.layout {
            (columns, count).hash(&mut hasher);
        }
        hasher.finish()
    }

    /// How many bytes of the file it is.
    pub fn bytes(&self) -> usize {
        self.lines.len()
    }

    /// The rows, and those that are none.
    pub(super) fn rows(&self) -> Rows {
        match &self.layout {
            Layout::Csv(columns, count) => self.csv_rows(columns, *count),
            Layout::JsonLines(inputs) => self.json_rows(*inputs),
        }
    }

    /// The lines that are rows, with their numbers; the same rule that counted them.
    fn numbered(&self) -> impl Iterator<Item = (u64, &[u8])> {
        (self.first_row..).zip(self.lines.split(|&byte| byte == b'\n').filter(|line| !is_blank(line)))
    }

    fn csv_rows(&self, columns: &[usize], count: usize) -> Rows {
        let mut out = Rows::default();
        let mut fields: Vec<&[u8]> = Vec::with_capacity(count);
        for (row, line) in self.numbered() {
            fields.clear();
            fields.extend(line.split(|&byte| byte == b','));
            out.push(row, line, |inputs| {
                if fields.len() != count {
                    return Err(format!("{} values, must be {count}", fields.len()));
                }
                for (&column, input) in columns.iter().zip(1..) {
                    inputs.push(number(fields[column], input)?);
                }
                Ok(())
            });
        }
        out
    }

    fn json_rows(&self, inputs: usize) -> Rows {
        let mut out = Rows::default();
        for (row, line) in self.numbered() {
            out.push(row, line, |values| {
                values.extend(json_values(line, inputs)?);
                Ok(())
            });
        }
        out
    }
}

impl Rows {
    /// Adds a row, whose values `read` appends, or its reject.
    fn push(&mut self, row: u64, line: &[u8], read: impl FnOnce(&mut Vec<f64>) -> Result<(), String>) {
        let before = self.inputs.len();
        let result = if TOO_LONG.starts_with(line) {
            Err(format!("a line of more than {LONGEST_LINE} bytes is no row"))
        } else {
            read(&mut self.inputs)
        };
        match result {
            Ok(()) => self.numbers.push(row),
            Err(reason) => {
                self.inputs.truncate(before);
                self.rejects.push(Reject { row, reason });
            }
        }
    }
}

fn number(text: &[u8], input: usize) -> Result<f64, String> {
    let text = text.trim_ascii();
    let unquoted = text.strip_prefix(b"\"").and_then(|t| t.strip_suffix(b"\"")).unwrap_or(text);
    let value = std::str::from_utf8(unquoted).ok().and_then(|text| text.parse::<f64>().ok());
    value.filter(|value| value.is_finite()).ok_or_else(|| {
        let found: String = String::from_utf8_lossy(text).chars().take(40).collect();
        format!("q{input}: \"{found}\" must be a finite number")
    })
}

fn json_values(line: &[u8], inputs: usize) -> Result<Vec<f64>, String> {
    use serde_json::Value;
    let value: Value = serde_json::from_slice(line).map_err(|error| format!("not valid JSON: {error}"))?;
    let given: Vec<&Value> = match &value {
        Value::Array(values) if values.len() == inputs => values.iter().collect(),
        Value::Array(values) => return Err(format!("{} values, must be {inputs}", values.len())),
        Value::Object(fields) => {
            let named = |k: usize| fields.get(&format!("q{k}")).ok_or_else(|| format!("q{k} is missing"));
            (1..=inputs).map(named).collect::<Result<_, _>>()?
        }
        _ => return Err("must be a list of numbers or an object with keys q1, q2, …".to_owned()),
    };
    let number = |(value, k): (&Value, usize)| {
        value.as_f64().filter(|x| x.is_finite()).ok_or_else(|| format!("q{k}: {value} must be a finite number"))
    };
    given.into_iter().zip(1..).map(number).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn rows(text: &str, format: RowFormat) -> Vec<Rows> {
        let blocks = InputBlocks::new(text.as_bytes(), "in.csv", format, 3).expect("a header");
        blocks.map(|block| block.expect("readable").rows()).collect()
    }

    #[test]
    fn columns_stand_in_any_order_and_bad_rows_are_named() {
        let text = "id,q2,q1,q3\na,2,1,3\n\nb,5,4,x\nc,8,7,9,0\nd,inf,1,2\ne, 11 ,10,\"12\"\r\n";
        let [found] = &rows(text, RowFormat::Csv)[..] else { panic!("one block") };
        assert_eq!(found.inputs, [1.0, 2.0, 3.0, 10.0, 11.0, 12.0]);
        assert_eq!(found.numbers, [1, 5]);
        let reasons: Vec<(u64, &str)> = found.rejects.iter().map(|r| (r.row, r.reason.as_str())).collect();
        assert_eq!(
            reasons,
            [
                (2, "q3: \"x\" must be a finite number"),
                (3, "5 values, must be 4"),
                (4, "q2: \"inf\" must be a finite number")
            ]
        );
    }

    #[test]
    fn json_lines_are_lists_or_objects() {
        let text = "[1,2,3]\n{\"q3\":6,\"q1\":4,\"q2\":5}\n[1,2]\n{\"q1\":1}\nnull\n[1,\"2\",3]\n";
        let [found] = &rows(text, RowFormat::JsonLines)[..] else { panic!("one block") };
        assert_eq!(found.inputs, [1.0, 2.0, 3.0, 4.0, 5.0, 6.0]);
        assert_eq!(found.rejects.iter().map(|r| r.row).collect::<Vec<_>>(), [3, 4, 5, 6]);
    }

    #[test]
    fn blocks_end_with_lines_and_count_rows_through() {
        let mut text = "q1,q2,q3\n".to_owned();
        for row in 0..100_000 {
            text.push_str(&format!("{row},{}.5,-1e-3\n", row + 1));
        }
        let blocks = rows(&text, RowFormat::Csv);
        assert!(blocks.len() > 1);
        let numbers: Vec<u64> = blocks.iter().flat_map(|rows| rows.numbers.clone()).collect();
        assert_eq!(numbers, (1..=100_000).collect::<Vec<u64>>());
        assert_eq!(blocks.iter().map(|rows| rows.inputs.len()).sum::<usize>(), 300_000);
    }

    #[test]
    fn files_that_cannot_be_begun_say_why() {
        let begin = |text: &'static str| InputBlocks::new(text.as_bytes(), "in.csv", RowFormat::Csv, 3).err();
        let message = begin("q1,q3\n1,2\n").expect("no q2").to_string();
        assert_eq!(message, "in.csv: header \"q1,q3\" has no column q2; it must have q1,q2,q3");
        assert!(begin("").expect("nothing").to_string().contains("q1"));
        assert!(begin("q1,q2,q3\r1,2,3\r").expect("no line feed").to_string().contains("does not end"));
    }

    #[test]
    fn lines_are_counted_as_they_are_read() {
        let long = "1".repeat(200_000);
        let text = format!("q1,q2,q3\r\n1,2,3\r\n\r\n{long}\n4,5\r6,7\n8,9,10");
        let [found] = &rows(&text, RowFormat::Csv)[..] else { panic!("one block") };
        assert_eq!((&found.numbers[..], &found.inputs[..]), (&[1, 4][..], &[1.0, 2.0, 3.0, 8.0, 9.0, 10.0][..]));
        assert_eq!(found.rejects.iter().map(|r| r.row).collect::<Vec<_>>(), [2, 3]);
        assert!(found.rejects[0].reason.contains("65536"), "{}", found.rejects[0].reason);
    }
}
