// Vehicles that speak IMC, in another process over the loopback address: one is lost, and is back.
import { spawn } from "node:child_process";
import { mkdirSync, writeFileSync } from "node:fs";
import { join } from "node:path";

// Below the ports that systems give out by themselves, and apart from those of other tests.
const first = 24700, discovery = `${first}-${first + 4}`;

async function until(process, wanted) {
  let said = "";
  for await (const text of process.stdout) { said += text; const found = wanted.exec(said); if (found) return found; }
  throw new Error("it ended, and said only: " + said);
}

export default async function imc({ pictures, home, dolphin, environment, browser, test, same, text, over }) {
  const folder = join(home, "real"), children = [];
  mkdirSync(folder);
  writeFileSync(join(folder, "lost.dol"), `input 'over'
input 'wake', of: 'vehicle'
v = pick { type 'UUV'; timeout 5.min }
execute until { poll over: true } run (watch task('survey')[v] onError { ignore() }) >> condition { poll wake: v, never: 1 }
`);
  // The console has another fleet file, whose vehicle nobody hears.
  writeFileSync(join(folder, "lost.fleet"), "vehicle 'paper-1', { type 'UUV' }\nplan 'survey'\n");
  writeFileSync(join(folder, "real.fleet"), "vehicle 'lauv-1', { type 'UUV'; battery 77.percent }\nplan 'survey', { duration 10.min }\n");
  const start = (...args) => {
    const child = spawn(dolphin, args, { env: environment, stdio: ["ignore", "pipe", "inherit"] });
    children.push(child);
    return child;
  };

  await test("a vehicle of IMC that is lost is an alarm, which stays until it was seen, also when the vehicle is back", async () => {
    const vehicles = start("sim", join(folder, "real.fleet"), "--imc", "--announce", "0.5", "--contact", "0.2",
      "--discovery-ports", discovery, "--port", String(first + 10), "--for", "600");
    await until(vehicles, /lauv-1/);
    const server = start("console", folder, "--imc-loopback", "--imc-discovery-ports", discovery, "--port", "0", "--no-browser");
    const [, port] = await until(server, /127\.0\.0\.1:(\d+)/);
    const page = await (await browser.newContext({ viewport: { width: 1440, height: 900 } })).newPage();
    page.setDefaultTimeout(120000);
    await page.goto(`http://127.0.0.1:${port}/`);
    await page.waitForFunction(() => location.hash === "#lost.dol");
    same(await page.locator("#speed").isDisabled(), true, "vehicles of a network have no speed to choose");
    same(await text(page, "#world"), "REAL", "said in the head");
    same((await page.title()).startsWith("REAL"), true, "and in the title");
    await page.waitForSelector("#vehicles tbody tr:has-text('lauv-1')");
    await page.waitForSelector("#map .vehicle .name >> text=lauv-1");
    same(await page.locator("#vehicles tbody tr").count(), 1, "vehicles of the fleet file");
    same((await text(page, "#vehicles tbody tr")).includes("77 %"), true, "its battery");
    if (pictures) await page.screenshot({ path: join(pictures, "heard.png") });
    await page.click("#run");
    await page.waitForSelector("#choice >> text=lost.dol commands REAL vehicles");
    await page.waitForSelector("#real-vehicles >> text=lauv-1");
    same((await text(page, "#real-vehicles")).trim(), "lauv-1 UUV, battery 77 %", "its name is in the question");
    if (pictures) await page.screenshot({ path: join(pictures, "real.png") });
    await page.click("#choice button >> text=Command real vehicles");
    await page.waitForSelector("#log pre >> text=starts survey");
    // How far it is, by its own estimate.
    await page.click("#vehicles button >> text=lauv-1");
    await page.waitForFunction(() => { const bar = document.querySelector("#vehicle progress"); return bar && bar.value >= 0.01 && bar.value < 1; });
    same(await text(page, "#vehicle .of-vehicle").then((t) => /survey for .* [1-9]\d? %, \d+:\d\d left/.test(t.replace(/\s+/g, " "))), true, "in words, too");
    if (pictures) await page.screenshot({ path: join(pictures, "progress.png") });
    // A command for a real vehicle is pressed twice.
    await page.click("#command-wake");
    await page.waitForSelector("#command-wake >> text=wake lauv-1: press again");
    same(await page.locator("#log pre >> text=gets wake").count(), 0, "posted by one press");
    await page.click("#command-wake");
    await page.waitForSelector("#log pre >> text=gets wake:lauv-1");
    // Another program: one question, which names the vehicle.
    await page.locator(".cm-content").click();
    await page.keyboard.press("Control+End");
    await page.keyboard.insertText("message 'more'\n");
    await page.click("#replace");
    await page.click("#choice button >> text=Save and replace");
    await page.waitForSelector("#replacement .trouble >> text=REAL vehicles: lauv-1");
    await page.click("#replacement-replace >> text=on REAL vehicles");
    await page.waitForSelector("#log pre >> text=the run goes on with");
    await page.click("[aria-label='close lauv-1']");
    // Nothing is heard of it.
    vehicles.kill("SIGSTOP");
    await page.waitForSelector("#alarms li:has-text('lauv-1') >> text=no link");
    await page.waitForSelector("#vehicles tr.bad >> text=lauv-1");
    await page.waitForFunction(() => document.title.includes("▲"));
    vehicles.kill("SIGCONT");
    await page.waitForSelector("#alarms li:has-text('no link') >> text=until");
    await page.fill("#input-over", "true");
    await page.keyboard.press("Enter");
    await over(page);
    // No more alarms come, and those that came stay.
    await page.reload();
    await page.waitForSelector("#alarms li:has-text('no link') >> text=until");
    while (await page.locator("#alarms").isVisible()) await page.locator("#alarms button >> text=/seen/i").last().click();
    await page.waitForFunction(() => !document.title.includes("▲"));
    await page.reload();
    await over(page);
    same(await page.locator("#alarms").isVisible(), false, "alarms that were seen");
    // Vehicles are listened to again, for the next run.
    await page.click("#run");
    await page.waitForSelector("#real-vehicles >> text=lauv-1");
    await page.click("#choice button >> text=Cancel");
    await page.context().close();
  });

  for (const child of children.reverse()) {
    if (child.exitCode !== null || child.signalCode !== null) continue;
    const gone = new Promise((done) => child.on("exit", done));
    child.kill("SIGCONT");
    child.kill("SIGINT");
    await gone;
  }
}
