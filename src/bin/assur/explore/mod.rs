//! The explorer: a page in the browser, served by this program to this machine only.
//!
//! The page asks over one WebSocket and draws what it is told; each question carries the whole model, so that the server keeps nothing between two of
//! them: tabs do not disturb each other, and a page outlives a server that was stopped. [`start`] begins it, [`server`] decides who may ask, [`socket`] keeps one
//! conversation, [`question`] is what can be said, the others answer by one call of the library each.

mod address;
mod assets;
mod drawing;
mod handles;
mod linkages;
mod manipulator;
mod question;
mod server;
mod socket;
mod start;
mod workspace;

pub(crate) use start::run;
