//! Walks a tree and knows where it is, so that every error can say so.

use nalgebra::Vector2;

use super::error::{FieldProblem, FileError, nearest};
use super::tree::Tree;

/// What files call themselves, with the command that takes each.
const KINDS: [(&str, &str); 9] = [
    ("assur/manipulator/1", "forward"),
    ("assur/triad/1", "triad"),
    ("assur/forward/1", "verify"),
    ("assur/group/1", "group"),
    ("assur/linkage/1", "group"),
    ("assur/coupler/1", "coupler"),
    ("assur/hana/1", "hana"),
    ("assur/tripod/1", "tripod"),
    ("assur/multipteron/1", "multipteron"),
];

/// A value and where it stands.
#[derive(Clone)]
pub(super) struct Field<'a> {
    tree: &'a Tree,
    file: &'a str,
    place: String,
}

/// A table and where it stands; every key is known.
pub(super) struct Table<'a> {
    entries: &'a [(String, Tree)],
    file: &'a str,
    place: String,
}

impl<'a> Field<'a> {
    pub(super) fn root(tree: &'a Tree, file: &'a str) -> Self {
        Self { tree, file, place: String::new() }
    }

    pub(super) fn tree(&self) -> &'a Tree {
        self.tree
    }

    pub(super) fn error(&self, problem: FieldProblem) -> FileError {
        let place =
            if self.place.is_empty() { "file".to_owned() } else { self.place.trim_end_matches(": ").to_owned() };
        FileError::Field { file: self.file.to_owned(), place, problem }
    }

    pub(super) fn not(&self, expected: impl Into<String>) -> FileError {
        self.error(FieldProblem::Kind { expected: expected.into(), found: self.tree.to_string() })
    }

    /// The table, refused where it has a key twice or one that is not `known`.
    pub(super) fn table(&self, known: &[&str]) -> Result<Table<'a>, FileError> {
        let Tree::Table(entries) = self.tree else { return Err(self.not("a table")) };
        let table = Table { entries, file: self.file, place: self.place.clone() };
        for (place, (key, value)) in entries.iter().enumerate() {
            let field = table.field(key, value);
            if !known.contains(&key.as_str()) {
                let nearest = nearest(key, known.iter().copied());
                return Err(field.error(FieldProblem::UnknownKey { nearest }));
            }
            if entries[..place].iter().any(|(earlier, _)| earlier == key) {
                return Err(field.error(FieldProblem::Twice));
            }
        }
        Ok(table)
    }

    /// Refuses a file whose `schema` is that of another command, before its keys are found strange.
    pub(super) fn expect_kind(&self, expected: &'static str) -> Result<(), FileError> {
        let Tree::Table(entries) = self.tree else { return Ok(()) };
        let schema = entries.iter().find(|(key, _)| key == "schema");
        let Some((_, Tree::Text(found))) = schema else { return Ok(()) };
        match KINDS.iter().find(|(name, _)| name == found && *name != expected) {
            Some((_, command)) => {
                let place = Self { place: "schema".to_owned(), ..self.clone() };
                Err(place.error(FieldProblem::OtherKind { found: found.clone(), command, expected }))
            }
            None => Ok(()),
        }
    }

    /// The table, whatever keys it has.
    pub(super) fn open_table(&self) -> Result<Table<'a>, FileError> {
        let Tree::Table(entries) = self.tree else { return Err(self.not("a table")) };
        Ok(Table { entries, file: self.file, place: self.place.clone() })
    }

    /// The items of a list.
    pub(super) fn list(&self, expected: &str) -> Result<Vec<Field<'a>>, FileError> {
        let Tree::List(items) = self.tree else { return Err(self.not(expected)) };
        let place = |number| format!("{}[{number}]", self.place);
        Ok((0..).zip(items).map(|(number, tree)| Field { tree, file: self.file, place: place(number) }).collect())
    }

    /// The items of a list of legs, named `leg 1`, `leg 2`, ….
    pub(super) fn legs(&self) -> Result<Vec<Field<'a>>, FileError> {
        let items = self.list("a list of legs")?;
        Ok((1..).zip(items).map(|(number, item)| Field { place: format!("leg {number}: "), ..item }).collect())
    }

    pub(super) fn array<const N: usize>(&self, expected: &str) -> Result<[Field<'a>; N], FileError> {
        self.list(expected)?.try_into().map_err(|items: Vec<_>| {
            let (expected, found) = (expected.to_owned(), self.tree.to_string());
            self.error(FieldProblem::Length { expected, found, count: items.len() })
        })
    }

    pub(super) fn text(&self, expected: &str) -> Result<&'a str, FileError> {
        match self.tree {
            Tree::Text(text) => Ok(text),
            _ => Err(self.not(expected)),
        }
    }

    /// One of the known texts.
    pub(super) fn one_of(&self, known: &[&str]) -> Result<&'a str, FileError> {
        let found = self.text(&format!("one of the texts {}", known.join(", ")))?;
        if known.contains(&found) {
            return Ok(found);
        }
        Err(self.error(FieldProblem::UnknownText {
            found: found.to_owned(),
            known: known.iter().map(|&text| text.to_owned()).collect(),
            nearest: nearest(found, known.iter().copied()),
        }))
    }

    /// A finite number.
    pub(super) fn number(&self) -> Result<f64, FileError> {
        match *self.tree {
            Tree::Number(value) if value.is_finite() => Ok(value),
            Tree::Number(value) => Err(self.error(FieldProblem::NotFinite { value })),
            _ => Err(self.not("a number")),
        }
    }

    /// Two finite numbers.
    pub(super) fn pair(&self) -> Result<[f64; 2], FileError> {
        let [first, second] = self.array("two numbers")?;
        Ok([first.number()?, second.number()?])
    }

    /// Three finite numbers.
    pub(super) fn triple(&self) -> Result<[f64; 3], FileError> {
        let [first, second, third] = self.array("three numbers")?;
        Ok([first.number()?, second.number()?, third.number()?])
    }

    /// One range for all, or a list of `N`.
    pub(super) fn ranges<const N: usize>(&self) -> Result<[[f64; 2]; N], FileError> {
        let items = self.list("one range [a, b] or a list of them")?;
        if items.iter().all(|item| matches!(item.tree(), Tree::Number(_))) {
            return Ok([self.pair()?; N]);
        }
        let fields: [Field; N] = self.array(&format!("one range [a, b] or a list of {N}"))?;
        let mut ranges = [[0.0; 2]; N];
        for (range, field) in ranges.iter_mut().zip(fields) {
            *range = field.pair()?;
        }
        Ok(ranges)
    }

    pub(super) fn vector(&self) -> Result<Vector2<f64>, FileError> {
        self.pair().map(Vector2::from)
    }
}

impl<'a> Table<'a> {
    fn field(&self, key: &str, tree: &'a Tree) -> Field<'a> {
        let separator = if self.place.is_empty() || self.place.ends_with(": ") { "" } else { "." };
        Field { tree, file: self.file, place: format!("{}{separator}{key}", self.place) }
    }

    /// The field, if it is there.
    pub(super) fn get(&self, key: &str) -> Option<Field<'a>> {
        let (_, tree) = self.entries.iter().find(|(name, _)| name == key)?;
        Some(self.field(key, tree))
    }

    /// The field, which has to be there.
    pub(super) fn need(&self, key: &str, expected: &str) -> Result<Field<'a>, FileError> {
        self.get(key)
            .ok_or_else(|| self.field(key, &Tree::Null).error(FieldProblem::Missing { expected: expected.to_owned() }))
    }
}
