//! Links between routers that break together.

use std::{
    io,
    net::{Shutdown, TcpListener, TcpStream},
    sync::{Arc, Mutex},
    thread,
    time::Duration,
};

use treadmill_bus::{Bus, observer::statuses};
use treadmill_proto::RunStatus;

use crate::support::*;

const ROUTERS: usize = 5;
const BREAKS: usize = 3;

/// Forwards connections to an address until they are broken.
struct Relay {
    address: String,
    open: Arc<Mutex<Vec<TcpStream>>>,
}

impl Relay {
    fn start(to: String) -> Self {
        let listener = TcpListener::bind("127.0.0.1:0").unwrap();
        let address = listener.local_addr().unwrap().to_string();
        let open: Arc<Mutex<Vec<TcpStream>>> = Arc::default();
        let known = open.clone();
        thread::spawn(move || {
            for near in listener.incoming().map_while(Result::ok) {
                let Ok(far) = TcpStream::connect(&to) else { continue };
                for (from, to) in [(&near, &far), (&far, &near)] {
                    let (mut from, mut to) = (from.try_clone().unwrap(), to.try_clone().unwrap());
                    thread::spawn(move || {
                        let _ = io::copy(&mut from, &mut to);
                        let _ = to.shutdown(Shutdown::Both);
                    });
                }
                known.lock().unwrap().extend([near, far]);
            }
        });
        Self { address, open }
    }

    fn break_all(&self) {
        self.open.lock().unwrap().drain(..).for_each(|stream| drop(stream.shutdown(Shutdown::Both)));
    }
}

#[tokio::test(flavor = "multi_thread")]
async fn routers_whose_links_break_together_find_the_learner_again() {
    let (learner, endpoints) = open_router(&[]);
    let server = StatusServer::start(&learner, RunStatus { run: "run".to_string(), ..RunStatus::default() });
    let relay = Relay::start(endpoints[0].split_once('/').unwrap().1.to_string());
    let routers: Vec<Bus> = (0..ROUTERS).map(|_| open_router(&[format!("tcp/{}", relay.address)]).0).collect();
    for round in 0..=BREAKS {
        if round > 0 {
            relay.break_all();
            // Both ends of each link. On a busy machine a link may have broken before, too.
            await_that("all links anew", || (relay.open.lock().unwrap().len() >= 2 * ROUTERS).then_some(()));
        }
        for router in &routers {
            let mut answers = Vec::new();
            for _ in 0..60 {
                answers = statuses(router, Some("run"), Duration::from_secs(5)).await.unwrap();
                if !answers.is_empty() {
                    break;
                }
                tokio::time::sleep(Duration::from_millis(500)).await;
            }
            assert_eq!(answers.len(), 1, "a router has lost the learner after break {round}");
        }
    }
    drop(server);
    routers.iter().chain([&learner]).for_each(Bus::close);
}
