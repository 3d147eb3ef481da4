//! `forward --batch`: files of rows, block by block, with parts that a later run takes up.
//!
//! Each block of the input becomes a part, written under another name and renamed when whole. A part's name holds a fingerprint of all that went into it, so that a
//! later run knows which parts are still right. They are joined as they come, in their order, while others are being solved; the output appears when all are there.

use std::collections::BTreeMap;
use std::fs::{self, File, TryLockError};
use std::io::{self, BufRead, BufReader, BufWriter, Write};
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::sync::{Arc, Mutex, mpsc};
use std::thread::JoinHandle;
use std::time::Instant;

use assur::exchange::{
    BatchWriteError, BatchWriter, InputBlock, InputBlocks, ModelFile, Reject, RowFormat, SolvedBlock,
};
use rayon::prelude::*;
use serde::Serialize;

use crate::args::Rows;
use crate::output::{Failure, print, progress};

/// Runs a batch from file to file.
pub(crate) fn run(
    model: &Path,
    input: &Path,
    output: Option<&Path>,
    format: Option<Rows>,
    json: bool,
) -> Result<(), Failure> {
    let output = output.expect("the command line asks for an output with a batch");
    let format = output_format(output, format)?;
    // What a link leads to is written, not the link.
    let resolved = fs::canonicalize(output).ok();
    for source in [input, model] {
        if resolved.is_some() && fs::canonicalize(source).ok() == resolved {
            let reason = "is read for this batch and must not be written over";
            return Err(Failure::About(output.display().to_string(), reason.to_owned()));
        }
    }
    let output = resolved.as_deref().unwrap_or(output);
    let (reader, size) = open(input)?;
    let job = Job {
        model: ModelFile::read(model)?,
        format,
        counts: Counts::default(),
        started: Instant::now(),
        waits_for_nobody: size.is_some(),
    };
    let bar = match size {
        Some(_) => progress(size, "{wide_bar} {percent}% of {total_bytes}, {bytes_per_sec}, {eta} left"),
        None => progress(None, "{spinner} {bytes}, {bytes_per_sec}, {elapsed}"),
    };
    let reader = BufReader::with_capacity(1 << 20, bar.wrap_read(reader));
    let inputs = job.model.manipulator.actuated_joints().count();
    let in_format = RowFormat::of_path(input).unwrap_or(RowFormat::Csv);
    let blocks = InputBlocks::new(reader, &input.display().to_string(), in_format, inputs)?;
    let standard = output == Path::new("-");
    let summary = if standard {
        job.to_stream(blocks, io::stdout(), &Failure::Print)?
    } else if fs::metadata(output).is_ok_and(|target| !target.is_file() && !target.is_dir()) {
        // A pipe or a device cannot be replaced, and keeps no parts.
        let file = File::options().write(true).open(output).map_err(unwritable(output))?;
        job.to_stream(blocks, file, &unwritable(output))?
    } else {
        job.to_file(blocks, output)?
    };
    bar.finish_and_clear();
    match summary {
        // Standard output is taken; the summary must not get in between.
        summary if standard => {
            let _ = writeln!(anstream::stderr(), "{}", summary.in_words());
            Ok(())
        }
        summary if json => {
            let text = serde_json::to_string_pretty(&summary).expect("plain numbers and texts");
            print(&(text + "\n"))
        }
        summary => print(&(summary.in_words() + "\n")),
    }
}

fn output_format(output: &Path, asked: Option<Rows>) -> Result<RowFormat, Failure> {
    let asked = asked.map(|rows| match rows {
        Rows::Csv => RowFormat::Csv,
        Rows::Jsonl => RowFormat::JsonLines,
        Rows::Parquet => RowFormat::Parquet,
    });
    let of_name = RowFormat::of_path(output).or((output == Path::new("-")).then_some(RowFormat::Csv));
    asked.or(of_name).ok_or_else(|| {
        let reason = "the name tells no form: end it in .csv, .jsonl or .parquet, or give --format";
        Failure::About(output.display().to_string(), reason.to_owned())
    })
}

