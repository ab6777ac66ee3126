//! Slow clients: half a request head, a body in small pieces, an
//! answer that is not read.

use crate::client::ask;
use crate::served::Place;
use crate::{at_length, percentile};
use std::io::{self, Read, Write};
use std::net::TcpStream;
use std::time::{Duration, Instant};

/// Slow clients of each kind in turn.
const CLIENTS: usize = 50;

/// Upper bound for the time until all of them are disconnected [s].
const ALL_GONE_S: f64 = 12.0;

/// All of them are disconnected soon after their time limit, and other clients are
/// answered meanwhile.
#[test]
fn slow_clients_are_shown_out_and_others_are_answered() {
    let _turn = crate::turn();
    let limit_s = at_length(2, 10);
    let text = limit_s.to_string();
    let place = Place::new(&[
        ("SCREE_LIMITS__HEADER_READ_TIMEOUT_S", &text),
        ("SCREE_LIMITS__BODY_READ_TIMEOUT_S", &text),
        ("SCREE_LIMITS__WRITE_TIMEOUT_S", &text),
    ]);
    let served = place.serve();
    let address = served.address.as_str();
    let began = Instant::now();
    let mut health_s = Vec::new();
    let mut gone_s = std::thread::scope(|scope| {
        let clients: Vec<_> = (0..CLIENTS)
            .map(|client| scope.spawn(move || be_slow(address, client)))
            .collect();
        while !clients.iter().all(|client| client.is_finished()) {
            let asked = Instant::now();
            let answer = ask(address, "GET", "/healthz", "").expect("an answer");
            assert_eq!(answer.status, 200);
            health_s.push(asked.elapsed().as_secs_f64());
            std::thread::sleep(Duration::from_millis(5));
            assert!(began.elapsed().as_secs() < 60, "some client is still there");
        }
        let ended = clients
            .into_iter()
            .map(|client| client.join().expect("a client"));
        ended.collect::<Vec<f64>>()
    });
    let last = percentile(&mut gone_s, 1.0);
    let p99 = percentile(&mut health_s, 0.99);
    crate::tell(&format!(
        "{CLIENTS} slow clients, each given {limit_s} s: the last gone after {last:.2} s; \
         /healthz meanwhile p99 {:.1} ms of {} requests",
        p99 * 1e3,
        health_s.len()
    ));
    assert!(last < ALL_GONE_S, "{last} s");
}

/// Acts as a slow client; returns the time until it was disconnected [s].
fn be_slow(address: &str, client: usize) -> f64 {
    let began = Instant::now();
    let connect = || TcpStream::connect(address).expect("a connection");
    let ended = match client % 3 {
        0 => half_a_head(connect()),
        1 => a_body_in_drops(connect()),
        _ => read_nothing(connect_narrowly(address)),
    };
    // The kind of end does not matter.
    drop(ended);
    began.elapsed().as_secs_f64()
}

/// A connection with small buffers, so that it soon stalls.
fn connect_narrowly(address: &str) -> TcpStream {
    let runtime = tokio::runtime::Builder::new_current_thread()
        .enable_all()
        .build();
    let stream = runtime.expect("a runtime").block_on(async {
        let socket = tokio::net::TcpSocket::new_v4()?;
        socket.set_recv_buffer_size(4096)?;
        let address = address.parse().expect("an address");
        socket.connect(address).await?.into_std()
    });
    let stream = stream.expect("a connection");
    stream.set_nonblocking(false).expect("a socket");
    stream
}

fn half_a_head(mut stream: TcpStream) -> io::Result<()> {
    stream.write_all(b"GET /healthz HTTP/1.1\r\nHost: localhost\r\nX-Half")?;
    stream.read_to_end(&mut Vec::new()).map(drop)
}

fn a_body_in_drops(mut stream: TcpStream) -> io::Result<()> {
    stream.write_all(
        b"POST /v1/jobs HTTP/1.1\r\nHost: localhost\r\nContent-Type: application/json\r\n\
          Content-Length: 100000\r\n\r\n",
    )?;
    stream.set_read_timeout(Some(Duration::from_millis(100)))?;
    loop {
        stream.write_all(b" ")?;
        // The answer is 408, then the connection ends.
        match stream.read(&mut [0; 1024]) {
            Ok(0) => return Ok(()),
            Ok(_) => {}
            Err(error) if error.kind() == io::ErrorKind::WouldBlock => {}
            Err(error) => return Err(error),
        }
    }
}

/// Asks for far more than the buffers on both sides hold, and reads none of it.
fn read_nothing(mut stream: TcpStream) -> io::Result<()> {
    loop {
        stream.write_all(b"GET /openapi.json HTTP/1.1\r\nHost: localhost\r\n\r\n")?;
    }
}
