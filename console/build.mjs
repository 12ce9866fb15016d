// Builds the page into the folder that is named, by default ../_build/console: node build.mjs [FOLDER].
import { build } from "esbuild";
import { cpSync, mkdirSync, readFileSync, readdirSync, rmSync, writeFileSync } from "node:fs";
import { dirname, join } from "node:path";
import { fileURLToPath } from "node:url";

const here = dirname(fileURLToPath(import.meta.url));
const out = process.argv[2] ?? join(here, "..", "_build", "console");

rmSync(out, { recursive: true, force: true });
mkdirSync(out, { recursive: true });
await build({
  entryPoints: [join(here, "src", "main.ts"), join(here, "src", "style.css")],
  bundle: true, minify: true, outdir: out, target: "es2022", format: "esm", legalComments: "none",
  loader: { ".png": "dataurl", ".svg": "dataurl" }, logLevel: "warning",
});
cpSync(join(here, "src", "index.html"), join(out, "index.html"));
cpSync(join(here, "src", "icon.svg"), join(out, "icon.svg"));

// The licences of what is in the page.
const lock = JSON.parse(readFileSync(join(here, "package-lock.json"), "utf8"));
const texts = [];
for (const [path, found] of Object.entries(lock.packages)) {
  if (path === "" || found.dev) continue;
  const folder = join(here, path);
  const licence = readdirSync(folder).find((name) => /^licen[cs]e/i.test(name));
  const text = licence ? readFileSync(join(folder, licence), "utf8").trim() : "";
  texts.push(`${path.replace(/^node_modules\//, "")} ${found.version} (${found.license})\n\n${text}\n`);
}
writeFileSync(join(out, "licences.txt"), texts.join("\n----\n\n"));