fn open(input: &Path) -> Result<(Box<dyn io::Read + Send>, Option<u64>), Failure> {
    if input == Path::new("-") {
        return Ok((Box::new(io::stdin()), None));
    }
    let failed = |error: io::Error| Failure::About(input.display().to_string(), format!("cannot be read: {error}"));
    let file = File::open(input).map_err(failed)?;
    let size = file.metadata().map_err(failed)?;
    if size.is_dir() {
        return Err(failed(io::ErrorKind::IsADirectory.into()));
    }
    let size = size.is_file().then_some(size.len());
    Ok((Box::new(file), size))
}

/// A batch and how far it has come.
struct Job {
    model: ModelFile,
    format: RowFormat,
    counts: Counts,
    started: Instant,
    /// Rows come from a file, not from a pipe that may stand still.
    waits_for_nobody: bool,
}

#[derive(Default)]
struct Counts {
    rows: AtomicU64,
    modes: AtomicU64,
    rejects: AtomicU64,
}

/// What a batch came to.
#[derive(Serialize)]
struct Summary {
    schema: &'static str,
    /// Rows solved, those of earlier runs included.
    rows: u64,
    rejected: u64,
    /// Modes of the rows solved in this run.
    modes: u64,
    /// Rows of parts that an earlier run left.
    taken_up: u64,
    rejects_file: Option<String>,
    seconds: f64,
}

impl Summary {
    fn in_words(&self) -> String {
        let mut text = format!("{} rows solved in {:.2} s", self.rows, self.seconds);
        let fresh = self.rows - self.taken_up;
        if fresh > 0 {
            text += &format!(", {:.2} modes a row", self.modes as f64 / fresh as f64);
        }
        if self.taken_up > 0 {
            text += &format!("; {} of them taken up from an earlier run", self.taken_up);
        }
        if self.rejected > 0 {
            let place = self.rejects_file.as_deref().map_or(String::new(), |file| format!(", see {file}"));
            text += &format!("; {} rows rejected{place}", self.rejected);
        }
        text
    }
}

/// A block's modes and rejects as bytes, and how many rows it has.
struct Part {
    bytes: Vec<u8>,
    rejects: Vec<u8>,
    rows: u64,
}

impl Job {
    fn solve(&self, block: &InputBlock) -> Part {
        let solved = SolvedBlock::of(block, &self.model.manipulator, self.model.angle_unit);
        self.counts.rows.fetch_add(solved.rows() as u64, Ordering::Relaxed);
        self.counts.modes.fetch_add(solved.modes(), Ordering::Relaxed);
        self.counts.rejects.fetch_add(solved.rejects.len() as u64, Ordering::Relaxed);
        Part { bytes: solved.to_bytes(self.format), rejects: rejects_csv(&solved.rejects), rows: solved.rows() as u64 }
    }

    fn inputs(&self) -> usize {
        self.model.manipulator.actuated_joints().count()
    }

    fn summary(&self, taken_up: [u64; 2], rejects_file: Option<String>) -> Summary {
        let count = |counter: &AtomicU64| counter.load(Ordering::Relaxed);
        Summary {
            schema: "assur/batch/1",
            rows: count(&self.counts.rows) + taken_up[0],
            rejected: count(&self.counts.rejects) + taken_up[1],
            modes: count(&self.counts.modes),
            taken_up: taken_up[0],
            rejects_file,
            seconds: self.started.elapsed().as_secs_f64(),
        }
    }

    /// In order, as many blocks at a time as there are threads; rejects go to standard error.
    fn to_stream<R: BufRead>(
        &self,
        mut blocks: InputBlocks<R>,
        out: impl Write + Send,
        unwritable: &dyn Fn(io::Error) -> Failure,
    ) -> Result<Summary, Failure> {
        let failed = |error: BatchWriteError| match error {
            BatchWriteError::Io(error) => unwritable(error),
            other => Failure::About("output".to_owned(), other.to_string()),
        };
        let mut writer = BatchWriter::new(BufWriter::new(out), self.format, self.inputs()).map_err(failed)?;
        loop {
            let some: Vec<InputBlock> = blocks.by_ref().take(rayon::current_num_threads()).collect::<Result<_, _>>()?;
            if some.is_empty() {
                break;
            }
            let parts: Vec<Part> = some.par_iter().map(|block| self.solve(block)).collect();
            for part in parts {
                let _ = anstream::stderr().write_all(&part.rejects);
                writer.add(part.bytes).map_err(failed)?;
            }
        }
        writer.finish().map_err(failed)?;
        Ok(self.summary([0, 0], None))
    }

