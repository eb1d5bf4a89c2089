//! Clients that send requests and read no reply: the learner keeps serving all others and keeps training.
//!
//! A relay between such a client and the learner stops reading the learner's side. It sends keep-alives of its own, so that
//! the learner does not close the link.

use std::{
    io::{Read, Write},
    net::{TcpListener, TcpStream},
    os::fd::AsRawFd,
    sync::{
        Arc, Mutex,
        atomic::{AtomicBool, AtomicUsize, Ordering},
    },
    time::Duration,
};

use treadmill_proto::{Outcome, PolicyPiece, PolicyRequest};
use zenoh::Wait;

use crate::{
    attacks::{Attacker, TIMEOUT},
    floods::{Fleet, fleet},
    support::*,
};

/// Clients that read nothing.
const CLIENTS: usize = 50;
/// Requests of each kind and client. Their replies fill the buffers of a link many times.
const REQUESTS: usize = 100;
/// Unread bytes that show that links stalled: more than the system buffers for all of them.
const UNREAD_BYTES_MIN: usize = CLIENTS * (64 << 10);
/// First byte of a message that ends a link, without its flags.
const CLOSE: u8 = 0x03;
/// Length and content of a keep-alive.
const KEEP_ALIVE: [u8; 3] = [1, 0, 0x04];

/// Link between one client and the learner.
struct Relay {
    endpoint: String,
    is_stalled: Arc<AtomicBool>,
    /// Connection to the learner.
    learner: Arc<Mutex<Option<TcpStream>>>,
}

impl Relay {
    fn start(learner_at: &str) -> Self {
        let listener = TcpListener::bind("127.0.0.1:0").unwrap();
        let endpoint = format!("tcp/{}", listener.local_addr().unwrap());
        let relay = Self { endpoint, is_stalled: Arc::default(), learner: Arc::default() };
        let (address, is_stalled, kept) = (learner_at.to_string(), relay.is_stalled.clone(), relay.learner.clone());
        std::thread::spawn(move || {
            let client = listener.accept().unwrap().0;
            let learner = TcpStream::connect(address).unwrap();
            receive_little(&learner);
            *kept.lock().unwrap() = Some(learner.try_clone().unwrap());
            let (to_client, from_learner) = (client.try_clone().unwrap(), learner.try_clone().unwrap());
            std::thread::spawn(move || pass_replies(from_learner, to_client, &is_stalled));
            pass_requests(client, learner);
        });
        relay
    }

    /// Adds the bytes that the learner sent and the client did not read, until there are enough from all clients. Small
    /// buffers make it slow to read all.
    fn count_unread_bytes(&self, count: &AtomicUsize) {
        let mut learner = self.learner.lock().unwrap().take().expect("a connection");
        learner.set_read_timeout(Some(Duration::from_secs(1))).unwrap();
        let mut buffer = vec![0; 4096];
        while count.load(Ordering::Relaxed) < UNREAD_BYTES_MIN
            && let Ok(length @ 1..) = learner.read(&mut buffer)
        {
            count.fetch_add(length, Ordering::Relaxed);
        }
    }
}

/// Makes the system buffer only a few replies.
fn receive_little(stream: &TcpStream) {
    let bytes: libc::c_int = 8192;
    let size = size_of_val(&bytes) as libc::socklen_t;
    // SAFETY: the option is a number, which lives until the call returns.
    let set = unsafe {
        libc::setsockopt(stream.as_raw_fd(), libc::SOL_SOCKET, libc::SO_RCVBUF, (&raw const bytes).cast(), size)
    };
    assert_eq!(set, 0);
}

/// Passes replies on until the link stalls.
fn pass_replies(mut learner: TcpStream, mut client: TcpStream, is_stalled: &AtomicBool) {
    learner.set_read_timeout(Some(Duration::from_millis(10))).unwrap();
    let mut buffer = [0; 4096];
    while !is_stalled.load(Ordering::Relaxed) {
        match learner.read(&mut buffer) {
            Ok(0) => return,
            Ok(length) => drop(client.write_all(&buffer[..length])),
            // Nothing came in time.
            Err(_) => {}
        }
    }
}

/// Passes requests on until the client gives up, then keeps the link alive.
fn pass_requests(mut client: TcpStream, mut learner: TcpStream) {
    let mut length = [0; 2];
    while client.read_exact(&mut length).is_ok() {
        let mut message = vec![0; u16::from_le_bytes(length).into()];
        if client.read_exact(&mut message).is_err() || message.first().is_some_and(|first| first & 0x1f == CLOSE) {
            break;
        }
        if learner.write_all(&length).and_then(|()| learner.write_all(&message)).is_err() {
            return;
        }
    }
    while learner.write_all(&KEEP_ALIVE).is_ok() {
        std::thread::sleep(Duration::from_secs(1));
    }
}

/// Sends requests of every kind without waiting for replies.
fn send_requests(client: &Attacker) {
    let ask = |key: &str, payload: Vec<u8>| {
        let asked = client.session().get(format!("treadmill/run/{key}")).payload(payload).timeout(TIMEOUT);
        asked.callback(|_| ()).wait().unwrap();
    };
    for number in 0..REQUESTS {
        ask("policy/latest", Vec::new());
        ask("policy/pieces", PolicyRequest::default().encode());
        ask("evaluations/stalled", Vec::new());
        ask("status", Vec::new());
        // The receipt names the actor.
        ask(&format!("rollouts/stalled-{number}"), vec![0; 8]);
    }
}

/// Asserts that a client that reads gets policies and receipts.
fn assert_served(fleet: &Fleet) {
    let client = fleet.attacker();
    for number in 0..20 {
        client.policy();
        // An unproven sender may have to try again.
        await_that("a receipt", || {
            let receipt = client.send(&format!("served-{number}"), vec![0; 8])?;
            (receipt.outcome == Outcome::Malformed).then_some(())
        });
        let pieces = client.ask("treadmill/run/policy/pieces", PolicyRequest::default().encode(), TIMEOUT);
        let piece = PolicyPiece::decode(pieces.into_iter().next().expect("a piece")).unwrap();
        assert!(piece.offset == 0 && !piece.data.is_empty());
    }
}

#[test]
fn clients_that_read_no_replies_do_not_hold_up_others() {
    let fleet = fleet(false, &["eval.every_steps=4096"]);
    let learner_at = fleet.endpoint.split_once('/').unwrap().1;
    let relays: Vec<Relay> = (0..CLIENTS).map(|_| Relay::start(learner_at)).collect();
    let clients: Vec<Attacker> =
        relays.iter().map(|relay| Attacker::join(&relay.endpoint, "run", None, TIMEOUT).expect("a session")).collect();
    for relay in &relays {
        relay.is_stalled.store(true, Ordering::Relaxed);
    }
    clients.iter().for_each(send_requests);
    assert_served(&fleet);
    fleet.assert_trains();
    let unread = AtomicUsize::new(0);
    std::thread::scope(|scope| {
        for relay in &relays {
            scope.spawn(|| relay.count_unread_bytes(&unread));
        }
    });
    let unread = unread.into_inner();
    assert!(unread >= UNREAD_BYTES_MIN, "{unread} bytes of replies waited");
    drop(clients);
    fleet.end();
}
