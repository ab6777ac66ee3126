//! Accepts connections. `axum::serve` sets no time limit on the
//! head of a request: clients that send half of one would be kept for ever, and
//! would keep the service from stopping.

use super::arriving_body::ArrivingBody;
use super::connections::{Connections, OpenConnection, Place};
use super::operator;
use super::slow_client::SlowClientTimeout;
use super::tracked_body::TrackedBody;
use crate::config::Limits;
use axum::Router;
use axum::body::Body;
use axum::http::{HeaderValue, Request, Response, header};
use hyper::body::Incoming;
use hyper::server::conn::http1;
use hyper::service::service_fn;
use hyper_util::rt::{TokioIo, TokioTimer};
use hyper_util::server::graceful::GracefulShutdown;
use std::convert::Infallible;
use std::io;
use std::pin::pin;
use std::sync::Arc;
use std::time::Duration;
use tokio::net::{TcpListener, TcpStream};
use tokio::sync::watch;
use tokio::task::JoinSet;
use tokio::time::timeout;
use tower::ServiceExt;

/// Pause after the system refused a connection (mostly for lack of file handles):
/// an immediate retry would only burn a core.
const ACCEPT_PAUSE: Duration = Duration::from_millis(100);

/// Time for which a connection that made room is still served: its request may have arrived
/// already, and would otherwise be answered with a reset.
const LAST_REQUEST: Duration = Duration::from_millis(200);

/// Refusals in a row after which the listener counts as dead: a minute of them.
const MOST_REFUSALS: u32 = 600;

/// Serves until `stop` changes, then accepts no more connections, gives requests
/// in progress a limited time to finish, and closes the remaining connections.
///
/// # Errors
/// The listener accepts no connections any more.
pub async fn serve(
    listener: TcpListener,
    router: Router,
    limits: Limits,
    mut stop: watch::Receiver<bool>,
) -> io::Result<()> {
    let graceful = GracefulShutdown::new();
    let mut tasks = JoinSet::new();
    let ended = tokio::select! {
        error = accept(&listener, &router, &limits, &graceful, &mut tasks) => Err(error),
        // An error means that the other end is gone, which also means stop.
        _ = stop.changed() => Ok(()),
    };
    drop(listener);
    if timeout(limits.drain_timeout(), graceful.shutdown())
        .await
        .is_err()
    {
        tracing::warn!("requests in hand did not finish in time and were cut off");
    }
    tasks.shutdown().await;
    ended
}

/// Accepts connections until the listener is dead; returns its error.
async fn accept(
    listener: &TcpListener,
    router: &Router,
    limits: &Limits,
    graceful: &GracefulShutdown,
    tasks: &mut JoinSet<()>,
) -> io::Error {
    let connections = Connections::new(limits.clone());
    let mut refusals = 0;
    loop {
        match listener.accept().await {
            Ok((stream, peer)) => {
                refusals = 0;
                match connections.open(peer.ip().to_canonical()) {
                    Some(open) => {
                        tasks.spawn(connection(stream, open, router.clone(), limits, graceful));
                    }
                    // Without a place there is no time for a request either.
                    None => drop(stream),
                }
            }
            Err(error) => {
                tracing::warn!(%error, "a connection was not taken");
                refusals += 1;
                if refusals >= MOST_REFUSALS {
                    return error;
                }
                tokio::time::sleep(ACCEPT_PAUSE).await;
            }
        }
        while tasks.try_join_next().is_some() {}
    }
}

/// Serves one connection to its end.
fn connection(
    stream: TcpStream,
    open: OpenConnection,
    router: Router,
    limits: &Limits,
    graceful: &GracefulShutdown,
) -> impl Future<Output = ()> + Send + use<> {
    let open = Arc::new(open);
    let written = Arc::clone(&open);
    let stream = SlowClientTimeout::new(stream, limits.write_timeout(), move |waits| {
        written.stall(waits);
    });
    let served = Arc::clone(&open);
    let service = service_fn(move |request| answer(router.clone(), Arc::clone(&served), request));
    let connection = http1::Builder::new()
        .timer(TokioTimer::new())
        .header_read_timeout(limits.header_read_timeout())
        .serve_connection(TokioIo::new(stream), service);
    let connection = graceful.watch(connection);
    async move {
        let mut connection = pin!(connection);
        let ended = tokio::select! {
            ended = &mut connection => ended,
            () = open.closed() => {
                tracing::debug!("an idle connection made room for another");
                let last = timeout(LAST_REQUEST, connection).await;
                last.unwrap_or(Ok(()))
            }
        };
        if let Err(error) = ended {
            tracing::debug!(%error, "a connection ended early");
        }
    }
}

/// Answers one request; the connection is busy until its answer is written.
async fn answer(
    router: Router,
    open: Arc<OpenConnection>,
    request: Request<Incoming>,
) -> Result<Response<TrackedBody>, Infallible> {
    let busy = open.begin_request();
    let arriving = |body| Body::new(ArrivingBody::new(body, Arc::clone(&open)));
    let mut request = request.map(arriving);
    request.extensions_mut().insert(open.peer());
    let mut response = match operator::refusal(open.place(), &request) {
        Some(refused) => refused,
        None => router.oneshot(request).await?,
    };
    if open.place() == Place::Operator {
        // One short answer fits the system's buffer; many that nobody reads would keep the place.
        let close = HeaderValue::from_static("close");
        response.headers_mut().insert(header::CONNECTION, close);
    }
    Ok(response.map(|body| TrackedBody::new(body, busy)))
}
