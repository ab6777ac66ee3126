//! The page for people: a single-page application and the reference of the interface, built from
//! `web/` and embedded in the binary.

use super::static_text::StaticText;
use super::system;
use axum::extract::Request;
use axum::http::{HeaderValue, header};
use axum::response::{IntoResponse, Response};
use rust_embed::RustEmbed;
use std::borrow::Cow;
use std::collections::BTreeMap;
use std::sync::LazyLock;

/// Path under which scripts and styles are.
const ASSETS: &str = "/assets/";

/// Digits of the hash in the name of a script.
const HASH_LENGTH: usize = 8;

/// Cache control of files that have another name whenever they change.
const FOREVER: HeaderValue = HeaderValue::from_static("public, max-age=31536000, immutable");

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

/// True for a file whose name has the hash of its content: `name-2TUWXB33.js`.
fn has_hash(path: &str) -> bool {
    let stem = path.strip_suffix(".js").unwrap_or_default();
    let hash = stem.rsplit_once('-').map_or("", |(_, hash)| hash);
    let is_digit = |digit: u8| digit.is_ascii_uppercase() || digit.is_ascii_digit();
    hash.len() == HASH_LENGTH && hash.bytes().all(is_digit)
}

fn media_type(path: &str) -> &'static str {
    match path.rsplit('.').next() {
        Some("html") => "text/html; charset=utf-8",
        Some("js") => "text/javascript",
        Some("css") => "text/css",
        Some("svg") => "image/svg+xml",
        _ => "text/plain; charset=utf-8",
    }
}

/// Compresses the files before the first request asks for one.
pub(super) fn prepare() {
    LazyLock::force(&FILES);
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
        Some(text) if has_hash(path) => (
            [(header::CACHE_CONTROL, FOREVER)],
            text.answer(request.headers()),
        )
            .into_response(),
        Some(text) => text.answer(request.headers()),
        None => system::no_such_route(request.uri().clone())
            .await
            .into_response(),
    }
}
