// Builds the page into dist/, which is committed and embedded in the binary: users need no Node.js.
import { build } from "esbuild";
import { appendFile, cp, readFile, rm } from "node:fs/promises";
import { basename } from "node:path";

const out = "dist";
await rm(out, { recursive: true, force: true });
const { metafile } = await build({
  metafile: true,
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
// Scripts of views are read when first shown; nothing would read the styles beside them.
const styles = new Set();
for (const file of Object.keys(metafile.outputs)) {
  if (!file.endsWith(".css") || ["app.css", "reference.css"].includes(basename(file))) continue;
  styles.add(await readFile(file, "utf8"));
  await rm(file);
}
await appendFile(`${out}/assets/app.css`, [...styles].join(""));
await cp("src/icon.svg", `${out}/assets/icon.svg`);
await cp("src/index.html", `${out}/index.html`);
await cp("src/reference/index.html", `${out}/docs.html`);
