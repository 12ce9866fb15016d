// The helm falls to the page that asked first when the page that has it is closed, or is silent.
export default async function helm({ page, open, test, same, choose, over }) {
  const has = (p) => p.waitForSelector("#helm >> text=you have the helm");
  const ask = async (p) => { await p.click("#helm >> text=Ask for it"); await p.waitForSelector("#helm >> text=asked for"); };
  const takes = async (p) => {
    if (await p.locator("#helm >> text=you have the helm").count()) return;
    await p.click("#helm >> text=Take it");
    await p.click("#choice button >> text=Take it");
    await has(p);
  };

  await choose(page, "stuck.dol");
  await page.selectOption("#speed", "1");
  if (await page.locator("#helm >> text=Take it").count()) await takes(page);
  await page.click("#run");
  await has(page);
  const heir = await open();
  // Counts tones instead of playing them.
  for (const p of [page, heir]) await p.evaluate(() => { window.rung = 0; window.AudioContext = class { constructor() { window.rung++; throw new Error("silent"); } }; });
  const rings = (p) => p.waitForFunction(() => window.rung > 0);
  await ask(heir);

  await test("a page that is silent loses the helm to the one that asked, and both say so", async () => {
    const before = Date.now();
    await page.route("**/api/helm", (route) => route.abort());
    await has(heir);
    same(Date.now() - before < 12_000, true, "within 12 s");
    await rings(heir);
    await rings(page);
    await heir.waitForFunction(() => document.title.includes("You have the helm"));
    await page.waitForFunction(() => document.title.includes("was taken from this page"));
    await page.unroute("**/api/helm");
  });

  await test("a page that is closed loses the helm, too", async () => {
    await ask(page);
    const before = Date.now();
    await heir.context().close();
    await has(page);
    same(Date.now() - before < 10_000, true, "within 10 s");
    await page.waitForFunction(() => document.title.includes("You have the helm"));
  });

  await page.click("#stop");
  await over(page);
  await page.selectOption("#speed", "60");
}
