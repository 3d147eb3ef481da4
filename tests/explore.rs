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
    /// What follows the token in the address.
    view: String,
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
        let (token, view) = token.split_once('/').expect("a path follows");
        let (port, token, view) = (port.parse().expect("a port"), token.to_owned(), view.to_owned());
        Self { process, port, token, view }
    }

    /// Why one does not start.
    fn refused(arguments: &[&str]) -> String {
        let mut command = Command::new(env!("CARGO_BIN_EXE_assur"));
        command.args(["explore", "--no-open"]).args(arguments).stdout(Stdio::piped()).stderr(Stdio::piped());
        let mut process = command.spawn().expect("the program starts");
        // One that starts all the same would wait for questions.
        let mut line = String::new();
        let out = process.stdout.take().expect("is piped");
        BufReader::new(out).read_line(&mut line).expect("ends or prints its address");
        let _ = process.kill();
        assert_eq!(line, "", "{arguments:?} starts");
        let output = process.wait_with_output().expect("ends");
        String::from_utf8(output.stderr).expect("text").trim().to_owned()
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
    let numbered =
        [r#"{"id":7}"#, r#"{"id":7,"ask":"nothing"}"#, r#"{"id":7,"ask":"move","workspace":{"kind":"none"}}"#];
    for text in ["", "{", "[]", "null", r#"{"id":-1,"ask":"start"}"#].iter().chain(&numbered) {
        let answer = talk.say(text);
        assert!(answer["error"].as_str().is_some_and(|error| error.contains("cannot be read")), "{text}: {answer}");
        // Whoever asked learns which question it was, if that can be read.
        assert_eq!(answer["id"], if numbered.contains(text) { json!(7) } else { Value::Null }, "{text}");
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
fn a_page_too_many_learns_why() {
    let explorer = Explorer::start(&[]);
    let mut open: Vec<Conversation> = (0..32).map(|_| explorer.converse()).collect();
    let (opcode, payload) = explorer.converse().receive().expect("a reason");
    assert_eq!((opcode, u16::from_be_bytes([payload[0], payload[1]])), (8, 1013));
    assert!(String::from_utf8_lossy(&payload[2..]).contains("too many pages"));
    assert!(open[31].ask("start", json!({}))["answer"].is_object());
}

#[test]
fn a_stopped_explorer_is_taken_up_at_its_address_and_shows_the_view_of_a_link() {
    let mut explorer = Explorer::start(&[]);
    let _ = (explorer.process.kill(), explorer.process.wait());
    for (host, view, kept) in [("127.0.0.1", "#abc-_9", "#abc-_9"), ("localhost", "", ""), ("127.0.0.1", "#a&b", "")] {
        let again = Explorer::start(&[&format!("http://{host}:{}/{}/{view}", explorer.port, explorer.token)]);
        assert_eq!((again.port, &again.token), (explorer.port, &explorer.token));
        assert_eq!(again.view, kept);
        assert!(again.converse().ask("start", json!({}))["answer"].is_object());
    }
}

#[test]
fn inputs_are_in_the_unit_of_the_model_and_judged_before_the_start() {
    let cranks = Explorer::start(&["examples/3-rrr.toml", "--inputs=60,-30,10"]).converse().start().1;
    let in_degrees: Vec<f64> =
        cranks.as_array().expect("a list").iter().map(|q| q.as_f64().expect("a number").to_degrees()).collect();
    assert!(in_degrees.iter().zip([60.0, -30.0, 10.0]).all(|(q, given)| (q - given).abs() < 1e-12), "{in_degrees:?}");
    assert_eq!(Explorer::start(&["--inputs=10,11,12"]).converse().start().1, json!([10.0, 11.0, 12.0]));
    assert!(Explorer::refused(&["--inputs=1,2"]).ends_with("--inputs: inputs: 2 given, 3 actuated joints"));
    let beyond = Explorer::refused(&["examples/workspaces/five-kinds.toml", "--inputs=1e9,1,1"]);
    assert!(beyond.contains("five-kinds.toml: leg 1: input 1000000000 of joint 2 is outside limits"), "{beyond}");
    assert!(Explorer::refused(&["examples/coupler.json", "--inputs=1"]).contains("no actuators"));
    let address = format!("http://127.0.0.1:1/{}/", "0".repeat(32));
    assert!(Explorer::refused(&[&address, "--inputs=1,2,3"]).contains("--inputs goes with a model"));
}

/// A model of which no place on its sliders can be put together begins where its limits allow.
#[test]
fn a_model_without_modes_begins_within_its_limits() {
    let explorer = Explorer::start(&[]);
    let mut talk = explorer.converse();
    let leg = |base: &str, platform: &str| {
        format!("[[leg]]\njoints = \"R_P_R\"\nbase.at = {base}\nplatform.at = {platform}\nlimits = [0.1, 0.2]\n")
    };
    let legs = leg("[0, 0]", "[0, 0]") + &leg("[10, 0]", "[1, 0]") + &leg("[0, 10]", "[0, 1]");
    let text = format!("schema = \"assur/manipulator/1\"\n{legs}");
    let opened = talk.ask("open", json!({ "text": text, "file": "short.toml" }))["answer"].clone();
    assert_eq!(opened["inputs"], json!([0.1, 0.1, 0.1]), "{opened}");
    let question = json!({ "model": opened["model"], "inputs": opened["inputs"], "mode": null, "pick": true });
    let answer = talk.ask("move", question);
    assert_eq!(answer["answer"]["report"]["modes"], json!([]), "{answer}");
}

#[test]
fn linkages_are_read_by_what_they_call_themselves_and_keep_what_is_not_pulled() {
    let explorer = Explorer::start(&[]);
    let mut talk = explorer.converse();
    let bars = "a = [0, 0]\nb = [4, 0]\np = [-1, -1.4]\nq = [2, -1.4]\nr = 1.2";
    let head = "schema = \"assur/coupler/1\"\nname = \"mine\"\n";
    let file = format!("{head}[fourbar]\n{bars}\ns = 3\n[with.circle]\ncenter = [0, 0]\nradius = 1\n");
    let opened = talk.ask("open", json!({ "text": file, "file": "mine.toml" }))["answer"].clone();
    assert_eq!(opened["kind"], json!("four_bar"), "{opened}");
    let place = json!({ "circuit": 9, "tau": 0.5 });
    let pull = json!({ "handle": "pivot", "side": 1, "to": [4.1, 0.2] });
    let moved = talk.ask("four_bar", json!({ "file": opened["file"], "place": place, "pull": pull }))["answer"].clone();
    assert_eq!(moved["file"]["fourbar"]["b"], json!([4.1, 0.2]), "{moved}");
    assert_eq!((&moved["file"]["name"], &moved["file"]["with"]), (&opened["file"]["name"], &opened["file"]["with"]));
    // Mistakes are those of the file at hand.
    let wrong = talk.ask("open", json!({ "text": format!("{head}[fourbar]\n{bars}"), "file": "mine.toml" }));
    assert!(wrong["error"].as_str().is_some_and(|error| error.contains("mine.toml: fourbar.s: missing")), "{wrong}");
    let wrong = talk.ask("open", json!({ "text": "schema = \"assur/group/1\"\nlinks = 2.5", "file": "g.toml" }));
    assert_eq!(wrong["error"], json!("g.toml: links: 2.5 must be a whole number from 0"));
    // What cannot be put together cannot be pulled, and says so.
    let apart = json!({ "schema": "assur/coupler/1", "fourbar": { "a": [0, 0], "b": [40, 0], "p": [0, 0], "q": [1, 0], "r": 1, "s": 1 } });
    let seen = talk.ask("four_bar", json!({ "file": apart }));
    assert_eq!(seen["answer"]["circuits"], json!([]), "{seen}");
    let pulled = talk.ask("four_bar", json!({ "file": apart, "pull": pull }));
    assert!(pulled["error"].as_str().is_some_and(|error| error.contains("cannot be put together")), "{pulled}");
    let text = std::fs::read_to_string("examples/seven-link.json").expect("an example");
    let opened = talk.ask("open", json!({ "text": text, "file": "seven.json" }))["answer"].clone();
    let drawn = talk.ask("truss", json!({ "file": opened["file"] }))["answer"].clone();
    assert_eq!(drawn["file"]["name"], json!("Baranov truss 7#0"), "{opened}");
}

/// Angles come back where a slider shows them, and what is pulled then starts from there.
#[test]
fn angles_are_given_within_their_range() {
    let explorer = Explorer::start(&[]);
    let mut talk = explorer.converse();
    let new = talk.ask("new", json!({ "family": "3-RRP" }))["answer"].clone();
    let question = json!({ "model": new["model"], "inputs": new["inputs"], "mode": null, "pick": true });
    let moved = talk.ask("move", question)["answer"].clone();
    let turns =
        |k: usize| (new["inputs"][k].as_f64().expect("a number"), moved["inputs"][k].as_f64().expect("a number"));
    let (before, after) = turns(1);
    assert!(
        before > std::f64::consts::PI && (before - after - std::f64::consts::TAU).abs() < 1e-12,
        "{before}, {after}"
    );
    assert_eq!(turns(0).0, turns(0).1);
}

/// A workspace that takes too long for a step of a drag is asked for by itself, and is the same.
#[test]
fn a_workspace_by_itself_is_that_of_a_pull() {
    let explorer = Explorer::start(&["examples/workspaces/five-kinds.toml"]);
    let mut talk = explorer.converse();
    let (model, inputs) = talk.start();
    for workspace in [json!({ "kind": "maximal" }), json!({ "kind": "constant" })] {
        let mut ask = json!({ "model": model, "inputs": inputs, "mode": null, "pick": true, "workspace": workspace });
        let moved = talk.ask("move", ask.clone())["answer"].clone();
        let mode = &moved["report"]["modes"][moved["current"].as_u64().expect("a mode is held") as usize];
        ask["pose"] = mode["pose"].clone();
        let alone = talk.ask("workspace", ask)["answer"].clone();
        assert!(alone["area"].as_f64().is_some_and(|area| area > 1.0), "{alone}");
        for name in ["kind", "area", "loops", "isolated", "unclosed"] {
            assert_eq!(alone[name], moved["workspace"][name], "{workspace}: {name}");
        }
    }
}

#[test]
fn middle_sliders_are_pulled() {
    let explorer = Explorer::start(&[]);
    let mut talk = explorer.converse();
    for (family, link) in [("3-PPR", 0), ("3-RPP", 1)] {
        let new = talk.ask("new", json!({ "family": family }))["answer"].clone();
        let ask = json!({ "model": new["model"], "inputs": new["inputs"], "mode": null, "pick": true });
        let seen = talk.ask("move", ask.clone())["answer"].clone();
        let mode = &seen["report"]["modes"][seen["current"].as_u64().expect("a mode is held") as usize];
        let axes =
            seen["handles"].as_array().expect("a list").iter().filter(|grip| grip["handle"] == json!("middle_axis"));
        let axis = axes.clone().next().expect("a middle slider has a handle");
        assert_eq!(axes.count(), 3, "{family}");
        let [from, at] = ["from", "at"].map(|name| [0, 1].map(|k| axis[name][k].as_f64().expect("a number")));
        let (way, turn) = ([at[0] - from[0], at[1] - from[1]], 0.1_f64);
        let to =
            [from[0] + turn.cos() * way[0] - turn.sin() * way[1], from[1] + turn.sin() * way[0] + turn.cos() * way[1]];
        let mut ask = ask;
        ask["mode"] = json!({ "pose": mode["pose"], "signs": mode["signs"] });
        ask["pull"] = json!({ "handle": "middle_axis", "leg": 0, "from": from, "to": to });
        let moved = talk.ask("move", ask)["answer"].clone();
        assert!(moved["current"].is_u64(), "{family}: {}", moved["event"]);
        let [before, after] = [&new, &moved].map(|answer| assur_leg(&answer["model"]));
        let angle = |leg: &assur::Leg| leg.links[link].direction.y.atan2(leg.links[link].direction.x);
        let turned = (angle(&after) - angle(&before)).sin();
        assert!((turned.abs() - turn.sin()).abs() < 1e-9, "{family}: {turned}");
    }
}

/// The first leg of a model in a message.
fn assur_leg(model: &Value) -> assur::Leg {
    let model = assur::exchange::ModelFile::parse(&model.to_string(), "model.json").expect("a sound model");
    model.manipulator.legs[0].clone()
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
