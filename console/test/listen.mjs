// For other machines: two links, of which one is for watching.
import { spawn } from "node:child_process";
import { chmodSync, existsSync, mkdirSync, readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";

export default async function listen({ pictures, dolphin, home, folder, environment, browser, test, same }) {
  const server = spawn(dolphin, ["console", folder, "--port", "0", "--listen", "127.0.0.1", "--no-browser"],
    { env: environment, stdio: ["ignore", "pipe", "inherit"] });
  let said = "";
  for await (const text of server.stdout) { said += text; if (/watches: (\S+)/.test(said)) break; }
  const link = (role) => new RegExp(`${role}: (\\S+)`).exec(said)[1];
  const pages = {};

  // Arguments of a process are visible to every user of the machine.
  await test("no token is among the arguments of a process", async () => {
    const fakes = join(home, "fakes"), opened = join(home, "opened");
    mkdirSync(fakes);
    writeFileSync(join(fakes, "xdg-open"), `#!/bin/sh\necho "$1" > ${opened}\n`);
    chmodSync(join(fakes, "xdg-open"), 0o755);
    const env = { ...environment, DISPLAY: ":99", PATH: fakes + ":" + process.env.PATH };
    // On a terminal the command opens a browser.
    async function begin(more) {
      const console_ = spawn("script", ["-qec", [dolphin, "console", folder, "--port", "0", ...more].join(" "), "/dev/null"],
        { env, stdio: ["pipe", "pipe", "inherit"] });
      let printed = "";
      for await (const text of console_.stdout) { printed += text; if (/watches: \S+\s|is at \S+\s/.test(printed)) break; }
      await new Promise((go) => setTimeout(go, 500));
      console_.kill("SIGTERM");
      await new Promise((done) => console_.on("exit", done));
    }
    await begin(["--listen", "127.0.0.1"]);
    same(existsSync(opened), false, "a browser was started with a link that has a token");
    await begin([]);
    same(/^http:\/\/127\.0\.0\.1:\d+\/$/.test(readFileSync(opened, "utf8").trim()), true, "the address without a token");
  });
  async function open(name, address) {
    const page = pages[name] = await (await browser.newContext({ viewport: { width: 1440, height: 900 }, ignoreHTTPSErrors: true })).newPage();
    page.setDefaultTimeout(60000);
    await page.goto(address);
    return page;
  }

  await test("without a token a page shows nothing, and says why", async () => {
    const stranger = await open("stranger", new URL(link("steers")).origin + "/");
    await stranger.waitForSelector("#banner >> text=opened by the link");
    same(await stranger.locator("#program option").count(), 0, "programs");
  });

  await test("the link for watching sees all, and commands nothing", async () => {
    const steers = await open("steers", link("steers")), watches = await open("watches", link("watches"));
    same(steers.url().includes("token"), false, "the token stays in the address");
    same(/^https:.*#sha256=[0-9a-f]{64}$/.test(link("steers")), true, "the fingerprint is in the link");
    same(steers.url().includes("sha256"), false, "and then not in the address");
    await watches.waitForSelector("#helm >> text=this link is for watching");
    await steers.waitForSelector("#program option >> nth=1", { state: "attached" });
    await steers.selectOption("#program", "targets.dol");
    await steers.waitForSelector(".cm-line >> text=sonar");
    await steers.click("#run");
    await watches.waitForSelector("#link >> text=targets.dol");
    same(await watches.locator("#run").isDisabled() && await watches.locator("#stop").isDisabled(), true, "disabled");
    same(await watches.locator("#now .input button >> visible=true").count(), 0, "buttons of inputs");
    await steers.click("#stop");
    await watches.waitForSelector(".outcome.interrupted");
  });

  await test("an operator with a name and the role answer sees the question, answers it, and commands nothing else", async () => {
    const crew = join(home, "crew");
    writeFileSync(crew, "ana steer\nrui answer\n", { mode: 0o600 });
    const manned = spawn(dolphin, ["console", folder, "--port", "0", "--listen", "127.0.0.1", "--operators", crew, "--no-browser"],
      { env: environment, stdio: ["ignore", "pipe", "inherit"] });
    let printed = "";
    for await (const text of manned.stdout) { printed += text; if (/rui, who answers: (\S+)/.test(printed)) break; }
    const ana = await open("ana", /ana, who steers: (\S+)/.exec(printed)[1]);
    const rui = await open("rui", /rui, who answers: (\S+)/.exec(printed)[1]);
    await ana.waitForSelector("#program option >> nth=1", { state: "attached" });
    await ana.selectOption("#program", "rendezvous.dol");
    await ana.waitForSelector(".cm-line >> text=Radius");
    await ana.click("#run");
    await rui.waitForSelector("#helm >> text=this link is for answers");
    await rui.waitForSelector("dialog[open] >> text=Radius");
    same(await rui.locator("#run").isDisabled() && await rui.locator("#stop").isDisabled(), true, "disabled");
    await rui.fill("#answer", "2");
    await rui.click("#give");
    await ana.waitForSelector("#log pre >> text=/rui \\(answer\\) answers .*: 2/");
    await ana.click("#stop");
    await rui.waitForSelector(".outcome.interrupted");
    manned.kill("SIGINT");
    await new Promise((done) => manned.on("exit", done));
  });

  await test("a question for the pilot opens on the pilot's page alone; an admin shuts an operator out", async () => {
    const crew = join(home, "bridge");
    writeFileSync(crew, "ana steer\nrui answer,pilot\nleo answer\nzoe admin\n", { mode: 0o600 });
    writeFileSync(join(folder, "dive.dol"), "input 'over'\nx = confirm 'pilot: May it dive?'\nmessage \"dives: $x\"\nexecute condition { poll over: true }\n");
    const manned = spawn(dolphin, ["console", folder, "--port", "0", "--listen", "127.0.0.1", "--operators", crew, "--no-browser"],
      { env: environment, stdio: ["ignore", "pipe", "inherit"] });
    let printed = "";
    for await (const text of manned.stdout) { printed += text; if (/zoe, who administers: (\S+)/.test(printed)) break; }
    const link = (name) => new RegExp(name + ", who \\w+: (\\S+)").exec(printed)[1];
    const crewPages = {};
    for (const name of ["ana", "rui", "leo", "zoe"]) crewPages[name] = await open("bridge " + name, link(name));
    const { ana, rui, leo, zoe } = crewPages;
    await ana.waitForSelector("#program option >> nth=1", { state: "attached" });
    await ana.selectOption("#program", "dive.dol");
    await ana.waitForSelector(".cm-line >> text=May it dive");
    await ana.click("#run");
    await rui.waitForSelector("dialog#question[open] >> text=pilot: May it dive?");
    for (const page of [ana, leo]) {
      await page.waitForSelector("#now .asks >> text=for pilot");
      same(await page.locator("dialog#question[open]").count(), 0, "a dialog");
      same(await page.locator("#now .asks .main").count(), 0, "a button");
      same((await page.title()).includes("May it dive"), false, "the title");
    }
    await zoe.waitForSelector("#now .asks .main >> text=Answer");
    same(await zoe.locator("dialog#question[open]").count(), 0, "a dialog of the admin");
    await rui.click("#choices >> text=Yes");
    await ana.waitForSelector("#log pre >> text=dives: true");
    same(await ana.locator("#operators-open").isVisible(), false, "operators, for who steers");
    await zoe.click("#operators-open");
    await zoe.waitForSelector("#operators tr:has-text('rui') >> text=pilot");
    if (pictures) await zoe.screenshot({ path: join(pictures, "operators.png") });
    await zoe.click("[aria-label='Shut out leo']");
    await zoe.click("#choice button >> text=Shut out");
    await zoe.waitForSelector("#operators tr:has-text('leo')", { state: "detached" });
    await leo.waitForSelector("#link >> text=no server");
    await ana.waitForSelector("#log pre >> text=zoe (admin) shuts out leo");
    await zoe.click("#operators >> text=Close");
    await zoe.click("#stop");
    await ana.waitForSelector(".outcome.interrupted");
    manned.kill("SIGINT");
    await new Promise((done) => manned.on("exit", done));
  });

  for (const page of Object.values(pages)) await page.context().close();
  server.kill("SIGINT");
  await new Promise((done) => server.on("exit", done));
}
