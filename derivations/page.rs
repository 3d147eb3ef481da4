//! A worked text that checks itself: every identity is asserted while the text is being written.

/// A document under way.
pub struct Page {
    text: String,
    steps: usize,
}

/// No line of a document is wider.
const WIDTH: usize = 100;

impl Page {
    /// A document with its title and opening: claim, symbols, source.
    pub fn new(title: &str, opening: &str) -> Self {
        let rule = "=".repeat(title.chars().count());
        Self { text: format!("{title}\n{rule}\n\n{}", filled(opening, "")), steps: 0 }
    }

    /// The next numbered step, with the reasoning that leads to its identities.
    pub fn step(&mut self, heading: &str, reasoning: &str) {
        self.steps += 1;
        self.text += &format!("\n{}. {heading}\n\n", self.steps);
        self.text += &filled(reasoning, "   ");
    }

    /// Two things that are the same, exactly; the statement is printed once they are.
    pub fn equal<T: PartialEq>(&mut self, statement: &str, left: &T, right: &T) {
        self.holds(statement, left == right);
    }

    /// A fact; printed once it holds.
    pub fn holds(&mut self, statement: &str, fact: bool) {
        assert!(fact, "step {} fails: {statement}", self.steps);
        for (k, line) in statement.trim().lines().enumerate() {
            self.text += &format!("   {} {line}\n", if k == 0 { "[=]" } else { "   " });
        }
    }

    /// The finished text.
    pub fn finish(self) -> String {
        for line in self.text.lines() {
            assert!(line.chars().count() <= WIDTH, "line too wide: {line}");
        }
        self.text
    }
}

/// The text with its lines filled to the width; lines that are indented or set with wider spaces stay as they are.
fn filled(text: &str, indent: &str) -> String {
    let mut lines: Vec<(bool, String)> = Vec::new();
    for line in text.trim().lines() {
        let set = line.is_empty() || line.contains("  ");
        if set {
            lines.push((true, line.to_string()));
            continue;
        }
        for word in line.split_whitespace() {
            match lines.last_mut() {
                Some((false, last)) if indent.len() + last.chars().count() + word.chars().count() < WIDTH => {
                    *last += " ";
                    *last += word;
                }
                _ => lines.push((false, word.to_string())),
            }
        }
    }
    lines.iter().map(|(_, line)| format!("{}\n", format!("{indent}{line}").trim_end())).collect()
}
