// How smoothly the page draws 100 vehicles under way, with SPEED (4) positions a second each: node bench/console/page.mjs
// DOLPHIN PAGE [SECONDS [SPEED]], from the folder in which scripts/console --build has installed playwright-core.
// Frames are counted by requestAnimationFrame; what the page computes, the browser says itself, whatever else the
// machine does.
import { spawn } from "node:child_process";
import { mkdtempSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { createRequire } from "node:module";
const { chromium } = createRequire(join(process.cwd(), "x"))("playwright-core");

const [dolphin, built, seconds = "60", speed = "4"] = process.argv.slice(2);
const home = mkdtempSync(join(tmpdir(), "console-bench-"));
const place = (n) => `${(41.18 + (n % 10) * 0.001).toFixed(4)}, ${(-8.71 + Math.floor(n / 10) * 0.0015).toFixed(4)}`;
writeFileSync(join(home, "many.fleet"), Array.from({ length: 100 }, (_, n) =>
  `vehicle 'v${n}', { type 'UUV'; at ${place(n)}; drain 1.percent }\n`).join("") +
  "plan 'p', { duration 9.hours; at 41.3, -8.9 }\n");
writeFileSync(join(home, "many.dol"), "pick { count 100 }\nexecute " + Array(100).fill("task('p')").join(" | ") + "\n");

const server = spawn(dolphin, ["console", home, "--port", "0", "--no-browser"],
  { env: { ...process.env, XDG_STATE_HOME: join(home, "state"), DOLPHIN_CONSOLE: built }, stdio: ["ignore", "pipe", "inherit"] });
let port;
for await (const text of server.stdout) if ((port = /127\.0\.0\.1:(\d+)/.exec(String(text))?.[1])) break;
const browser = await chromium.launch({ executablePath: process.env.CHROMIUM ?? "/usr/bin/chromium", args: ["--no-sandbox"] });
try {
  const page = await (await browser.newContext({ viewport: { width: 1440, height: 900 } })).newPage();
  page.setDefaultTimeout(120000);
  await page.goto(`http://127.0.0.1:${port}/`);
  await page.waitForFunction(() => document.querySelectorAll("#map .vehicle").length === 100);
  const begun = await fetch(`http://127.0.0.1:${port}/api/run`, { method: "POST", headers: { "Content-Type": "application/json" },
    body: JSON.stringify({ program: "many.dol", speed: Number(speed) }) });
  if (!begun.ok) throw new Error(await begun.text());
  await page.waitForFunction(() => [...document.querySelectorAll("#vehicles td")].filter((td) => td.textContent === "p").length === 100);
  const devtools = await page.context().newCDPSession(page);
  await devtools.send("Performance.enable");
  const metrics = async () => Object.fromEntries((await devtools.send("Performance.getMetrics")).metrics.map((m) => [m.name, m.value]));
  const frames = (ms) => page.evaluate((ms) => new Promise((done) => {
    const at = [], begin = performance.now();
    const frame = (now) => { at.push(now); if (now - begin < ms) requestAnimationFrame(frame); else done(at); };
    requestAnimationFrame(frame);
  }), ms);
  const part = Math.max(5, Number(seconds) / 6);
  for (let i = 0; i < 6; i++) {
    const before = await metrics(), at = await frames(part * 1000), after = await metrics();
    const gaps = at.slice(1).map((t, n) => t - at[n]).sort((a, b) => a - b), took = (at[at.length - 1] - at[0]) / 1000;
    const busy = (after.TaskDuration - before.TaskDuration) / (after.Timestamp - before.Timestamp);
    console.log(`${(gaps.length / took).toFixed(0)} frames a second, 99 of 100 within ${gaps[Math.floor(gaps.length * 0.99)].toFixed(0)} ms; ` +
      `the page's thread is busy ${(100 * busy).toFixed(0)}% of the time; ${(after.JSHeapUsedSize / 1e6).toFixed(0)} MB`);
  }
} finally {
  await browser.close();
  server.kill("SIGINT");
  await new Promise((done) => server.on("exit", done));
  rmSync(home, { recursive: true, force: true });
}
