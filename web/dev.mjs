// Serves dist/ and passes everything else on to a running service: node dev.mjs SERVICE_URL [PORT].
// `npm run build` in between is enough to see a change.
import { readFile } from "node:fs/promises";
import { createServer, request } from "node:http";

const service = new URL(process.argv[2] ?? "http://127.0.0.1:8080");
const port = Number(process.argv[3] ?? 5173);
const types = { html: "text/html; charset=utf-8", js: "text/javascript", css: "text/css", svg: "image/svg+xml" };
const pages = { "/": "index.html", "/docs": "docs.html" };

/** Policy of the page, asked of the service, so that what works here works there. */
const policy = await new Promise((resolve, reject) => {
  request(service, (answer) => resolve(answer.headers["content-security-policy"]))
    .on("error", reject)
    .end();
});

const server = createServer(async (asked, answer) => {
  const path = new URL(asked.url, "http://here").pathname;
  const file = pages[path] ?? (path.startsWith("/assets/") && !path.includes("..") ? path.slice(1) : undefined);
  if (file) {
    const type = types[file.split(".").pop()] ?? "text/plain";
    const bytes = await readFile(`dist/${file}`).catch(() => undefined);
    answer.writeHead(bytes ? 200 : 404, { "Content-Type": type, "Content-Security-Policy": policy });
    answer.end(bytes);
    return;
  }
  const headers = { ...asked.headers, host: service.host };
  delete headers.origin;
  const passed = request(new URL(asked.url, service), { method: asked.method, headers }, (got) => {
    answer.writeHead(got.statusCode, got.headers);
    // A stream of events may have nothing to tell for a while.
    answer.flushHeaders();
    got.pipe(answer);
  });
  passed.on("error", () => answer.destroy());
  answer.on("close", () => passed.destroy());
  asked.pipe(passed);
});
server.listen(port, "127.0.0.1", () => console.log(`http://127.0.0.1:${server.address().port}`));
