// Replace on the page: what differs, what the check says, refusals, and the run that goes on with another program.
import { readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";

export default async function replace({ folder, page, open, test, same, text, choose, over, picture, pictures }) {
  const first = "input 'go'\nv = pick { count 1 }\nexecute v: task('survey') >> waitFor { consume go: true } then task('survey')\n";
  const write = (name, source) => writeFileSync(join(folder, name), source);
  write("swap.dol", first);
  write("swap.fleet", "vehicle 'a', { type 'UUV' }\nplan 'survey', { duration 30.seconds }\nplan 'home', { duration 30.seconds }\ninput 'go', true, after 40.hours\n");
  write("better.dol", first.replace("then task('survey')", "then task('home')") + "message 'the new way'\n");
  write("other.dol", first.replace("v: task('survey')", "v: task('home')"));
  write("wrong.dol", first + "execute condition { poll never: 1 }\n");
  await page.reload();
  await choose(page, "swap.dol");
  await page.selectOption("#speed", "10");
  same(await page.locator("#replace").isVisible(), false, "Replace, before a run");
  await page.click("#run");
  await page.waitForSelector("#now >> text=consume");
  const asked = async (path) => { await choose(page, path); await page.click("#replace"); await page.waitForSelector("#replacement[open]"); };

  await test("a program that the run does not begin is refused, with the first step that differs", async () => {
    await asked("other.dol");
    await page.waitForSelector("#differences .removed >> text=v: task('survey')");
    await page.waitForSelector("#differences .added >> text=v: task('home')");
    await page.waitForSelector("#checked .trouble >> text=/start\\(a, survey\\)/");
    same(await page.locator("#replacement-replace").count(), 0, "no way to replace it");
    await page.click("#replacement-cancel");
  });

  await test("one that can go wrong from here on is not replaced without a word", async () => {
    await asked("wrong.dol");
    await page.waitForSelector("#checked .violated >> text=no deadlock: violated");
    same(await text(page, "#replacement-replace"), "Replace all the same", "the button");
    await picture(page, "replace-wrong");
    await page.keyboard.press("Escape");
    same(await page.locator("#replacement[open]").count(), 0, "Escape leaves it");
  });

  await test("Stop is above the dialog in three sizes", async () => {
    await asked("better.dol");
    await page.waitForSelector("#checked .holds");
    same(await page.locator("#stop").isEnabled(), true, "Stop");
    for (const [name, width, height] of [["replace", 1440, 900], ["replace-tablet", 1024, 768], ["replace-phone", 390, 844]]) {
      await page.setViewportSize({ width, height });
      same(await page.evaluate(() => { const b = document.querySelector("#stop").getBoundingClientRect();
        return document.elementFromPoint(b.x + b.width / 2, b.y + b.height / 2).closest("button").id; }), "stop", "nothing lies upon it");
      if (pictures) await page.screenshot({ path: join(pictures, name + ".png") });
    }
    await page.setViewportSize({ width: 1440, height: 900 });
  });

  await test("the run goes on with the new program, and its journal is one of it", async () => {
    await page.click("#replacement-replace");
    await page.waitForSelector("#link >> text=better.dol");
    await page.waitForSelector("#log pre >> text=the run goes on with");
    // What may follow is computed again, of the new program.
    await page.waitForSelector("#outlook >> text=/over/");
    await page.fill("#input-go", "true");
    await page.keyboard.press("Enter");
    await over(page);
    await page.waitForSelector("#log pre >> text=the new way");
    await page.click(".outcome >> text=Replay");
    await page.waitForFunction(() => [...document.querySelectorAll("#log pre")].some((l) => l.textContent.includes("the new way")));
    await page.click("#banner >> text=Back to now");
  });

  await test("the text of the program itself is edited, saved and replaced", async () => {
    await choose(page, "swap.dol");
    await page.click("#run");
    await page.waitForSelector("#now >> text=consume");
    await page.locator(".cm-content").click();
    await page.keyboard.press("Control+End");
    await page.keyboard.insertText("message 'edited'\n");
    await page.click("#replace");
    await page.click("#choice button >> text=Save and replace");
    await page.waitForSelector("#replacement h2 >> text=Replace swap.dol by its new text");
    await page.waitForSelector("#differences .added >> text=message 'edited'");
    await page.click("#replacement-replace");
    await page.waitForSelector("#replacement", { state: "hidden" });
    await page.click("#replace");
    await page.waitForSelector("#differences >> text=Nothing differs");
    await page.click("#replacement-cancel");
    await page.click("#stop");
    await over(page);
    same(readFileSync(join(folder, "swap.dol"), "utf8").includes("edited"), true, "the file");
  });
}
