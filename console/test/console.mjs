// A newcomer's way through the page, a second page, a reload, a server that is killed: node test/console.mjs DOLPHIN PAGE
// EXAMPLES [PICTURES]. Needs Chromium, by default Debian's. ONLY="helm stop" in the environment picks parts: the modules
// below, and newcomer.
import { spawn } from "node:child_process";
import { cpSync, mkdirSync, mkdtempSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { chromium } from "playwright-core";
import accessibility from "./accessibility.mjs";
import analyses from "./analyses.mjs";
import draw from "./draw.mjs";
import helm from "./helm.mjs";
import imc from "./imc.mjs";
import listen from "./listen.mjs";
import maps from "./maps.mjs";
import places from "./places.mjs";
import people from "./people.mjs";
import phonePage from "./phone.mjs";
import plans from "./plans.mjs";
import review from "./review.mjs";
import stop from "./stop.mjs";
import truth from "./truth.mjs";
import outlook from "./outlook.mjs";
import replace from "./replace.mjs";
import workplace from "./workplace.mjs";

const [dolphin, built, examples, pictures] = process.argv.slice(2);
const home = mkdtempSync(join(tmpdir(), "console-"));
const folder = join(home, "missions");
mkdirSync(folder);
for (const name of ["rendezvous", "targets", "unanswered"])
  for (const end of [".dol", ".fleet"]) try { cpSync(join(examples, name + end), join(folder, name + end)); } catch { /* no fleet */ }
writeFileSync(join(folder, "stuck.dol"),
  "v = pick { type 'UUV' }\nexecute task('survey')\nexecute waitFor { consume(go: 1) } then task('never')\n");

const environment = { ...process.env, XDG_STATE_HOME: join(home, "state"), DOLPHIN_CONSOLE: built };
let server, port = 0;
async function serve() {
  server = spawn(dolphin, ["console", folder, "--port", String(port), "--no-browser"],
    { env: environment, stdio: ["ignore", "pipe", "inherit"] });
  for await (const text of server.stdout) {
    const found = /127\.0\.0\.1:(\d+)/.exec(String(text));
    if (found) { port = Number(found[1]); break; }
  }
}

// Also where a test ends all of them.
process.on("exit", () => server.kill("SIGKILL"));

const only = process.env.ONLY?.split(" ");
const wanted = (part) => !only || only.includes(part);
let part = "newcomer", passed = 0, failed = 0;
const problems = [];
// Also fails if the browser complains meanwhile.
async function test(name, f) {
  if (!wanted(part)) return;
  const before = problems.length;
  try { await f(); same([...new Set(problems.slice(before))].join("\n"), "", "complaints"); passed++; console.log("ok  ", name); }
  catch (e) { failed++; console.log("FAIL", name, "\n    ", String(e.message).split("\n").slice(0, 6).join("\n     ")); }
}

function same(found, wanted, what) {
  if (found !== wanted) throw new Error(`${what}: ${JSON.stringify(found)}, and not ${JSON.stringify(wanted)}`);
}

await serve();
const browser = await chromium.launch({ executablePath: process.env.CHROMIUM ?? "/usr/bin/chromium", args: ["--no-sandbox"] });

// Errors of scripts and of the console, and violations of the page's policy with the element and the line. A reply that
// refuses is an error for the browser, too: "Failed to load resource". Every page of every part is listened to.
const violations = () => addEventListener("securitypolicyviolation", (e) => {
  const { violatedDirective, blockedURI, sourceFile, lineNumber, columnNumber, sample, target } = e;
  console.error("policy:", JSON.stringify({ violatedDirective, blockedURI, sourceFile, lineNumber, columnNumber, sample,
    target: String(target?.outerHTML ?? target?.nodeName).slice(0, 300) }));
});
const newContext = browser.newContext.bind(browser);
browser.newContext = async (options) => {
  const context = await newContext(options);
  context.on("console", (m) => {
    const { url, lineNumber } = m.location();
    if (m.type() === "error" && !/Failed to load resource|ERR_/.test(m.text())) problems.push(`${m.text()} (${url}:${lineNumber})`);
  });
  context.on("weberror", (e) => problems.push(String(e.error().stack ?? e.error())));
  await context.addInitScript(violations);
  return context;
};

async function open(options = {}) {
  const context = await browser.newContext({ viewport: { width: 1440, height: 900 }, ...options });
  const page = await context.newPage();
  page.setDefaultTimeout(Number(process.env.PATIENCE ?? 60000));
  await page.goto(`http://127.0.0.1:${port}/`);
  await page.waitForFunction(() => document.querySelectorAll("#program option").length > 0);
  return page;
}

const picture = async (page, name) => { if (pictures) await page.screenshot({ path: join(pictures, name + ".png") }); };
const text = (page, selector) => page.locator(selector).innerText();
const choose = async (page, path) => {
  await page.selectOption("#program", path);
  await page.waitForFunction((p) => location.hash === "#" + p, path);
};
const over = (page) => page.waitForSelector(".outcome.completed, .outcome.interrupted, .outcome.failed, .outcome.stuck, .outcome.halted");

const page = await open();

await test("the page opens with the programs of the folder, and a text to edit", async () => {
  same(await page.locator("#program option").count(), 4, "programs");
  await choose(page, "rendezvous.dol");
  await page.waitForSelector(".cm-line >> text=Radius of operation area");
  await page.waitForFunction(() => document.querySelector("#faults").textContent.startsWith("no errors"));
});

await test("the fleet stands on the map before anything runs", async () => {
  await page.waitForSelector("#map .vehicle .name >> text=noptilus-1");
  same(await page.locator("#vehicles tbody tr").count(), 4, "vehicles");
});

await test("explore tells its verdicts", async () => {
  await page.click("#explore");
  await page.waitForSelector(".verdicts .holds >> text=no deadlock");
  await picture(page, "verdicts");
  await page.click("#tab-source");
});

await test("a run asks, is answered, and grows on map, timeline and log", async () => {
  await page.selectOption("#speed", "60");
  await page.click("#run");
  await page.waitForSelector("dialog[open] >> text=Radius of operation area");
  await picture(page, "question");
  await page.fill("#answer", "2 +");
  await page.click("#give");
  await page.waitForFunction(() => document.querySelector("#refused").textContent !== "");
  await page.fill("#answer", "2");
  await page.keyboard.press("Enter");
  await page.waitForSelector("#timeline .task");
  await page.waitForSelector("#log pre >> text=noptilus-1");
  await page.waitForSelector("#now >> text=consume");
  await page.waitForTimeout(4000);
  if (pictures) await page.click(".map-button >> text=Fleet");
  await picture(page, "light");
});

const second = await open({ colorScheme: "dark" });
const lines = (p) => p.evaluate(() => [...document.querySelectorAll("#log pre")].slice(0, 12).map((l) => l.textContent).join("\n"));

await test("a second page sees the same, watches, asks for the helm, and may take it by force", async () => {
  await second.waitForSelector("#timeline .task");
  same(await lines(second), await lines(page), "the log");
  await second.waitForSelector("#helm >> text=another page");
  await picture(second, "dark");
  await second.click("#helm >> text=Ask for it");
  await page.waitForFunction(() => document.title.includes("asks for the helm"));
  await page.click("#helm >> text=Hand it over");
  await second.waitForSelector("#helm >> text=you have the helm");
  await second.waitForFunction(() => document.title.includes("You have the helm"));
  await page.click("#helm >> text=Take it");
  await page.click("#choice button >> text=Take it");
  await page.waitForSelector("#helm >> text=you have the helm");
  await second.waitForFunction(() => document.title.includes("was taken from this page"));
  await second.waitForSelector("#banner >> text=has taken the helm");
  await second.waitForSelector("#log pre >> text=takes the helm from");
});

await test("a page that is loaded again sees the same", async () => {
  const before = await lines(page);
  await page.reload();
  await page.waitForSelector("#timeline .task");
  same(await lines(page), before, "the log");
});

await test("on a phone all is there, and nothing is wider than the screen", async () => {
  const phone = await open({ viewport: { width: 390, height: 844 }, isMobile: true, hasTouch: true });
  await phone.waitForSelector("#timeline .task");
  same(await phone.evaluate(() => document.documentElement.scrollWidth <= window.innerWidth), true, "it fits");
  await phone.waitForTimeout(300);
  if (pictures) await phone.screenshot({ path: join(pictures, "phone.png"), fullPage: true });
  await phone.context().close();
});

await test("the run is watched to its end", async () => {
  await over(page);
  same((await text(page, ".outcome")).split("\n")[0].replace("Replay", ""), "rendezvous.dol: end", "its outcome");
});

await test("and replayed, forwards and back", async () => {
  await page.click("#tab-runs");
  await page.click("#runs tbody tr:first-child >> text=Replay");
  await page.waitForSelector("#slider-row:not([hidden])");
  await page.locator("#slider").fill("40");
  const there = await text(page, "#step");
  await page.click("#forward");
  await page.click("#back");
  await page.locator("#slider").fill("40");
  same(await text(page, "#step"), there, "the place");
  await page.fill("#note", "look here");
  await page.keyboard.press("Enter");
  await page.waitForSelector("#timeline .mark.note title >> text=/note: look here/", { state: "attached" });
  await picture(page, "note");
  await page.locator("#slider").fill("0");
  await page.waitForFunction(() => document.querySelectorAll("#timeline .mark.note").length === 0);
  await page.locator("#slider").fill("40");
  await page.waitForFunction(() => document.querySelectorAll("#timeline .mark.note").length === 1);
  await page.click("#banner >> text=Back to now");
});

await test("a fault is told as one types, with what would be right", async () => {
  await page.click("#tab-source");
  await choose(page, "targets.dol");
  await page.waitForSelector(".cm-line >> text=sonar");
  await page.locator(".cm-content").click();
  await page.keyboard.press("Control+End");
  // At once: what is typed key by key is completed now and then, and undone in parts.
  await page.keyboard.insertText("\nmesage 'x'\n");
  await page.waitForSelector("#faults >> text=unknown name 'mesage'");
  await picture(page, "fault");
  await page.keyboard.press("Control+z");
  await page.waitForSelector("#faults >> text=no errors");
});

await test("names are completed", async () => {
  await page.keyboard.press("Control+End");
  await page.keyboard.insertText("\nexec");
  await page.keyboard.press("Control+Space");
  await page.waitForSelector(".cm-tooltip-autocomplete >> text=execute");
  await page.keyboard.press("Escape");
  await page.keyboard.press("Control+z");
});

await test("inputs are posted, and Stop stops", async () => {
  await page.selectOption("#program", "stuck.dol");
  await page.click("#choice button >> text=Leave it");
  await page.waitForFunction(() => location.hash === "#stuck.dol");
  await choose(page, "targets.dol");
  if (await second.locator("#helm >> text=you have the helm").count()) {
    await page.click("#helm >> text=Take it");
    await page.click("#choice button >> text=Take it");
  }
  await page.click("#run");
  await page.waitForSelector("#input-found");
  await page.fill("#input-found", "'wreck'");
  await page.keyboard.press("Enter");
  await page.waitForSelector("#log pre >> text=To the wreck");
  // By whoever steers, without the helm, by the key, at the same place on each page.
  same(JSON.stringify(await second.locator("#stop").boundingBox()), JSON.stringify(await page.locator("#stop").boundingBox()), "the place");
  await second.waitForSelector("#stop:not([disabled])");
  const before = Date.now();
  await second.keyboard.press("F8");
  await second.waitForSelector(".outcome.interrupted");
  same(Date.now() - before < 1000, true, "at once");
});

await test("a counterexample is stepped through, on source and log", async () => {
  await choose(page, "stuck.dol");
  await page.click("#explore");
  await page.waitForSelector(".verdicts .violated >> text=no deadlock");
  await page.click("text=Step through it");
  await page.waitForSelector("#banner >> text=Counterexample");
  await page.click("#back");
  await page.click("#tab-source");
  same(await page.locator(".cm-here").count(), 1, "the line is shown");
  await picture(page, "counterexample");
  await page.click("#banner >> text=Back to now");
});

await test("and carried out in the simulator", async () => {
  await page.click("#tab-verdicts");
  await page.click("text=Run this in the simulator");
  await page.waitForSelector("#link >> text=counterexample of stuck.dol");
  await page.waitForSelector("#timeline .task");
  await picture(page, "enacted");
  await page.waitForSelector(".outcome.stuck >> text=stuck.dol, as the counterexample says: stuck");
  same(await page.locator(".outcome >> text=Replay").count(), 0, "it has no journal");
  await page.click("#tab-source");
});

await test("a server that is killed in a run offers to resume it", async () => {
  await choose(page, "rendezvous.dol");
  await page.click("#run");
  await page.waitForSelector("dialog[open]");
  server.kill("SIGKILL");
  await page.waitForSelector("#link >> text=no server");
  await serve();
  await page.waitForSelector("#banner >> text=can be resumed", { timeout: 60000 });
  await page.evaluate(() => document.querySelector("dialog").close());
  const right = async (what) => { const box = await page.locator(what).first().boundingBox(); return box.x + box.width; };
  same(await right("#runs tbody tr >> text=Resume") <= await right("#runs"), true, "the button is in sight");
  await page.click("#runs tbody tr >> text=Resume");
  await page.waitForSelector("dialog[open] >> text=Radius");
  await page.fill("#answer", "2");
  await page.click("#give");
  await page.waitForSelector("#timeline .task");
  await page.click("#stop");
  await page.waitForSelector(".outcome.interrupted");
});

// A picture of what the run looks like on a phone, and a check that it fits.
async function phone(name) {
  const small = await open({ viewport: { width: 390, height: 844 }, isMobile: true, hasTouch: true });
  await small.waitForSelector("#timeline svg");
  same(await small.evaluate(() => document.documentElement.scrollWidth <= window.innerWidth), true, name + " fits");
  if (pictures) await small.screenshot({ path: join(pictures, name + ".png"), fullPage: true });
  await small.context().close();
}

const all = { folder, page, test, same, text, choose, over, picture, phone };
const more = { ...all, home, dolphin, examples, openapi: join(examples, "..", "docs", "openapi.json"), environment, browser, open, pictures, server: () => server };
for (const f of [helm, truth, outlook, replace, people, analyses, maps, plans, draw, workplace, review, places, accessibility, stop, listen, imc, phonePage]) {
  part = f.name;
  if (wanted(part)) await f(more);
}
part = "newcomer";

await test("all can be reached by keyboard, and all has a name", async () => {
  const nameless = await page.evaluate(() => [...document.querySelectorAll("button, input, select, [role=tab]")]
    .filter((e) => e.checkVisibility() && !(e.textContent.trim() || e.getAttribute("aria-label") || e.labels?.length || e.title))
    .map((e) => e.outerHTML));
  same(nameless.join(), "", "without a name");
  await page.keyboard.press("Tab");
  same(await page.evaluate(() => document.activeElement !== document.body), true, "the focus moves");
});

await test("the browser had nothing to complain of", async () => same([...new Set(problems)].join("\n"), "", "complaints"));

await browser.close();
server.kill("SIGINT");
await new Promise((done) => server.on("exit", done));
rmSync(home, { recursive: true, force: true });
console.log(`${passed} passed, ${failed} failed`);
process.exit(failed ? 1 : 0);
