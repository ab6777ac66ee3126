//! Accepts connections. `axum::serve` sets no time limit on the
//! head of a request: clients that send half of one would be kept for ever, and
//! would keep the service from stopping.

use super::access::PeerAddress;
use super::slow_client::SlowClientTimeout;
use crate::config::Limits;
use axum::Router;
use axum::body::Body;
use axum::http::Request;
use hyper::body::Incoming;
use hyper::server::conn::http1;
use hyper_util::rt::{TokioIo, TokioTimer};
use hyper_util::server::graceful::GracefulShutdown;
use hyper_util::service::TowerToHyperService;
use std::sync::Arc;
use std::time::Duration;
use tokio::net::{TcpListener, TcpStream};
use tokio::sync::{Semaphore, watch};
use tokio::task::JoinSet;
use tower::ServiceExt;

/// Pause after the system refused a connection (mostly for lack of file handles):
/// an immediate retry would only burn a core.
const ACCEPT_PAUSE: Duration = Duration::from_millis(100);

/// Serves until `stop` changes, then accepts no more connections, gives requests
/// in progress a limited time to finish, and closes the remaining connections.
pub async fn serve(
    listener: TcpListener,
    router: Router,
    limits: Limits,
    mut stop: watch::Receiver<bool>,
) {
    let graceful = GracefulShutdown::new();
    let mut connections = JoinSet::new();
    tokio::select! {
        () = accept(&listener, &router, &limits, &graceful, &mut connections) => {}
        // An error means that the other end is gone, which also means stop.
        _ = stop.changed() => {}
    }
    drop(listener);
    if tokio::time::timeout(limits.drain_timeout(), graceful.shutdown())
        .await
        .is_err()
    {
        tracing::warn!("requests in hand did not finish in time and were cut off");
    }
    connections.shutdown().await;
}

async fn accept(
    listener: &TcpListener,
    router: &Router,
    limits: &Limits,
    graceful: &GracefulShutdown,
    connections: &mut JoinSet<()>,
) {
    let places = Arc::new(Semaphore::new(limits.connections));
    while let Ok(place) = Arc::clone(&places).acquire_owned().await {
        match listener.accept().await {
            Ok((stream, peer)) => {
                let peer = PeerAddress(peer.ip());
                let connection = connection(stream, peer, router.clone(), limits, graceful);
                connections.spawn(async move {
                    connection.await;
                    drop(place);
                });
            }
            Err(error) => {
                tracing::warn!(%error, "a connection was not taken");
                tokio::time::sleep(ACCEPT_PAUSE).await;
            }
        }
        while connections.try_join_next().is_some() {}
    }
}

/// Serves one connection to its end.
fn connection(
    stream: TcpStream,
    peer: PeerAddress,
    router: Router,
    limits: &Limits,
    graceful: &GracefulShutdown,
) -> impl Future<Output = ()> + Send + use<> {
    let service = router.map_request(move |mut request: Request<Incoming>| {
        request.extensions_mut().insert(peer);
        request.map(Body::new)
    });
    let connection = http1::Builder::new()
        .timer(TokioTimer::new())
        .header_read_timeout(limits.header_read_timeout())
        .serve_connection(
            TokioIo::new(SlowClientTimeout::new(stream, limits.write_timeout())),
            TowerToHyperService::new(service),
        );
    let connection = graceful.watch(connection);
    async move {
        if let Err(error) = connection.await {
            tracing::debug!(%error, "a connection ended early");
        }
    }
}
