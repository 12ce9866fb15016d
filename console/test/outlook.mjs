// What may still happen in a run, on the page: when it is over, and what may go wrong.
import { writeFileSync } from "node:fs";
import { join } from "node:path";

export default async function outlook({ folder, page, test, same, choose, over, pictures }) {
  writeFileSync(join(folder, "twice.dol"), "v = pick { count 1 }\nexecute v: task('survey') >> task('survey')\n");
  const fleet = (more) => writeFileSync(join(folder, "twice.fleet"),
    `vehicle 'a', { type 'UUV' }\nplan 'survey', { duration 1.hour, 90.min${more} }\n`);

  await test("a run says when it will be over, and that only faults can do harm", async () => {
    fleet("");
    await page.reload();
    await choose(page, "twice.dol");
    await page.selectOption("#speed", "10");
    await page.click("#run");
    await page.waitForSelector("#outlook >> text=/over between 2:0\\d:\\d\\d and 3:0\\d:\\d\\d/");
    await page.waitForSelector("#outlook >> text=faults may violate 1 property");
    same(await page.locator("#outlook .trouble").count(), 0, "no trouble");
    await page.waitForSelector("#timeline .ahead");
    if (pictures) await page.screenshot({ path: join(pictures, "outlook.png") });
    await page.click("#stop");
    await over(page);
    await page.waitForFunction(() => document.querySelector("#outlook").textContent === "");
  });

  await test("a run that may fail by its fleet says so", async () => {
    fleet("; mayFail");
    await page.click("#run");
    await page.waitForSelector("#outlook .trouble >> text=may be violated: no unhandled error");
    await page.click("#stop");
    await over(page);
  });

  await test("in real time the end is told by the clock on the wall, and a task that is late is in colour", async () => {
    writeFileSync(join(folder, "twice.dol"), "input 'go'\nv = pick { count 1 }\nexecute v: (task('survey') | condition { consume go: true })\n");
    const has = (duration) => writeFileSync(join(folder, "twice.fleet"),
      `vehicle 'a', { type 'UUV' }\nplan 'survey', { duration ${duration} }\ninput 'go', true, after 2.hours\n`);
    has("1.hour");
    await page.reload();
    await choose(page, "twice.dol");
    await page.selectOption("#speed", "1");
    await page.click("#run");
    await page.waitForSelector("#timeline .task.runs");
    await page.waitForSelector("#outlook >> text=/(over between|over at) (\\w+ )?\\d\\d:\\d\\d/");
    same(await page.locator("#timeline .task.late").count(), 0, "it is not late");
    // The fleet now has the plan shorter than it has been running.
    has("0.5.seconds");
    await page.fill("#input-go", "true");
    await page.keyboard.press("Enter");
    await page.waitForSelector("#timeline .task.late");
    same(await page.locator("#timeline .task.late title").textContent().then((t) => /is late by 0:\d\d: due at 0:0[01]/.test(t)), true, "by how much");
    await page.click("#stop");
    await over(page);
  });
}
