// An hour of a run with 100 vehicles and 20 pages: node bench/console/endurance.mjs DOLPHIN PAGE [MINUTES [PAGES [DRAWN]]],
// from the folder in which scripts/console --build has installed playwright-core. DRAWN of the pages, by default one for
// each core, are in Chromium; the others only read their streams of events, as pages on other machines are for the
// server. Each half minute an input is posted, and the time until each page shows it, or has read it, is its lag. Memory of the server (its resident set) and of pages
// (their heaps after a collection) and the lag have to be bounded: in the last third as in the first one.
import { spawn } from "node:child_process";
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { availableParallelism, tmpdir } from "node:os";
import { join } from "node:path";
import { createRequire } from "node:module";
const { chromium } = createRequire(join(process.cwd(), "x"))("playwright-core");

const [dolphin, built, minutes = "60", pages = "20", drawn = String(availableParallelism())] = process.argv.slice(2);
const home = mkdtempSync(join(tmpdir(), "console-endurance-"));
const place = (n) => `${(41.18 + (n % 10) * 0.001).toFixed(4)}, ${(-8.71 + Math.floor(n / 10) * 0.0015).toFixed(4)}`;
writeFileSync(join(home, "many.fleet"), Array.from({ length: 100 }, (_, n) =>
  `vehicle 'v${n}', { type 'UUV'; at ${place(n)}; drain 1.percent }\n`).join("") + "plan 'p', { duration 9.hours; at 41.3, -8.9 }\n");
writeFileSync(join(home, "many.dol"), "input 'mark'\npick { count 100 }\nexecute " + Array(100).fill("task('p')").join(" | ") + "\n");

const server = spawn(dolphin, ["console", home, "--port", "0", "--no-browser"],
  { env: { ...process.env, XDG_STATE_HOME: join(home, "state"), DOLPHIN_CONSOLE: built }, stdio: ["ignore", "pipe", "inherit"] });
process.on("exit", () => server.kill("SIGKILL"));
let port;
for await (const text of server.stdout) if ((port = /127\.0\.0\.1:(\d+)/.exec(String(text))?.[1])) break;
const post = async (path, body) => {
  const reply = await fetch(`http://127.0.0.1:${port}/api/${path}`, { method: "POST", body: JSON.stringify(body),
    headers: { "Content-Type": "application/json", "X-Dolphin-Client": "endurance" } });
  if (!reply.ok) throw new Error(await reply.text());
};
const resident = () => Number(/VmRSS:\s+(\d+)/.exec(readFileSync(`/proc/${server.pid}/status`, "utf8"))[1]) / 1e3;

const browser = await chromium.launch({ executablePath: process.env.CHROMIUM ?? "/usr/bin/chromium", args: ["--no-sandbox"] });
const problems = [];
const open = [];
for (let i = 0; i < Number(drawn); i++) {
  const context = await browser.newContext({ viewport: { width: 1440, height: 900 } });
  context.on("weberror", (e) => problems.push(String(e.error())));
  const page = await context.newPage();
  page.setDefaultTimeout(300000);
  await page.goto(`http://127.0.0.1:${port}/`);
  const devtools = await context.newCDPSession(page);
  await devtools.send("Performance.enable");
  open.push({ page, devtools });
}
// The streams of the others, each with the moment at which it has read an input.
const streams = [];
for (let i = Number(drawn); i < Number(pages); i++) {
  const read = new Map(), stream = { read, ended: false };
  streams.push(stream);
  void (async () => {
    const reply = await fetch(`http://127.0.0.1:${port}/api/events?client=stream-${i}`), decoder = new TextDecoder();
    let rest = "";
    for await (const piece of reply.body) {
      const text = rest + decoder.decode(piece, { stream: true });
      for (const [found] of text.matchAll(/m\d+e/g)) if (!read.has(found)) read.set(found, Date.now());
      rest = text.slice(-20);
    }
  })().catch(() => {}).then(() => { stream.ended = true; });
}
await post("run", { program: "many.dol", speed: 1 });
for (const { page } of open) await page.waitForFunction(() => document.querySelectorAll("#timeline .task").length === 100);

const heap = async ({ devtools }) => {
  await devtools.send("HeapProfiler.collectGarbage");
  return (await devtools.send("Performance.getMetrics")).metrics.find((m) => m.name === "JSHeapUsedSize").value / 1e6;
};
const shows = (text) => new Promise((done) => {
  const look = () => (document.querySelector("#now").textContent.includes(text) ? done(Date.now()) : setTimeout(look, 20));
  look();
});
const median = (xs) => [...xs].sort((a, b) => a - b)[Math.floor(xs.length / 2)];
const most = (xs) => Math.max(...xs);

const rounds = [], end = Date.now() + Number(minutes) * 60000;
for (let n = 0; Date.now() < end || rounds.length < 6; n++) {
  const begun = Date.now();
  await post("run/post", { pairs: `mark: 'm${n}e'` });
  const lags = await Promise.all(open.map(async ({ page }) => (await page.evaluate(shows, `m${n}e`)) - begun));
  for (const { read } of streams) {
    while (!read.has(`m${n}e`)) await new Promise((go) => setTimeout(go, 5));
    lags.push(read.get(`m${n}e`) - begun);
  }
  const heaps = [];
  for (const page of open) heaps.push(await heap(page));
  rounds.push({ lags, heap: most(heaps), server: resident() });
  console.log(`${((Date.now() - end) / 60000 + Number(minutes)).toFixed(1)} min: lag median ${median(lags)} ms, longest ${most(lags)} ms; ` +
    `server ${resident().toFixed(0)} MB, pages at most ${most(heaps).toFixed(0)} MB`);
  await new Promise((go) => setTimeout(go, Math.max(0, Math.min(30000, Number(minutes) * 10000) - (Date.now() - begun))));
}

const third = Math.floor(rounds.length / 3), first = rounds.slice(0, third), last = rounds.slice(-third);
const lagOf = (part) => median(part.flatMap((r) => r.lags));
const serverOf = (part) => most(part.map((r) => r.server)), heapOf = (part) => most(part.map((r) => r.heap));
const demand = (what, holds) => { if (!holds) problems.push(what); };
demand("a stream of events ended", streams.every((s) => !s.ended));
demand("the lag grows", lagOf(last) <= 2 * lagOf(first) + 500);
demand("an event took more than ten seconds", most(rounds.flatMap((r) => r.lags)) <= 10000);
demand("the server's memory grows", serverOf(last) <= 1.5 * serverOf(first) + 30);
demand("the memory of pages grows", heapOf(last) <= 1.5 * heapOf(first) + 20);
console.log(`endurance: ${pages} pages, ${drawn} of them drawn, ${minutes} min: lag median ${lagOf(first)} ms first, ${lagOf(last)} ms last, longest ` +
  `${most(rounds.flatMap((r) => r.lags))} ms; server ${serverOf(first).toFixed(0)} MB first, ${serverOf(last).toFixed(0)} MB last; ` +
  `pages ${heapOf(first).toFixed(0)} MB first, ${heapOf(last).toFixed(0)} MB last`);
await browser.close();
server.kill("SIGINT");
await new Promise((done) => server.on("exit", done));
rmSync(home, { recursive: true, force: true });
for (const problem of new Set(problems)) console.log(`FAILED: ${problem}`);
process.exit(problems.length ? 1 : 0);
