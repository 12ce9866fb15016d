// Where things are: journals that lie in the folder, what is picked on the timeline, places in files that a program
// includes, definitions there, how what is called is called, and what was found of another program.
import { spawnSync } from "node:child_process";
import { mkdirSync, writeFileSync } from "node:fs";
import { join } from "node:path";

export default async function places({ folder, page, test, same, text, choose, over, picture, dolphin, environment }) {
  mkdirSync(join(folder, "shore"));
  writeFileSync(join(folder, "shore", "rules.dol"), `// What all missions share.
def permitted(what) {
    confirm "May $what begin?"
}
def ready() {
    waitFor { consume(wind: 'low') && consume(crew: 'ashore') } then action { message 'ready' }
}
`);
  writeFileSync(join(folder, "shore", "harbour.dol"), `include 'rules.dol'
input 'wind', 'crew'
v = pick { type 'UUV' }
if (!permitted('the survey')) { halt 'not permitted' }
execute task('survey')[v]
execute ready()
`);
  writeFileSync(join(folder, "shore", "harbour.fleet"), "vehicle 'lauv-1', { type 'UUV' }\nplan 'survey', { duration 2.minutes; at 41.19, -8.70 }\nanswer 'May the survey begin?', true\ninput 'wind', 'low', after 3.minutes\ninput 'crew', 'ashore', after 4.minutes\n");
  // Brought home from another machine: its header has a path of there.
  const ran = spawnSync(dolphin, ["exec", "harbour.dol", "--journal", "monday.run"], { cwd: join(folder, "shore"), env: environment });
  if (ran.status !== 0) throw new Error(String(ran.stderr));
  await page.reload();
  await page.waitForFunction(() => [...document.querySelectorAll("#program option")].some((o) => o.value === "shore/harbour.dol"));

  await test("a journal of the folder is replayed as runs are", async () => {
    await choose(page, "shore/harbour.dol");
    await page.click("#tab-runs");
    await page.click("[aria-label='Replay shore/monday.run']");
    await page.waitForSelector("#banner >> text=shore/monday.run");
    await page.waitForSelector("#timeline .task.done");
    await page.waitForSelector("#log pre >> text=lauv-1");
    same(await page.locator("#slider-row").isVisible(), true, "the slider");
    await picture(page, "journal");
  });

  await test("what is picked on the timeline is told, with its line and where vehicles were", async () => {
    await page.locator("#timeline .task").first().click();
    await page.waitForSelector("#picked >> text=lauv-1: survey");
    await page.waitForSelector("#map .then >> text=lauv-1");
    await page.waitForSelector(".cm-here >> text=execute task('survey')");
    await picture(page, "picked");
    await page.click("#picked >> [aria-label='leave it']");
    same(await page.locator("#map .then").count(), 0, "nobody is shown as he was");
  });

  await test("by arrow keys, too; and the place may be in a file that the program includes", async () => {
    await page.focus("#timeline");
    await page.keyboard.press("ArrowRight");
    await page.waitForSelector("#picked >> text=asked: May the survey begin?");
    await page.waitForSelector("#picked >> text=rules.dol line 3");
    await page.waitForFunction(() => location.hash === "#shore/rules.dol");
    await page.waitForSelector(".cm-here >> text=confirm");
    await page.goBack();
    await page.waitForSelector(".cm-line >> text=include 'rules.dol'");
    await page.focus("#timeline");
    await page.keyboard.press("Escape");
    same(await page.locator("#picked").isVisible(), false, "left");
    await page.click("#banner >> text=Back to now");
  });

  await test("definitions in other files are opened", async () => {
    await page.click("#tab-source");
    await page.locator(".cm-line >> text=execute ready()").click();
    await page.keyboard.press("End");
    for (let i = 0; i < 3; i++) await page.keyboard.press("ArrowLeft");
    await page.keyboard.press("F12");
    await page.waitForFunction(() => location.hash === "#shore/rules.dol");
    await page.waitForSelector(".cm-line >> text=def ready()");
    await page.goBack();
    await page.waitForSelector(".cm-line >> text=include 'rules.dol'");
  });

  await test("how what is called is called stands above its arguments", async () => {
    await page.locator(".cm-line >> text=execute ready()").click();
    await page.keyboard.press("End");
    await page.keyboard.insertText("\nx = permitted(");
    await page.waitForSelector(".cm-signature >> text=permitted(what)");
    await picture(page, "signature");
    await page.keyboard.press("Escape");
    await page.waitForSelector(".cm-signature", { state: "hidden" });
    await page.keyboard.press("Control+z");
    await page.waitForFunction(() => document.querySelector("#editor-title").textContent);
  });

  await test("what was found of another program says so, and of one that has changed", async () => {
    await page.selectOption("#program", "stuck.dol");
    await page.click("#choice button >> text=Leave it");
    await page.waitForFunction(() => location.hash === "#stuck.dol");
    await page.click("#explore");
    await page.waitForSelector(".verdicts .violated >> text=no deadlock");
    same(await page.locator("#found-exploration .outcome").count(), 0, "it is of this one");
    await choose(page, "targets.dol");
    await page.waitForSelector("#found-exploration >> text=Of stuck.dol.");
    await choose(page, "stuck.dol");
    await page.waitForSelector("#found-exploration .outcome", { state: "detached" });
    await page.click("#tab-source");
    await page.locator(".cm-content").click();
    await page.keyboard.press("Control+Home");
    await page.keyboard.insertText("// Changed.\n");
    await page.keyboard.press("Control+s");
    await page.click("#tab-verdicts");
    await page.waitForSelector("#found-exploration >> text=before it was changed");
    await page.click("#tab-source");
  });

  await test("what is typed as an input stays while the run goes on", async () => {
    await choose(page, "shore/harbour.dol");
    await page.uncheck("#people");
    await page.selectOption("#speed", "60");
    writeFileSync(join(folder, "shore", "harbour.fleet"), "vehicle 'lauv-1', { type 'UUV' }\nplan 'survey', { duration 2.minutes; at 41.19, -8.70 }\nanswer 'May the survey begin?', true\n");
    await page.click("#run");
    await page.fill("#input-crew", "'ash");
    await page.waitForSelector("#now >> text=not yet consume(wind: 'low')");
    same(await page.inputValue("#input-crew"), "'ash", "what was typed");
    await page.keyboard.type("ore'");
    await page.keyboard.press("Enter");
    await page.waitForSelector("#now >> text=crew: 'ashore'");
    await page.fill("#input-wind", "'low'");
    await page.keyboard.press("Enter");
    await over(page);
    await page.check("#people");
  });
}
