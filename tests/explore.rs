//! The explorer's server: who may ask, what is refused, and that a conversation survives what goes wrong in it. The page itself is tested in a browser, `tests/web/`.
#![cfg(feature = "explore")]

use std::io::{BufRead, BufReader, Read, Write};
use std::net::TcpStream;
use std::process::{Child, Command, Stdio};
use std::time::Duration;

use serde_json::{Value, json};

/// A running explorer; stopped when it is dropped.
struct Explorer {
    process: Child,
    port: u16,
    token: String,
}

impl Explorer {
    fn start(arguments: &[&str]) -> Self {
        let mut command = Command::new(env!("CARGO_BIN_EXE_assur"));
        command.args(["explore", "--no-open"]).args(arguments).stdout(Stdio::piped());
        let mut process = command.spawn().expect("the program starts");
        let mut line = String::new();
        let out = process.stdout.take().expect("is piped");
        BufReader::new(out).read_line(&mut line).expect("prints its address");
        let rest = line.trim().strip_prefix("http://127.0.0.1:").expect("an address of this machine");
        let (port, token) = rest.split_once('/').expect("a token follows");
        Self { process, port: port.parse().expect("a port"), token: token.trim_end_matches('/').to_owned() }
    }

    fn connect(&self) -> TcpStream {
        let stream = TcpStream::connect(("127.0.0.1", self.port)).expect("the server listens");
        stream.set_read_timeout(Some(Duration::from_secs(20))).expect("a sound time");
        stream
    }

    /// The status of the answer to a request, and the answer.
    fn request(&self, method: &str, path: &str, headers: &str, body: &str) -> (u16, String) {
        let host = if headers.contains("Host:") { String::new() } else { format!("Host: 127.0.0.1:{}\r\n", self.port) };
        let mut stream = self.connect();
        let text = format!("{method} {path} HTTP/1.1\r\n{host}{headers}Connection: close\r\n\r\n{body}");
        stream.write_all(text.as_bytes()).expect("the server takes it");
        let mut answer = String::new();
        // A refused body may be cut off while it is still being sent.
        let _ = stream.read_to_string(&mut answer);
        let status = answer.split_whitespace().nth(1).and_then(|status| status.parse().ok()).unwrap_or(0);
        (status, answer)
    }

    fn inside(&self, name: &str) -> String {
        format!("/{}/{name}", self.token)
    }

    fn origin(&self) -> String {
        format!("http://127.0.0.1:{}", self.port)
    }

    /// The status of an upgrade, and the stream after it.
    fn upgrade(&self, path: &str, origin: Option<&str>) -> (u16, TcpStream) {
        let origin = origin.map(|origin| format!("Origin: {origin}\r\n")).unwrap_or_default();
        let mut stream = self.connect();
        let text = format!(
            "GET {path} HTTP/1.1\r\nHost: 127.0.0.1:{}\r\n{origin}Connection: Upgrade\r\nUpgrade: websocket\r\n\
             Sec-WebSocket-Version: 13\r\nSec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n\r\n",
            self.port
        );
        stream.write_all(text.as_bytes()).expect("the server takes it");
        let mut head = Vec::new();
        let mut byte = [0];
        while !head.ends_with(b"\r\n\r\n") && stream.read_exact(&mut byte).is_ok() {
            head.push(byte[0]);
        }
        let head = String::from_utf8_lossy(&head).into_owned();
        (head.split_whitespace().nth(1).and_then(|status| status.parse().ok()).unwrap_or(0), stream)
    }

    fn converse(&self) -> Conversation {
        let (status, stream) = self.upgrade(&self.inside("socket"), Some(&self.origin()));
        assert_eq!(status, 101);
        Conversation { stream, next: 1 }
    }
}

impl Drop for Explorer {
    fn drop(&mut self) {
        let _ = self.process.kill();
        let _ = self.process.wait();
    }
}

struct Conversation {
    stream: TcpStream,
    next: u64,
}

impl Conversation {
    /// One frame, masked with zeros, as a client may.
    fn send(&mut self, opcode: u8, payload: &[u8]) -> std::io::Result<()> {
        let mut frame = vec![0x80 | opcode];
        match payload.len() {
            short @ 0..126 => frame.push(0x80 | short as u8),
            middle @ 126..65536 => {
                frame.push(0x80 | 126);
                frame.extend_from_slice(&(middle as u16).to_be_bytes());
            }
            long => {
                frame.push(0x80 | 127);
                frame.extend_from_slice(&(long as u64).to_be_bytes());
            }
        }
        frame.extend_from_slice(&[0; 4]);
        frame.extend_from_slice(payload);
        self.stream.write_all(&frame)
    }