    fn to_file<R: BufRead + Send>(&self, blocks: InputBlocks<R>, output: &Path) -> Result<Summary, Failure> {
        let parts = Parts::beside(output)?;
        let interrupted = Arc::new(AtomicBool::new(false));
        if self.waits_for_nobody {
            // Without a handler Ctrl-C ends the program at once, which loses no part either; a second one does so here too.
            let flag = Arc::clone(&interrupted);
            let _ = ctrlc::set_handler(move || {
                if flag.swap(true, Ordering::Relaxed) {
                    std::process::exit(130);
                }
            });
        }
        let rest = (self.model.to_toml(), self.format, env!("CARGO_PKG_VERSION"));
        let taken_up: Mutex<[u64; 2]> = Mutex::default();
        let mut joiner = Joiner::begin(&parts, output, self.format, self.inputs())?;
        let (names, ready) = mpsc::channel();
        let (solved, joined) = std::thread::scope(|scope| {
            let joining = scope.spawn(|| -> Result<(), Failure> {
                for (number, name) in ready {
                    joiner.add(number, name)?;
                }
                Ok(())
            });
            let solved = blocks.par_bridge().try_for_each_with(names, |names, block| {
                let block = block?;
                if interrupted.load(Ordering::Relaxed) {
                    return Err(Failure::About(output.display().to_string(), parts.how_to_go_on()));
                }
                let name = format!("{:08}-{:016x}", block.number, block.fingerprint(&rest));
                match parts.counts(&name) {
                    Some(found) => {
                        let mut all = taken_up.lock().expect("no thread panics");
                        *all = [all[0] + found[0], all[1] + found[1]];
                    }
                    None => parts.write(&name, &self.solve(&block))?,
                }
                // Nobody listens where joining has failed, whose reason comes first below.
                let stopped = |_| Failure::About(output.display().to_string(), "joining has stopped".to_owned());
                names.send((block.number, name)).map_err(stopped)
            });
            (solved, joining.join().expect("no thread panics"))
        });
        joined?;
        solved?;
        let rejects_file = joiner.finish()?;
        parts.remove();
        Ok(self.summary(taken_up.into_inner().expect("no thread panics"), rejects_file))
    }
}

fn rejects_csv(rejects: &[Reject]) -> Vec<u8> {
    let mut out = csv::Writer::from_writer(Vec::new());
    for reject in rejects {
        out.write_record([&reject.row.to_string(), &reject.reason]).expect("two fields, written to memory");
    }
    out.into_inner().expect("written to memory")
}

/// The folder of parts beside an output.
struct Parts {
    folder: PathBuf,
    /// Held as long as this run writes here.
    _lock: File,
}

fn unwritable(path: &Path) -> impl Fn(io::Error) -> Failure + '_ {
    |error| Failure::Unwritable(path.display().to_string(), error)
}

/// A path with something after its name.
fn with_ending(path: &Path, ending: &str) -> PathBuf {
    let mut name = path.as_os_str().to_owned();
    name.push(ending);
    name.into()
}

/// Names in the folder of parts that belong to no part.
const LOCK: &str = "lock";
const JOINED: &str = "joined.tmp";
const REJECTS: &str = "rejects.tmp";

impl Drop for Parts {
    /// A folder in which nothing is left goes; one with parts stays for the next run.
    fn drop(&mut self) {
        let _ = fs::remove_file(self.folder.join(LOCK));
        let _ = fs::remove_dir(&self.folder);
    }
}

impl Parts {
    fn beside(output: &Path) -> Result<Self, Failure> {
        if output.is_dir() {
            return Err(unwritable(output)(io::ErrorKind::IsADirectory.into()));
        }
        let folder = with_ending(output, ".parts");
        match fs::create_dir(&folder) {
            Err(error) if error.kind() != io::ErrorKind::AlreadyExists => return Err(unwritable(&folder)(error)),
            _ => {}
        }
        let path = folder.join(LOCK);
        let lock = File::create(&path).map_err(unwritable(&path))?;
        match lock.try_lock() {
            Ok(()) => Ok(Self { folder, _lock: lock }),
            Err(TryLockError::WouldBlock) => {
                Err(Failure::About(output.display().to_string(), "another run is writing this".to_owned()))
            }
            Err(TryLockError::Error(error)) => Err(unwritable(&path)(error)),
        }
    }

