//! Where a page is found: a port of this machine, and a token that only who was given the address knows.

use std::fmt;

/// Letters of a token: 128 random bits in hexadecimal.
const TOKEN_LETTERS: usize = 32;

/// The address of an explorer.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Address {
    /// 0 before the system has chosen one.
    pub(crate) port: u16,
    pub(crate) token: String,
}

impl Address {
    pub(crate) fn random() -> Self {
        let mut bytes = [0; TOKEN_LETTERS / 2];
        getrandom::fill(&mut bytes).expect("the operating system gives random bytes");
        Self { port: 0, token: bytes.iter().map(|byte| format!("{byte:02x}")).collect() }
    }

    /// An address that was printed before or stands in a browser, and the view that it holds: the part from `#` on.
    pub(crate) fn parse(text: &str) -> Option<(Self, String)> {
        let rest = ["http://127.0.0.1:", "http://localhost:"].iter().find_map(|start| text.strip_prefix(start))?;
        let (port, rest) = rest.split_once('/')?;
        let (rest, view) = rest.split_once('#').unwrap_or((rest, ""));
        let token = rest.split(['/', '?']).next()?;
        let sound = token.len() == TOKEN_LETTERS && token.chars().all(|letter| letter.is_ascii_hexdigit());
        // It is handed to the desktop's shell: nothing else than what a page writes goes there.
        let written = |letter: char| letter.is_ascii_alphanumeric() || "-_".contains(letter);
        let view = if !view.is_empty() && view.chars().all(written) { format!("#{view}") } else { String::new() };
        Some((Self { port: port.parse().ok()?, token: token.to_owned() }, view)).filter(|_| sound)
    }

    /// What may follow the token, if the path begins with it. Takes as long for every wrong token of the right length.
    pub(crate) fn inside<'a>(&self, path: &'a str) -> Option<&'a str> {
        let (token, rest) = path.strip_prefix('/')?.split_once('/')?;
        let same_length = token.len() == self.token.len();
        let difference = token.bytes().zip(self.token.bytes()).fold(0, |all, (a, b)| all | (a ^ b));
        (same_length && difference == 0).then_some(rest)
    }

    /// Whether a `Host` header means this server: a page elsewhere that has its name resolved to this machine says another one.
    pub(crate) fn is_host(&self, host: &str) -> bool {
        host == format!("127.0.0.1:{}", self.port) || host == format!("localhost:{}", self.port)
    }

    /// Whether an `Origin` header is of a page of this server.
    pub(crate) fn is_origin(&self, origin: &str) -> bool {
        origin.strip_prefix("http://").is_some_and(|host| self.is_host(host))
    }
}

impl fmt::Display for Address {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "http://127.0.0.1:{}/{}/", self.port, self.token)
    }
}