    /// The next frame that is no ping.
    fn receive(&mut self) -> std::io::Result<(u8, Vec<u8>)> {
        loop {
            let mut head = [0; 2];
            self.stream.read_exact(&mut head)?;
            let mut length = u64::from(head[1]);
            if length == 126 {
                let mut bytes = [0; 2];
                self.stream.read_exact(&mut bytes)?;
                length = u64::from(u16::from_be_bytes(bytes));
            } else if length == 127 {
                let mut bytes = [0; 8];
                self.stream.read_exact(&mut bytes)?;
                length = u64::from_be_bytes(bytes);
            }
            let mut payload = vec![0; usize::try_from(length).expect("fits in memory")];
            self.stream.read_exact(&mut payload)?;
            if head[0] & 0xf != 9 {
                return Ok((head[0] & 0xf, payload));
            }
        }
    }

    fn say(&mut self, text: &str) -> Value {
        self.send(1, text.as_bytes()).expect("the server takes it");
        let (opcode, payload) = self.receive().expect("an answer");
        assert_eq!(opcode, 1);
        serde_json::from_slice(&payload).expect("JSON")
    }

    fn ask(&mut self, kind: &str, mut question: Value) -> Value {
        let id = self.next;
        self.next += 1;
        question["id"] = json!(id);
        question["ask"] = json!(kind);
        let answer = self.say(&question.to_string());
        assert_eq!(answer["id"], json!(id));
        answer
    }

    /// The model and inputs that a page begins with.
    fn start(&mut self) -> (Value, Value) {
        let start = self.ask("start", json!({}))["answer"].clone();
        (start["model"].clone(), start["inputs"].clone())
    }
}

#[test]
fn requests_from_elsewhere_are_refused() {
    let explorer = Explorer::start(&[]);
    let page = explorer.inside("");
    let (status, answer) = explorer.request("GET", &page, "", "");
    assert_eq!(status, 200);
    assert!(answer.contains("content-security-policy: default-src 'none'"), "{answer}");
    for name in ["main.js", "stage.css", "icon.svg"] {
        assert_eq!(explorer.request("GET", &explorer.inside(name), "", "").0, 200, "{name}");
    }
    assert_eq!(explorer.request("GET", &explorer.inside("../Cargo.toml"), "", "").0, 404);
    let other = "0".repeat(32);
    for path in ["/", "/main.js", &format!("/{other}/"), &format!("/{}", explorer.token), "/socket"] {
        let (status, answer) = explorer.request("GET", path, "", "");
        assert_eq!(status, 403, "{path}");
        assert!(!answer.contains(&explorer.token), "the token is told to nobody");
    }
    // A name of somebody else's that leads to this machine.
    assert_eq!(explorer.request("GET", &page, "Host: example.com\r\n", "").0, 403);
    assert_eq!(explorer.request("POST", &page, "Content-Length: 0\r\n", "").0, 405);
    assert_eq!(explorer.request("GET", &page, "Content-Length: 4\r\n", "body").0, 413);
    assert_eq!(explorer.request("GET", &format!("{page}?{}", "x".repeat(2000)), "", "").0, 414);
    assert_eq!(explorer.request("GET", &page, &format!("X: {}\r\n", "x".repeat(2_000_000)), "").0 / 100, 4);
}

#[test]
fn conversations_from_elsewhere_are_refused() {
    let explorer = Explorer::start(&[]);
    let socket = explorer.inside("socket");
    for origin in
        [None, Some("http://example.com"), Some("null"), Some("https://127.0.0.1"), Some("http://127.0.0.1:1")]
    {
        assert_eq!(explorer.upgrade(&socket, origin).0, 403, "{origin:?}");
    }
    assert_eq!(explorer.upgrade("/socket", Some(&explorer.origin())).0, 403);
    assert_eq!(explorer.upgrade(&socket, Some(&explorer.origin())).0, 101);
    assert_eq!(explorer.request("GET", &socket, &format!("Origin: {}\r\n", explorer.origin()), "").0, 426);
}