    fn how_to_go_on(&self) -> String {
        format!("interrupted; the same command goes on from the parts in {}", self.folder.display())
    }

    fn path(&self, name: &str, ending: &str) -> PathBuf {
        self.folder.join(format!("{name}.{ending}"))
    }

    /// Rows and rejects of a part that is there and whole: its counts are written last, with the lengths of its files.
    fn counts(&self, name: &str) -> Option<[u64; 2]> {
        let text = fs::read_to_string(self.path(name, "done")).ok()?;
        let numbers: Vec<u64> = text.split_whitespace().map(str::parse).collect::<Result<_, _>>().ok()?;
        let &[rows, rejects, row_bytes, reject_bytes] = &numbers[..] else { return None };
        let has = |ending, bytes| fs::metadata(self.path(name, ending)).is_ok_and(|file| file.len() == bytes);
        (has("rows", row_bytes) && has("rejects", reject_bytes)).then_some([rows, rejects])
    }

    fn write(&self, name: &str, part: &Part) -> Result<(), Failure> {
        let rejects = part.rejects.iter().filter(|&&byte| byte == b'\n').count();
        let done = format!("{} {rejects} {} {}\n", part.rows, part.bytes.len(), part.rejects.len());
        for (ending, content) in [("rows", &part.bytes[..]), ("rejects", &part.rejects[..]), ("done", done.as_bytes())]
        {
            let path = self.path(name, ending);
            let temporary = with_ending(&path, ".tmp");
            let written = fs::write(&temporary, content).and_then(|()| fs::rename(&temporary, &path));
            if written.is_err() {
                let _ = fs::remove_file(&temporary);
            }
            written.map_err(unwritable(&path))?;
        }
        Ok(())
    }

    fn read(&self, name: &str, ending: &str) -> Result<Vec<u8>, Failure> {
        let path = self.path(name, ending);
        fs::read(&path).map_err(|error| Failure::About(path.display().to_string(), format!("cannot be read: {error}")))
    }

    /// Removes the parts, also those of other questions, and the folder where nothing else is in it. The answer is there: what cannot be removed does no harm.
    fn remove(&self) {
        let is_part = |name: &str| {
            let (number, rest) = name.split_at_checked(8)?;
            let fingerprint = rest.strip_prefix('-')?.split_once('.')?.0;
            let hexadecimal = fingerprint.len() == 16 && u64::from_str_radix(fingerprint, 16).is_ok();
            (hexadecimal && number.parse::<u64>().is_ok()).then_some(())
        };
        let is_ours = |name: &str| [JOINED, REJECTS].contains(&name) || is_part(name).is_some();
        for entry in fs::read_dir(&self.folder).into_iter().flatten().flatten() {
            if entry.file_name().to_str().is_some_and(is_ours) {
                let _ = fs::remove_file(entry.path());
            }
        }
    }
}

/// Puts parts together in their order, under another name, as they come.
struct Joiner<'a> {
    parts: &'a Parts,
    output: &'a Path,
    rows: Option<BatchWriter<BufWriter<Growing>>>,
    /// Brings the rows to the disk while they grow.
    syncing: Option<JoinHandle<io::Result<()>>>,
    rejects: BufWriter<File>,
    any_rejects: bool,
    /// Parts that wait for an earlier one: their names alone, so that memory stays flat.
    waiting: BTreeMap<u64, String>,
    next: u64,
}

impl<'a> Joiner<'a> {
    fn begin(parts: &'a Parts, output: &'a Path, format: RowFormat, inputs: usize) -> Result<Self, Failure> {
        let (joined, rejects) = (parts.folder.join(JOINED), parts.folder.join(REJECTS));
        let file = File::create(&joined).map_err(unwritable(&joined))?;
        let (file, syncing) = Growing::begin(file).map_err(unwritable(&joined))?;
        let file = BufWriter::with_capacity(1 << 20, file);
        let rows = BatchWriter::new(file, format, inputs).map_err(|error| unwritable_rows(&joined, error))?;
        let mut file = BufWriter::new(File::create(&rejects).map_err(unwritable(&rejects))?);
        file.write_all(b"row,reason\n").map_err(unwritable(&rejects))?;
        Ok(Self {
            parts,
            output,
            rows: Some(rows),
            syncing: Some(syncing),
            rejects: file,
            any_rejects: false,
            waiting: BTreeMap::new(),
            next: 0,
        })
    }

