// Review: two runs that were on one clock, and readings over time, along the track and on the map.
import { execFileSync } from "node:child_process";
import { mkdirSync, writeFileSync } from "node:fs";
import { join } from "node:path";

// Runs of one program; in the second one a plan fails, and the other one is stopped half way.
const program = `vs = pick { count 2; type 'UUV' }
execute task('north')[vs[0]] | task('south')[vs[1]]
message 'done'
`;
const fleet = (south) => `vehicle 'auv-1', { type 'UUV'; at 41.1850, -8.7060; drain 30.percent; shows 'Temperature' }
vehicle 'auv-2', { type 'UUV'; at 41.1830, -8.7060 }
plan 'north', { duration 10.minutes; at 41.1900, -8.7000 }
plan 'south', { duration 5.minutes; at 41.1800, -8.7000${south} }
field 'Temperature', 18, at(41.185, -8.7060)
field 'Temperature', 12, at(41.195, -8.7000)
`;

export default async function review({ home, folder, dolphin, environment, page, open, pictures, test, same, text, picture }) {
  const apart = join(home, "review");
  mkdirSync(apart);
  writeFileSync(join(folder, "two.dol"), program);
  for (const [name, south] of [["calm", ""], ["rough", "; fails"]]) {
    writeFileSync(join(apart, name + ".fleet"), fleet(south));
    try {
      execFileSync(dolphin, ["exec", join(folder, "two.dol"), "--fleet", join(apart, name + ".fleet"), "--journal", join(folder, name + ".run")],
        { env: environment, stdio: "ignore" });
    } catch { /* one of them fails */ }
  }
  await page.reload();
  await page.selectOption("#layout", "review");
  await page.click("#tab-runs");

  await test("a reading is plotted over time and along the way gone, with its value below the pointer", async () => {
    await page.click("[aria-label='Replay calm.run']");
    await page.waitForSelector("#banner >> text=calm.run");
    await page.waitForFunction(() => document.querySelector("#vehicles").innerText.includes("auv-1"));
    await page.waitForSelector("#readings svg[aria-label^='battery over time']");
    same(await page.locator("#readings .reading").count(), 2, "vehicles");
    same(await page.locator("#reading option").allInnerTexts().then((t) => t.join()), "battery, %,speed, m/s,Temperature", "readings");
    await page.selectOption("#reading", "Temperature");
    await page.waitForSelector("#readings svg[aria-label^='Temperature over time: from 1']");
    same(await page.locator("#readings .reading").count(), 1, "of one vehicle");
    await page.selectOption("#reading", "battery");
    await page.selectOption("#reading-axis", "track");
    await page.waitForSelector("#readings svg[aria-label^='battery along the track']");
    await page.waitForSelector("#readings .time >> text=/m$/");
    await page.selectOption("#reading-of", "auv-1");
    await page.waitForFunction(() => document.querySelectorAll("#readings .reading").length === 1);
    await page.focus("#readings");
    for (let i = 0; i < 25; i++) await page.keyboard.press("ArrowRight");
    same(/^\d+ m: auv-1 9\d\.\d %$/.test(await text(page, "#reading-at")), true, await text(page, "#reading-at"));
    const before = await text(page, "#step");
    await page.keyboard.press("Enter");
    same(await text(page, "#step") === before, false, "the replay went there");
    await page.keyboard.press("Escape");
    same(await text(page, "#reading-at"), "", "left");
  });

  await test("the tracks on the map have the colours of a reading, with their legend", async () => {
    await page.locator("#slider").fill(await page.getAttribute("#slider", "max"));
    await page.selectOption("#reading-of", "");
    await page.check("#reading-map");
    await page.waitForSelector(".map-legend.tracks[aria-label^='Tracks by battery:']");
    await picture(page, "readings");
    await page.uncheck("#reading-map");
    await page.waitForSelector(".map-legend.tracks", { state: "hidden" });
  });

  await test("a second run stands beside it, on one clock, with what differs", async () => {
    await page.selectOption("#reading-axis", "time");
    await page.click("[aria-label='rough.run beside it']");
    await page.waitForSelector("#banner >> text=calm.run, beside rough.run");
    // The banner is there before the second journal is read and drawn.
    const count = (selector, n) => page.waitForFunction(([selector, n]) => document.querySelectorAll(selector).length === n, [selector, n]);
    await count("#timeline svg", 2);
    await page.waitForSelector("#compared >> text=Ends:");
    same(await page.locator("#timeline h3").allInnerTexts().then((t) => t.join()), "calm.run,rough.run", "their names");
    const compared = await text(page, "#compared");
    same(/The same for \d+ steps; then first: done\(auv-2.* at 5:00; second: fail\(auv-2/.test(compared), true, compared);
    same(/Ends: completed at 10:00; second: failed.* at /.test(compared), true, compared);
    same(await page.locator("#timeline .only").count() >= 2, true, "outlined");
    // One scale: the first task of the second run was stopped early.
    const [a, b] = await page.locator("#timeline svg").evaluateAll((all) => all.map((s) => s.querySelector(".task").getBoundingClientRect().width));
    same(b < a / 2, true, `${a} ${b}`);
    await count("#map path.second", 2);
    await count("#readings .reading.second", 2);
    await picture(page, "beside");
  });

  await test("both are shown at the same moment, and the second one can be left", async () => {
    await page.click("#compared button >> nth=0");
    await page.waitForFunction(() => document.querySelectorAll("#timeline svg").length === 2);
    same(await text(page, "#step"), "5:00", "the moment");
    await page.locator("#timeline svg >> nth=1").locator(".task").first().dispatchEvent("pointerdown");
    await page.waitForSelector("#picked >> text=second run: auv-1: north");
    await page.click("#banner >> text=Leave the second run");
    await page.waitForFunction(() => document.querySelectorAll("#timeline svg").length === 1);
    same(await page.locator("#map path.second").count(), 0, "tracks");
    same(await page.locator("#compared").isVisible(), false, "the comparison");
    await page.click("#banner >> text=Back to now");
    same(await page.locator(".beside").first().isVisible(), false, "nothing to be beside of");
    await page.selectOption("#layout", "plan");
    await page.click("#tab-source");
  });

  // All of them where somebody looks at pictures.
  for (const [size, width, height] of [["phone", 390, 844], ...(pictures ? [["laptop", 1366, 768], ["large", 1920, 1080]] : [])])
    for (const colorScheme of pictures ? ["light", "dark"] : ["light"]) await test(`two runs fit each layout, ${size}, ${colorScheme}`, async () => {
      const other = await open({ viewport: { width, height }, colorScheme });
      await other.selectOption("#layout", "review");
      await other.click("#tab-runs");
      await other.click("[aria-label='Replay calm.run']");
      await other.click("[aria-label='rough.run beside it']");
      await other.waitForSelector("#compared");
      for (const layout of ["plan", "run", "review"]) {
        await other.selectOption("#layout", layout);
        same(await other.evaluate(() => document.documentElement.scrollWidth <= window.innerWidth), true, `the width of ${layout}`);
        same(await other.locator("#stop").isVisible(), true, "Stop is there");
        if (!pictures) continue;
        await other.waitForTimeout(400);
        await other.screenshot({ path: join(pictures, `${layout}-${size}-${colorScheme}.png`), fullPage: size === "phone" });
      }
      await other.context().close();
    });
}
