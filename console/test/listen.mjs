// For other machines: two links, of which one is for watching.
import { spawn } from "node:child_process";

export default async function ({ dolphin, folder, environment, browser, test, same, complaints }) {
  const server = spawn(dolphin, ["console", folder, "--port", "0", "--listen", "127.0.0.1", "--no-browser"],
    { env: environment, stdio: ["ignore", "pipe", "inherit"] });
  let said = "";
  for await (const text of server.stdout) { said += text; if (/watches: (\S+)/.test(said)) break; }
  const link = (role) => new RegExp(`${role}: (\\S+)`).exec(said)[1];
  const pages = {};
  async function open(name, address) {
    const page = pages[name] = await (await browser.newContext({ viewport: { width: 1440, height: 900 } })).newPage();
    page.setDefaultTimeout(60000);
    complaints(page);
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

  for (const page of Object.values(pages)) await page.context().close();
  server.kill("SIGINT");
  await new Promise((done) => server.on("exit", done));
}