    /// Takes a part, and appends what is next.
    fn add(&mut self, number: u64, name: String) -> Result<(), Failure> {
        self.waiting.insert(number, name);
        while let Some(name) = self.waiting.remove(&self.next) {
            self.next += 1;
            let rows = self.parts.read(&name, "rows")?;
            let writer = self.rows.as_mut().expect("not finished");
            writer.add(rows).map_err(|error| unwritable_rows(&self.parts.folder.join(JOINED), error))?;
            let rejects = self.parts.read(&name, "rejects")?;
            self.any_rejects |= !rejects.is_empty();
            self.rejects.write_all(&rejects).map_err(unwritable(&self.parts.folder.join(REJECTS)))?;
        }
        Ok(())
    }

    /// The output appears, last; gives the name of the file of rejects, where there is one.
    fn finish(&mut self) -> Result<Option<String>, Failure> {
        let (joined, rejects) = (self.parts.folder.join(JOINED), self.parts.folder.join(REJECTS));
        let rejects_path = with_ending(self.output, ".rejects.csv");
        let writer = self.rows.take().expect("finished once");
        writer.finish().map_err(|error| unwritable_rows(&joined, error))?;
        // Only what has reached the disk may take the output's name; an error that the other thread was told is told once.
        let syncing = self.syncing.take().expect("finished once");
        syncing.join().expect("no thread panics").map_err(unwritable(&joined))?;
        File::open(&joined).and_then(|file| file.sync_all()).map_err(unwritable(&joined))?;
        self.rejects.flush().map_err(unwritable(&rejects))?;
        if self.any_rejects {
            self.rejects.get_ref().sync_all().map_err(unwritable(&rejects))?;
            fs::rename(&rejects, &rejects_path).map_err(unwritable(&rejects_path))?;
        } else {
            // What an earlier batch left would be taken for this one's.
            match fs::remove_file(&rejects_path) {
                Err(error) if error.kind() != io::ErrorKind::NotFound => return Err(unwritable(&rejects_path)(error)),
                _ => {}
            }
        }
        fs::rename(&joined, self.output).map_err(unwritable(self.output))?;
        Ok(self.any_rejects.then(|| rejects_path.display().to_string()))
    }
}

impl Drop for Joiner<'_> {
    /// What is not whole goes; the parts stay.
    fn drop(&mut self) {
        let _ = fs::remove_file(self.parts.folder.join(JOINED));
        let _ = fs::remove_file(self.parts.folder.join(REJECTS));
    }
}

fn unwritable_rows(path: &Path, error: BatchWriteError) -> Failure {
    match error {
        BatchWriteError::Io(error) => unwritable(path)(error),
        other => Failure::About(path.display().to_string(), other.to_string()),
    }
}

/// A file that is brought to the disk while it grows, by a thread of its own: at the end little is left to wait for.
struct Growing {
    file: File,
    unsynced: usize,
    /// Asks for what is written so far; full where the disk is behind, which is no reason to wait.
    sync: mpsc::SyncSender<()>,
}

/// Bytes after which the disk is asked to take what is there: some tenths of a second of a slow one.
const SYNC_BYTES: usize = 1 << 24;

impl Growing {
    /// The file, and the thread, which ends when the file is closed.
    fn begin(file: File) -> io::Result<(Self, JoinHandle<io::Result<()>>)> {
        let (sync, asked) = mpsc::sync_channel(1);
        let same = file.try_clone()?;
        let syncing = std::thread::spawn(move || asked.iter().try_for_each(|()| same.sync_data()));
        Ok((Self { file, unsynced: 0, sync }, syncing))
    }
}

impl Write for Growing {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        let written = self.file.write(bytes)?;
        self.unsynced += written;
        if self.unsynced >= SYNC_BYTES {
            self.unsynced = 0;
            let _ = self.sync.try_send(());
        }
        Ok(written)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.file.flush()
    }
}
