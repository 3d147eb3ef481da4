//! Blocks put together into one file.

use std::io::{self, Write};

use bytes::Bytes;
use parquet::column::writer::ColumnCloseResult;
use parquet::errors::ParquetError;
use parquet::file::reader::{FileReader, SerializedFileReader};
use parquet::file::writer::SerializedFileWriter;
use thiserror::Error;

use super::RowFormat;
use super::solved::{header, properties, schema};

/// Why blocks could not be put together.
#[derive(Debug, Error)]
pub enum BatchWriteError {
    /// Writing failed.
    #[error(transparent)]
    Io(#[from] io::Error),
    /// A block is not what was written, or writing failed.
    #[error(transparent)]
    Parquet(#[from] ParquetError),
}

/// Writes one file out of blocks in their order.
pub struct BatchWriter<W: Write + Send> {
    form: Form<W>,
}

enum Form<W: Write + Send> {
    Lines(W),
    Parquet(Box<SerializedFileWriter<W>>),
}

impl<W: Write + Send> BatchWriter<W> {
    /// Begins a file of modes for so many inputs a row.
    ///
    /// # Errors
    /// Where nothing can be written.
    pub fn new(mut out: W, format: RowFormat, inputs: usize) -> Result<Self, BatchWriteError> {
        let form = match format {
            RowFormat::Csv => {
                out.write_all(header(inputs).as_bytes())?;
                Form::Lines(out)
            }
            RowFormat::JsonLines => Form::Lines(out),
            RowFormat::Parquet => {
                Form::Parquet(Box::new(SerializedFileWriter::new(out, schema(inputs), properties())?))
            }
        };
        Ok(Self { form })
    }

    /// Adds a block, as [`super::SolvedBlock::to_bytes`] gave it.
    ///
    /// # Errors
    /// Where writing fails, or the block is none.
    pub fn add(&mut self, block: Vec<u8>) -> Result<(), BatchWriteError> {
        match &mut self.form {
            Form::Lines(out) => out.write_all(&block)?,
            Form::Parquet(file) => append(file, block.into())?,
        }
        Ok(())
    }

    /// Ends the file; without this it is none.
    ///
    /// # Errors
    /// Where writing fails.
    pub fn finish(self) -> Result<(), BatchWriteError> {
        match self.form {
            Form::Lines(mut out) => out.flush()?,
            Form::Parquet(file) => file.into_inner()?.flush()?,
        }
        Ok(())
    }
}

/// Copies the row groups of a Parquet file, column by column, without decoding them.
fn append<W: Write + Send>(file: &mut SerializedFileWriter<W>, block: Bytes) -> Result<(), ParquetError> {
    let reader = SerializedFileReader::new(block.clone())?;
    for group in reader.metadata().row_groups() {
        let mut out = file.next_row_group()?;
        for column in group.columns() {
            let closed = ColumnCloseResult {
                bytes_written: column.compressed_size() as u64,
                rows_written: group.num_rows() as u64,
                metadata: column.clone(),
                bloom_filter: None,
                column_index: None,
                offset_index: None,
            };
            out.append_column(&block, closed)?;
        }
        out.close()?;
    }
    Ok(())
}
