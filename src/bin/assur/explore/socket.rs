//! One conversation: questions come in, answers go out, and who falls silent is let go.
//!
//! Quick questions, those of a drag, are answered one after the other; slow ones (curves, maps, proofs) one at a time beside them, so that a
//! drag never waits for a map.

use std::collections::VecDeque;
use std::sync::Arc;
use std::time::{Duration, Instant};

use axum::extract::ws::{CloseFrame, Message, WebSocket};
use tokio::sync::mpsc::{self, UnboundedSender};
use tokio::time::{interval, timeout};

use super::question::{Envelope, answer, refuse};
use super::start::Start;

/// A ping this often shows whether the page is still there; browsers answer them by themselves.
const PING_EVERY: Duration = Duration::from_secs(20);
/// A page that has said nothing for so long is gone: three pings.
const SILENCE: Duration = Duration::from_secs(65);
/// How long a page may take to accept an answer.
const SENDING: Duration = Duration::from_secs(10);
/// Questions that may wait. The page asks one at a time of each kind.
const MOST_WAITING: usize = 16;
/// Close codes of RFC 6455 and its registry: a message that is too large, one of the wrong kind, and to be tried again later.
const TOO_LARGE: u16 = 1009;
const UNSUPPORTED: u16 = 1003;
const TRY_AGAIN: u16 = 1013;

/// The two lanes of questions.
#[derive(Default)]
struct Lane {
    busy: bool,
    waiting: VecDeque<Envelope>,
}

pub(crate) async fn converse(mut socket: WebSocket, start: Arc<Start>) {
    let (answered, mut answers) = mpsc::unbounded_channel::<(bool, String)>();
    let mut lanes = [Lane::default(), Lane::default()];
    let mut heard = Instant::now();
    let mut clock = interval(PING_EVERY);
    loop {
        let outgoing = tokio::select! {
            message = socket.recv() => {
                heard = Instant::now();
                match message {
                    Some(Ok(Message::Text(text))) => match Envelope::parse(&text) {
                        Ok(envelope) => {
                            let lane = &mut lanes[usize::from(envelope.is_slow())];
                            if lane.waiting.len() < MOST_WAITING {
                                lane.waiting.push_back(envelope);
                                advance(lane, &start, &answered);
                                None
                            } else {
                                Some(Message::text(refuse(Some(envelope.id), "too many questions at once")))
                            }
                        }
                        Err((id, reason)) => Some(Message::text(refuse(id, &reason))),
                    },
                    Some(Ok(Message::Binary(_))) => Some(closing(UNSUPPORTED, "messages are text")),
                    Some(Ok(Message::Ping(_) | Message::Pong(_))) => None,
                    Some(Ok(Message::Close(_))) | None => return,
                    // A message beyond the limit, or no WebSocket traffic at all.
                    Some(Err(_)) => Some(closing(TOO_LARGE, "the message is too large")),
                }
            }
            Some((slow, text)) = answers.recv() => {
                let lane = &mut lanes[usize::from(slow)];
                lane.busy = false;
                advance(lane, &start, &answered);
                Some(Message::text(text))
            }
            _ = clock.tick() => {
                if heard.elapsed() > SILENCE {
                    return;
                }
                Some(Message::Ping(Default::default()))
            }
        };
        let Some(outgoing) = outgoing else { continue };
        let last = matches!(outgoing, Message::Close(_));
        if !matches!(timeout(SENDING, socket.send(outgoing)).await, Ok(Ok(()))) || last {
            return;
        }
    }
}

/// Ends a conversation for which there is no place.
pub(crate) async fn turn_away(mut socket: WebSocket) {
    let _ = timeout(SENDING, socket.send(closing(TRY_AGAIN, "too many pages are open; close some"))).await;
}

fn closing(code: u16, reason: &'static str) -> Message {
    Message::Close(Some(CloseFrame { code, reason: reason.into() }))
}

/// Takes the next question of a lane to a thread of its own.
fn advance(lane: &mut Lane, start: &Arc<Start>, answered: &UnboundedSender<(bool, String)>) {
    if lane.busy {
        return;
    }
    let Some(envelope) = lane.waiting.pop_front() else { return };
    lane.busy = true;
    let (start, answered) = (Arc::clone(start), answered.clone());
    tokio::spawn(async move {
        let (id, slow) = (envelope.id, envelope.is_slow());
        let text = tokio::task::spawn_blocking(move || answer(envelope, &start)).await;
        // A broken invariant of the library must not end the conversation.
        let text =
            text.unwrap_or_else(|_| refuse(Some(id), "the program met an error of its own; please report the model"));
        // With the page gone nobody waits for it.
        let _ = answered.send((slow, text));
    });
}
