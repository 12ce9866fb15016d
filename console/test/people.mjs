// What the page asks of people, and what it does not let them miss: confirm, inputs, alarms.
import { writeFileSync } from "node:fs";
import { join } from "node:path";

export default async function people({ folder, page, test, same, text, choose, over, picture, phone }) {
  writeFileSync(join(folder, "alarms.dol"), `input 'over'
vs = pick { count 3; type 'UUV' }
x = confirm 'Begin now?'
message "begins: $x"
execute until { poll over: true } run (watch task('survey')[vs] onError { ignore() }) >> condition { poll never: 1 }
`);
  writeFileSync(join(folder, "alarms.fleet"), `vehicle 'adamastor', { type 'UUV'; at 41.1850, -8.7060; battery 12.percent }
vehicle 'lauv-seacon-1', { type 'UUV'; at 41.1861, -8.7042; drops 20.seconds, 15.seconds }
vehicle 'lauv-xplore-2', { type 'UUV'; at 41.1838, -8.7051 }
plan 'survey', { duration 30.seconds; fails }
input 'over', true
`);
  writeFileSync(join(folder, "several.dol"), `execute (confirm('Left?') within 1.hour) | confirm('Right?')
x = ask 'How many?'
message x
`);

  await test("confirm has two buttons, and tells where the program asks", async () => {
    await page.reload();
    await choose(page, "alarms.dol");
    await page.selectOption("#speed", "10");
    await page.click("#run");
    await page.waitForSelector("dialog[open] >> text=Begin now?");
    same(await page.locator("#answer").isVisible(), false, "a field");
    same(await text(page, "#where"), "line 3", "the place");
    same(await page.title().then((t) => t.includes("● Begin now?")), true, "the title");
    await picture(page, "confirm");
    await page.click("#later");
    await page.click("#now >> text=Answer");
    await page.click("#choices >> text=No");
    await page.waitForSelector("#log pre >> text=says: begins: false");
  });

  await test("alarms stay until they were seen, also when they have passed", async () => {
    await page.waitForSelector("#alarms li >> text=battery at 12 %");
    await page.waitForSelector("#alarms li:has-text('no link at') >> text=until");
    await page.waitForFunction(() => /▲ [3-9]/.test(document.title));
    await picture(page, "alarms");
    await phone("alarms-phone");
    await page.click("#alarms li:has-text('battery') >> text=Seen");
    await page.waitForFunction(() => !document.querySelector("#alarms").textContent.includes("battery"));
    await page.reload();
    await page.waitForSelector("#alarms li >> text=no link");
    same(await page.locator("#alarms li", { hasText: "battery" }).count(), 0, "what was seen");
    await page.click("#alarms >> text=All seen");
    await page.waitForSelector("#alarms", { state: "hidden" });
    await page.waitForFunction(() => !document.title.includes("▲"));
  });

  await test("an input has a button for each value of the fleet", async () => {
    await page.click("[aria-label='post over: true']");
    await over(page);
  });

  await test("all open questions are in one list, with the time that is left; Later hides none", async () => {
    await choose(page, "several.dol");
    await page.selectOption("#speed", "1");
    await page.click("#run");
    await page.waitForSelector("dialog[open] >> text=Left?");
    await page.click("#later");
    await page.waitForSelector("#now .asks:has-text('Left?') >> text=/59:\\d\\d left/");
    same(await text(page, "#now .asks:has-text('Right?') .left"), "", "no limit");
    same(await page.title().then((t) => t.includes("● 2 questions")), true, "the title");
    await page.click("[aria-label='Yes: Right?']");
    await page.waitForSelector("#now .asks:has-text('Right?')", { state: "detached" });
    await page.click("[aria-label='Yes: Left?']");
    await page.waitForSelector("dialog[open] >> text=How many?");
    await page.fill("#answer", "1 +");
    await page.click("#give");
    await page.waitForSelector("#refused:not(:empty)");
    same(await page.inputValue("#answer"), "1 +", "the refused answer stays");
    await page.fill("#answer", "1 + 1");
    await page.click("#give");
    await page.waitForSelector("#log pre >> text=says: 2");
    await over(page);
  });
}
