// People as nodes of a mission: dolphin exec with the adapter dolphin-people, whose page a phone opens. The mission of
// `program` gives an instruction after the other; each test acts on the next one.
import { execFileSync, spawn } from "node:child_process";
import { mkdirSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { createServer } from "node:net";
import { join } from "node:path";
import { serious } from "./accessibility.mjs";

const program = `input 'salinity', 'remark', 'colour', 'place', 'photo', 'enough'
ana = pick { id 'ana'; timeout 5.min }
execute ana: task('salinity')
execute waitFor { consume salinity: _ } then { s -> action { message "the salinity is $s" } }
execute watch task('carry')[ana] onError { e -> message "declined: $e"; ignore() }
execute ana: task('look')
execute waitFor { consume remark: _ } then { r -> action { message "ana remarks: $r" } }
execute ana: task('colour') >> task('place') >> task('photo')
execute waitFor { consume colour: _; consume place: _; consume photo: _ } then {
  c, p, f -> action { message "$c, $p, $f" } }
execute until { poll enough: true } run task('guard')[ana]
execute watch task('rest')[ana] onError { e -> message "failed: $e"; ignore() }
`;
const people = (port) => `listen: {port: ${port}}
people:
  ana: {skills: [crane], position: {latitude: 41.185, longitude: -8.706}, locate: true}
instructions:
  salinity:
    {text: Measure the salinity at the quay, within: 600, answer: number, input: salinity, unit: g/kg, from: 0, to: 50}
  carry: {text: Carry the buoy to the boat}
  look: {text: '<img src=x onerror="window.hacked = true">', answer: text, input: remark}
  colour: {text: Report the colour of the flag, answer: choice, choices: [red, green], input: colour}
  place: {text: Report your position, answer: position, input: place}
  photo: {text: Take a photo of the buoy, answer: photo, input: photo}
  guard: {text: Keep all boats away}
  rest: {text: Put the crane to rest}
accept: 600
declined: 0
`;
const hostile = '<img src=x onerror="window.hacked = true">';
// A phone at another place than the configuration has; the second page, without the permission, is at no place.
const place = { permissions: ["geolocation"], geolocation: { latitude: 41.25, longitude: -8.75 } };
const small = { viewport: { width: 360, height: 740 }, isMobile: true, hasTouch: true };

// Counts vibrations and tones.
const counts = () => {
  window.buzzed = window.rung = 0;
  navigator.vibrate = () => { window.buzzed++; return true; };
  const Context = window.AudioContext;
  window.AudioContext = class extends Context {
    createOscillator() { window.rung++; return super.createOscillator(); }
  };
};

const freePort = () => new Promise((done) => {
  const server = createServer().listen(0, "127.0.0.1", () => {
    const { port } = server.address();
    server.close(() => done(port));
  });
});

export default async function phone({ home, dolphin, examples, environment, browser, test, same, text, picture }) {
  const folder = join(home, "people"), file = (name) => join(folder, name);
  mkdirSync(folder);
  writeFileSync(file("phone.dol"), program);
  writeFileSync(file("people.yaml"), people(await freePort()));
  const installed = join(examples, "..", "platforms", "people"), adapter = join(installed, "dolphin-people");
  const python = process.env.DOLPHIN_PEOPLE ?? execFileSync(join(installed, "install"), { encoding: "utf8" }).trim();
  const surroundings = { cwd: folder, env: { ...environment, DOLPHIN_PEOPLE: python } };
  const links = execFileSync(adapter, ["--config", "people.yaml", "--links"], { ...surroundings, encoding: "utf8" });
  const [, link] = /^ana: (.*)$/m.exec(links), bare = link.replace(/#.*/, "");
  // An adapter that is killed is started again once `hold` is gone.
  const command = "while [ -e hold ]; do sleep 0.05; done; echo $$ > pid; "
    + `exec '${adapter}' --config people.yaml --run phone.run`;
  const run = spawn(dolphin, ["exec", "phone.dol", "--platform", command, "--journal", "phone.run"],
    { ...surroundings, stdio: ["ignore", "pipe", "pipe"] });
  const end = new Promise((done) => run.on("exit", done));
  process.on("exit", () => run.kill("SIGKILL"));
  let log = "";
  const readers = new Set();
  const hear = (bytes) => { log += bytes; for (const f of readers) f(); };
  for (const stream of [run.stdout, run.stderr]) stream.on("data", hear);
  const logged = (wanted) => new Promise((done, fail) => {
    const timer = setTimeout(() => fail(new Error(`no ${wanted} in the log: ${log}`)), 60000);
    const look = () => { if (wanted.test(log)) { clearTimeout(timer); readers.delete(look); done(wanted.exec(log)); } };
    readers.add(look);
    look();
  });
  // The last line may be written just now.
  const posts = (key) => readFileSync(file("phone.run"), "utf8").split("\n").slice(0, -1)
    .map((line) => JSON.parse(line)).filter((line) => line.event === "input" && line.key === key).length;
  while (!await fetch(link).catch(() => null)) await new Promise((done) => setTimeout(done, 50));
  const open = async (options = {}, at = link) => {
    const context = await browser.newContext({ ...small, ...options });
    await context.addInitScript(counts);
    const page = await context.newPage();
    page.setDefaultTimeout(Number(process.env.PATIENCE ?? 60000));
    await page.goto(at);
    return page;
  };
  const page = await open(place), dark = await open({ colorScheme: "dark" });
  const shows = (p, state) => p.waitForSelector(`#state >> text=${state}`);
  const confirm = async () => { await page.tap("#send"); await page.waitForSelector("#check", { state: "hidden" }); };
  const apart = async (words) => {
    const button = await page.locator(`#acts >> text=${words}`).boundingBox();
    const dialog = await page.locator("#check").boundingBox();
    same(dialog.y + dialog.height <= button.y || dialog.y >= button.y + button.height, true, "another place");
  };
  const pictures = async (name) => { await picture(page, name + "-light"); await picture(dark, name + "-dark"); };

  await test("an instruction is new on the person's pages, rings after a touch, and is accepted on both", async () => {
    await shows(dark, "New");
    await shows(page, "New");
    same(await text(page, "#text"), "Measure the salinity at the quay", "the instruction");
    same(await page.title(), "● New: Measure the salinity at the quay", "the title");
    same(await page.evaluate(() => window.buzzed), 1, "vibrations");
    same(await page.evaluate(() => document.activeElement.id), "state", "the focus");
    await page.waitForSelector("#link >> text=connected");
    await page.waitForSelector("#shared >> text=Your position is shared with the mission.");
    await dark.waitForSelector("#shared >> text=Your position is not shared.");
    for (const p of [page, dark]) same(await serious(p), "", "found by axe");
    await pictures("phone-new");
    await page.tap("#acts >> text=Accept");
    for (const p of [page, dark]) await shows(p, "Yours");
    same(await page.title(), "ana · Dolphin", "the title");
  });

  await test("a link with a wrong token is refused, one without a token is not complete", async () => {
    for (const [at, words] of [[bare + "#wrong", "The link is refused"], [bare, "not complete"]]) {
      const other = await open({}, at);
      await other.waitForSelector(`#denied >> text=${words}`);
      await picture(other, "phone-denied");
      await other.context().close();
    }
  });

  await test("a number outside the limits is refused on the page", async () => {
    await page.fill("#answer-number", "60");
    await page.tap("#acts >> text=Done");
    await page.waitForSelector("#trouble >> text=60 is refused. Enter a number from 0 to 50 g/kg.");
    same(await page.evaluate(() => document.activeElement.id), "answer-number", "the focus");
    same(await page.locator("#check").isVisible(), false, "asks whether to send it");
    same(await serious(page), "", "found by axe");
    await pictures("phone-refused");
  });

  await test("a double click on Done sends nothing; a number takes two presses, at different places", async () => {
    await page.fill("#answer-number", "35,1");
    await page.locator("#acts >> text=Done").dblclick();
    await page.waitForSelector("#check-what >> text=Done: 35.1 g/kg");
    await apart("Done");
    await page.waitForSelector("#send:not([disabled])");
    same(await serious(page), "", "found by axe");
    await picture(page, "phone-check");
    await page.keyboard.press("Escape");
    await page.waitForSelector("#check", { state: "hidden" });
    same(posts("salinity"), 0, "posts");
  });

  await test("an answer whose reply is lost is sent again, and counts once", async () => {
    await page.tap("#acts >> text=Done");
    await page.route("**/act", async (route) => { await route.fetch(); await route.abort(); }, { times: 1 });
    await confirm();
    await logged(/the salinity is 35\.1/);
    await shows(page, "New");
    await page.waitForSelector("#outbox", { state: "hidden" });
    same(posts("salinity"), 1, "posts");
  });

  await test("Decline has a reason, and is sent after a reload, too", async () => {
    same(await text(page, "#text"), "Carry the buoy to the boat", "the instruction");
    same(await page.evaluate(() => window.rung > 0), true, "a tone");
    await page.route("**/act", (route) => route.abort());
    await page.tap("#acts >> text=Decline");
    await page.fill("#why", "the buoy is too heavy");
    await picture(page, "phone-decline");
    await confirm();
    await page.waitForSelector("#link >> text=/no connection since \\d+:\\d+:\\d+; answers are kept and sent later/");
    await page.waitForSelector("#outbox >> text=Not sent yet: Decline: the buoy is too heavy");
    same(await page.locator("#acts").isVisible(), false, "buttons meanwhile");
    await picture(page, "phone-offline");
    // Without the fragment.
    await page.goto(bare);
    await page.waitForSelector("#outbox >> text=Not sent yet: Decline: the buoy is too heavy");
    await page.unroute("**/act");
    await logged(/declined: .*the buoy is too heavy/);
    await page.waitForSelector("#outbox", { state: "hidden" });
  });

  await test("texts of missions are text, and a typed answer survives a poll and a reload", async () => {
    await page.waitForSelector("#acts >> text=Accept");
    same(await text(page, "#text"), hostile, "the instruction");
    same(await page.locator("#card img").count(), 0, "images");
    await page.tap("#acts >> text=Accept");
    await page.fill("#answer-text", "two boats, one adrift");
    await page.tap("#duty-change");
    await page.waitForSelector("#duty >> text=On a break");
    await dark.tap("#duty-change");
    await page.waitForFunction(() => document.querySelector("#duty").textContent === "On duty");
    same(await page.inputValue("#answer-text"), "two boats, one adrift", "after polls");
    await page.reload();
    await page.waitForSelector("#answer-text");
    same(await page.inputValue("#answer-text"), "two boats, one adrift", "after a reload");
    same(await page.evaluate(() => window.hacked), undefined, "a script of the mission");
    await pictures("phone-yours");
  });

  await test("an adapter that is killed while an answer is sent gets it once it is back, and once", async () => {
    await page.tap("#acts >> text=Done");
    writeFileSync(file("hold"), "");
    process.kill(Number(readFileSync(file("pid"), "utf8")), "SIGKILL");
    await confirm();
    await page.waitForSelector("#outbox >> text=Not sent yet: Done: two boats, one adrift");
    rmSync(file("hold"));
    await logged(/ana remarks: two boats, one adrift/);
    await page.waitForSelector("#outbox", { state: "hidden" });
    await page.waitForSelector("#link >> text=connected");
    same(posts("remark"), 1, "posts");
  });

  await test("a choice, a position and a photo are answers, too", async () => {
    const accept = async (words) => {
      await page.waitForSelector(`#text >> text=${words}`);
      await page.tap("#acts >> text=Accept");
    };
    const send = async (words) => {
      await page.tap("#acts >> text=Done");
      await page.waitForSelector(`#check-what >> text=${words}`);
      await confirm();
    };
    await accept("the colour");
    await page.tap("#acts >> text=Done");
    await page.waitForSelector("#trouble >> text=Choose one of them.");
    await page.check("text=green");
    await page.waitForSelector("#trouble", { state: "hidden" });
    await picture(page, "phone-choice");
    await send("Done: green");
    await accept("your position");
    await page.tap("text=Use my position");
    await page.waitForSelector("#answer >> text=Your position, within");
    await picture(page, "phone-position");
    await send("Done: 41.25°, -8.75°");
    await accept("a photo");
    const take = (name, mimeType, buffer) => page.setInputFiles("#answer-file", { name, mimeType, buffer });
    await take("buoy.txt", "text/plain", Buffer.from("a buoy"));
    await page.waitForSelector("#answer >> text=The photo is refused");
    await take("buoy.png", "image/png", await page.screenshot());
    await page.waitForSelector("#answer >> text=The photo is sent: ana-");
    same(await page.evaluate(() => document.querySelector("#answer img").naturalWidth > 0), true, "the photo is shown");
    same(await serious(page), "", "found by axe");
    await picture(page, "phone-photo");
    await send("Done: ana-");
    await logged(/green, .*41\.25.*, ana-.*\.png/);
  });

  await test("Cannot needs a reason; a stop takes the buttons away, and the person confirms it", async () => {
    await page.tap("#acts >> text=Accept");
    // With a small screen there is one place for the dialog.
    await page.setViewportSize({ width: 360, height: 560 });
    await page.tap("#acts >> text=Cannot");
    await apart("Cannot");
    await page.setViewportSize(small.viewport);
    await page.tap("#send");
    await page.waitForSelector("#why-trouble >> text=Enter a reason.");
    // The stop takes the dialog away.
    const post = spawn(dolphin, ["post", file("phone.run"), "enough: true"], { env: environment, stdio: "ignore" });
    same(await new Promise((done) => post.on("exit", done)), 0, "dolphin post");
    for (const p of [page, dark]) await shows(p, "Stop: this is no longer wanted");
    same(await page.locator("#check").isVisible(), false, "the dialog");
    same(await serious(page), "", "found by axe");
    same(await serious(dark), "", "found by axe");
    await pictures("phone-stop");
    await page.tap("#acts >> text=I have stopped");
    await page.waitForSelector("#check-what >> text=I have stopped");
    await confirm();
    await page.waitForSelector("#text >> text=Put the crane to rest");
    await page.tap("#acts >> text=Accept");
    await page.tap("#acts >> text=Cannot");
    await page.fill("#why", "it is stuck");
    await confirm();
    await logged(/failed: .*cannot: it is stuck/);
  });

  await test("the mission ends, and its pages report that there is no connection", async () => {
    same(await end, 0, log);
    for (const p of [page, dark]) await p.waitForSelector("#link >> text=no connection since");
  });
  for (const p of [page, dark]) await p.context().close();
}
