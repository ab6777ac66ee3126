//! The page for people: a single-page application and the reference of the interface, built from
//! `web/` and embedded in the binary.

use super::static_text::StaticText;
use super::system;
use axum::extract::Request;
use axum::response::{IntoResponse, Response};
use rust_embed::RustEmbed;
use std::borrow::Cow;
use std::collections::BTreeMap;
use std::sync::LazyLock;

/// Path under which scripts and styles are.
const ASSETS: &str = "/assets/";

#[derive(RustEmbed)]
#[folder = "web/dist"]
struct Built;

/// The files by their paths in `web/dist`, read and compressed once, at the first request.
static FILES: LazyLock<BTreeMap<String, StaticText>> = LazyLock::new(|| {
    let read = |path: Cow<'static, str>| {
        let file = Built::get(&path)?;
        let text = StaticText::new(media_type(&path), file.data.into_owned());
        Some((path.into_owned(), text))
    };
    Built::iter().filter_map(read).collect()
});

fn media_type(path: &str) -> &'static str {
    match path.rsplit('.').next() {
        Some("html") => "text/html; charset=utf-8",
        Some("js") => "text/javascript",
        Some("css") => "text/css",
        Some("svg") => "image/svg+xml",
        _ => "text/plain; charset=utf-8",
    }
}

/// True for the paths of the page.
pub(super) fn is_page(path: &str) -> bool {
    matches!(path, "/" | "/docs") || path.starts_with(ASSETS)
}

/// The answer to a request for a path of the page.
pub(super) async fn page(request: Request) -> Response {
    let path = match request.uri().path() {
        "/" => "index.html",
        "/docs" => "docs.html",
        path => path.trim_start_matches('/'),
    };
    match FILES.get(path) {
        Some(text) => text.answer(request.headers()),
        None => system::no_such_route(request.uri().clone())
            .await
            .into_response(),
    }
}