#[test]
fn what_is_too_large_or_no_question_is_answered_with_a_reason() {
    let explorer = Explorer::start(&[]);
    let mut talk = explorer.converse();
    for text in ["", "{", "[]", "null", r#"{"id":1}"#, r#"{"id":1,"ask":"nothing"}"#, r#"{"id":-1,"ask":"start"}"#] {
        let answer = talk.say(text);
        assert!(answer["error"].as_str().is_some_and(|error| error.contains("cannot be read")), "{text}: {answer}");
    }
    let (model, inputs) = talk.start();
    let moved = |talk: &mut Conversation, model: &Value, inputs: &Value, pull: Value| {
        talk.ask("move", json!({ "model": model, "inputs": inputs, "mode": null, "pick": true, "pull": pull }))
    };
    assert_eq!(
        moved(&mut talk, &model, &inputs, Value::Null)["answer"]["report"]["modes"].as_array().map(Vec::len),
        Some(6)
    );
    // Wrong models and wrong questions about right ones: one line each, and the conversation goes on.
    let mut two_legs = model.clone();
    two_legs["leg"].as_array_mut().expect("a list").pop();
    let mut no_number = model.clone();
    no_number["leg"][0]["base"]["at"][0] = json!("left");
    let wrong = [
        (two_legs, inputs.clone(), Value::Null, "must be 3"),
        (no_number, inputs.clone(), Value::Null, "model.json: leg 1: base.at[0]"),
        (json!(5), inputs.clone(), Value::Null, "model.json"),
        (model.clone(), json!([1.0]), Value::Null, "1 given"),
        (model.clone(), inputs.clone(), json!({ "handle": "base", "leg": 7, "to": [0, 0] }), "leg 8"),
        (model.clone(), inputs.clone(), json!({ "handle": "pose", "to": [0, 0] }), "no assembly mode is held"),
        (model.clone(), inputs.clone(), json!({ "handle": "input", "number": 9, "value": 1 }), "actuator 10"),
        (model.clone(), inputs.clone(), json!({ "handle": "base", "leg": 0, "to": [1e308, 1e308] }), ""),
    ];
    for (model, inputs, pull, expected) in wrong {
        let answer = moved(&mut talk, &model, &inputs, pull.clone());
        let error = answer["error"].as_str().unwrap_or_default();
        assert!(expected.is_empty() || error.contains(expected), "{pull}: {answer}");
        assert!(!error.contains('\n'), "{error}");
    }
    let other = talk.ask("open", json!({ "text": "schema = \"assur/manipulator/1\"\nlegs = []", "file": "arm.toml" }));
    assert_eq!(other["error"], json!("arm.toml: legs: unknown key; did you mean \"leg\"?"));
    assert!(moved(&mut talk, &model, &inputs, Value::Null)["answer"].is_object());
    // Beyond the bound the conversation ends, with the reason, and only this one.
    let mut beside = explorer.converse();
    let _ = talk.send(1, &vec![b' '; 300_000]);
    let (opcode, payload) = talk.receive().expect("a reason");
    assert_eq!((opcode, u16::from_be_bytes([payload[0], payload[1]])), (8, 1009));
    let _ = beside.send(2, b"binary");
    assert_eq!(beside.receive().expect("a reason").0, 8);
    let mut third = explorer.converse();
    assert!(third.ask("start", json!({}))["answer"].is_object());
    // Broken off in the middle of a message, or without a word: the server stays.
    third.stream.write_all(&[0x81, 0xfe, 0x10]).expect("the server takes it");
    drop(third);
    assert!(explorer.converse().ask("start", json!({}))["answer"].is_object());
}

#[test]
fn a_stopped_explorer_is_taken_up_at_its_address() {
    let mut explorer = Explorer::start(&[]);
    let address = format!("http://127.0.0.1:{}/{}/#state", explorer.port, explorer.token);
    let _ = (explorer.process.kill(), explorer.process.wait());
    let again = Explorer::start(&[&address]);
    assert_eq!((again.port, &again.token), (explorer.port, &explorer.token));
    assert!(again.converse().ask("start", json!({}))["answer"].is_object());
}

/// 2000 small pulls that pass close by a meeting of two modes: the mode that is held never jumps, and in the end is the one that one proved path leads to.
#[test]
fn a_drag_near_a_singularity_never_jumps() {
    use assur::{Leg, Manipulator, PathSettings};
    let legs = [([0.0, 0.0], [0.0, 0.0]), ([15.91, 0.0], [17.045, 0.0]), ([0.0, 10.0], [13.2389, 16.0929])];
    let robot = Manipulator::new("", legs.map(|(a, b)| Leg::rpr(a, b)).to_vec()).expect("a sound model");
    let start = [14.98, 15.38, 12.0];
    let modes = robot.forward(&start).expect("a sound question").modes;
    // Along the third strut this mode ends; the drag turns round a thousandth before that, again and again.
    let pose = modes[2].mode.pose;
    let end = [(14.98, 15.38, 40.0), (14.98, 15.38, 1.0)].into_iter().find_map(|(a, b, c)| {
        let carried = robot.carry(&start, &pose, &robot, &[a, b, c]).expect("a sound question");
        carried.end.map(|(at, _)| start[2] + at * (c - start[2]))
    });
    let end = end.expect("a strut cannot lengthen for ever");
    let steps = 2000;
    let place = |step: usize| {
        let phase = 40.0 * std::f64::consts::TAU * step as f64 / f64::from(steps);
        let share = 0.5 - 0.5 * phase.cos();
        vec![start[0], start[1], start[2] + 0.999 * share * (end - start[2])]
    };
    let rows: Vec<Vec<f64>> = (0..=2000).map(place).collect();
    let whole = robot.follow(&rows, Some(pose), &PathSettings::default()).expect("a sound question");
    assert!(whole.complete);
    let mut now = pose;
    for (pair, proved) in rows.windows(2).zip(&whole.rows[1..]) {
        let carried = robot.carry(&pair[0], &now, &robot, &pair[1]).expect("a sound question");
        assert_eq!(carried.end, None);
        now = carried.pose;
        let off = (now.x - proved.pose.x).abs().max((now.y - proved.pose.y).abs());
        assert!(off < 1e-6, "{off:e} from the proved way in row {}", proved.step);
    }
}
