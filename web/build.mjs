// Builds the page into dist/, which is committed and embedded in the binary: users need no Node.js.
import { build } from "esbuild";
import { cp, rm } from "node:fs/promises";

const out = "dist";
await rm(out, { recursive: true, force: true });
await build({
  entryPoints: {
    app: "src/main.tsx",
    reference: "src/reference/main.tsx",
    events: "src/events/worker.ts",
  },
  outdir: `${out}/assets`,
  bundle: true,
  splitting: true,
  format: "esm",
  target: "es2022",
  jsx: "automatic",
  jsxImportSource: "preact",
  minify: true,
  legalComments: "linked",
  chunkNames: "[name]-[hash]",
  loader: { ".json": "json" },
});
await cp("src/icon.svg", `${out}/assets/icon.svg`);
await cp("src/index.html", `${out}/index.html`);
await cp("src/reference/index.html", `${out}/docs.html`);
