// Stop works within 0.3 s, whatever a hostile client that watches does meanwhile.
import { execFileSync, spawn } from "node:child_process";
import { appendFileSync, mkdirSync, readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { fileURLToPath } from "node:url";

// The nightly job has more rounds, and watchers that make each request of docs/openapi.json.
const rounds = Number(process.env.ROUNDS ?? 40), walkers = Number(process.env.WALKERS ?? 0);

// A journal of a run, long enough that reading it takes seconds.
function longJournal(from, to) {
  const lines = readFileSync(from, "utf8").trim().split("\n");
  const line = lines.find((l) => l.includes('"kind":"vehicle"')) + "\n";
  const piece = line.repeat(Math.ceil(1_000_000 / line.length));
  writeFileSync(to, lines[0] + "\n");
  for (let i = 0; i < 60; i++) appendFileSync(to, piece);
}

export default async function stop({ dolphin, home, openapi, environment, browser, test, same }) {
  const folder = join(home, "abused");
  mkdirSync(folder);
  writeFileSync(join(folder, "mission.dol"), "v = pick { type 'UUV' }\nexecute task('survey')[v] | condition { poll never: 1 }\n");
  writeFileSync(join(folder, "mission.fleet"), "vehicle 'lauv-1', { type 'UUV' }\nplan 'survey', { duration 10.hours; at 41.18, -8.70 }\n");
  for (const end of ["dol", "fleet", "geojson"]) execFileSync("mkfifo", [join(folder, "pipe." + end)]);
  writeFileSync(join(home, "short.dol"), "v = pick { type 'UUV' }\n");
  execFileSync(dolphin, ["exec", join(home, "short.dol"), "--journal", join(home, "short.run")], { env: environment, stdio: "ignore" });
  longJournal(join(home, "short.run"), join(folder, "long.run"));

  const server = spawn(dolphin, ["console", folder, "--port", "0", "--listen", "127.0.0.1", "--no-tls", "--no-browser"],
    { env: environment, stdio: ["ignore", "pipe", "inherit"] });
  process.on("exit", () => server.kill("SIGKILL"));
  let said = "";
  for await (const text of server.stdout) { said += text; if (/watches: (\S+)/.test(said)) break; }
  const link = (role) => new URL(new RegExp(`${role}: (\\S+)`).exec(said)[1]);
  const token = (role) => link(role).searchParams.get("token"), origin = link("steers").origin;
  const page = await (await browser.newContext({ viewport: { width: 1440, height: 900 } })).newPage();
  page.setDefaultTimeout(60000);
  await page.goto(String(link("steers")));
  await page.waitForSelector("#program option", { state: "attached" });

  const abuser = spawn("node", [fileURLToPath(new URL("abuse.mjs", import.meta.url)), origin, token("watches"), openapi, String(walkers)],
    { stdio: ["ignore", "pipe", "inherit"] });
  process.on("exit", () => abuser.kill("SIGKILL"));
  const begun = new Map();
  let operations = 0, rest = "";
  abuser.stdout.on("data", (text) => {
    const lines = (rest + text).split("\n");
    rest = lines.pop();
    for (const line of lines)
      if (line.startsWith("operations ")) operations = Number(line.split(" ")[1]); else begun.set(line, (begun.get(line) ?? 0) + 1);
  });
  while (begun.size < 10) await new Promise((go) => setTimeout(go, 20));

  async function ask(path, body) {
    const reply = await fetch(`${origin}/api/${path}`, { method: body ? "POST" : "GET", body: body && JSON.stringify(body),
      headers: { Authorization: "Bearer " + token("steers"), "Content-Type": "application/json" } });
    return await reply.json();
  }
  async function start() {
    for (;;) { // its check has a worker of those for who steers, as slow as the machine
      await ask("run", { program: "mission.dol", speed: 10 });
      if ((await ask("status")).run?.state === "running") return;
      await new Promise((go) => setTimeout(go, 50));
    }
  }

  await test("Stop takes at most 0.3 s while a watcher does what it can", async () => {
    const times = [];
    for (let i = 0; i < rounds; i++) {
      await start();
      const before = performance.now();
      await ask("run/stop", {});
      times.push(performance.now() - before);
      while ((await ask("status")).run.state !== "over") await new Promise((go) => setTimeout(go, 5));
    }
    times.sort((a, b) => a - b);
    console.log(`     Stop: median ${times[rounds / 2].toFixed(0)} ms, longest ${times[rounds - 1].toFixed(0)} ms`);
    same(times.filter((t) => t > 300).length <= 1, true, `in ms: ${times.map(Math.round).join(" ")}`);
  });

  await test("and so does the button of a page", async () => {
    const times = [];
    for (let i = 0; i < 5; i++) {
      await start();
      await page.waitForSelector("#stop:not([disabled])");
      const delivered = page.waitForResponse((r) => r.url().endsWith("/api/run/stop") && r.ok());
      const before = performance.now();
      await page.evaluate(() => document.getElementById("stop").click());
      await delivered;
      times.push(performance.now() - before);
      await page.waitForSelector(".outcome.interrupted");
    }
    times.sort((a, b) => a - b);
    console.log(`     by the page: median ${times[2].toFixed(0)} ms, longest ${times[4].toFixed(0)} ms`);
    same(times[2] <= 300, true, `in ms: ${times.map(Math.round).join(" ")}`);
  });

  await test("the watchers went on meanwhile", async () => {
    same(abuser.exitCode, null, "its status");
    same(operations > 40, true, `requests: ${operations}`);
    if (walkers > 0) while (begun.size < 10 + operations) await new Promise((go) => setTimeout(go, 50));
    console.log(`     ${[...begun.values()].reduce((a, b) => a + b)} requests of ${begun.size} kinds`);
    for (const [i, n] of begun) same(n >= 1, true, `attack ${i}, begun ${n} times`);
    same((await ask("status")).run.state, "over", "the server answers");
  });

  abuser.kill("SIGKILL");
  await page.context().close();
  server.kill("SIGINT");
  await new Promise((done) => server.on("exit", done));
}
