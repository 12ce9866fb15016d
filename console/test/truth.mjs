// What the page shows is what is: simulated or real, how old, of which program.
import { writeFileSync } from "node:fs";
import { join } from "node:path";

export default async function truth({ folder, page, open, test, same, text, choose, over, server, picture }) {
  const many = 6;
  writeFileSync(join(folder, "many.dol"), `input 'over'
vs = pick { count ${many}; type 'UUV' }
setConnectionTimeout vs, 1.hour
n = ask 'How many?'
message "n: $n"
execute until { poll over: true } run task('survey')[vs]
`);
  writeFileSync(join(folder, "many.fleet"), Array.from({ length: many }, (_, i) =>
    `vehicle 'lauv-${i}', { type 'UUV'; drops ${20 + i}.seconds, 1.hour }\n`).join("") + "plan 'survey', { duration 3.hours; at 41.19, -8.70 }\n");
  await page.reload();
  await choose(page, "many.dol");
  await page.selectOption("#speed", "10");

  await test("the page says that all is simulated, in words, colour and title", async () => {
    await page.waitForSelector("#world.simulated >> text=SIMULATED");
    same((await page.title()).includes("SIMULATED"), true, "the title");
  });

  await test("Tab leaves the text and changes nothing; Run and analyses ask before they save", async () => {
    const before = await text(page, ".cm-content");
    await page.locator(".cm-content").focus();
    for (let i = 0; i < 3; i++) await page.keyboard.press("Tab");
    same(await page.evaluate(() => !document.querySelector("#editor").contains(document.activeElement)), true, "the text is left");
    same(await text(page, ".cm-content"), before, "the text");
    same(await page.locator("#save").isDisabled(), true, "nothing to save");
    await page.locator(".cm-content").click();
    await page.keyboard.press("Control+Home");
    await page.keyboard.insertText("// typed\n");
    for (const button of ["#run", "#explore"]) {
      await page.click(button);
      await page.waitForSelector("#choice >> text=is not saved");
      await page.click("#choice button >> text=Cancel");
      same(await page.locator("#save").isDisabled(), false, "still not saved");
    }
    await page.click("#run");
    await page.click("#choice button >> text=Save and run");
    await page.waitForSelector("dialog[open] >> text=How many?");
    same(await page.locator("#save").isDisabled(), true, "saved");
  });

  await test("an answer that is refused stays, to be mended", async () => {
    await page.fill("#answer", "2 + (");
    await page.click("#give");
    await page.waitForFunction(() => document.querySelector("#refused").textContent !== "");
    same(await page.inputValue("#answer"), "2 + (", "the answer");
    await page.fill("#answer", "2 + (1)");
    await page.click("#give");
    await page.waitForSelector("#log pre >> text=n: 3");
  });

  await test("each vehicle has when it was heard last", async () => {
    await page.waitForSelector("#vehicles th >> text=last heard");
    await page.waitForSelector("#vehicles tbody tr >> text=/now|s ago/");
  });

  await test("a page that opens shows the program that runs", async () => {
    const context = await page.context().browser().newContext({ viewport: { width: 1440, height: 900 } });
    const other = await context.newPage();
    await other.goto(new URL("/#stuck.dol", page.url()).href);
    await other.waitForSelector("#link >> text=many.dol");
    await other.waitForFunction(() => location.hash === "#many.dol" && document.querySelector("#program").value === "many.dol");
    await other.waitForSelector(".cm-line >> text=How many?");
    await context.close();
  });

  await test("many alarms of one kind are one line, and silence counts from the last word", async () => {
    await page.waitForSelector(`#alarms li >> text=/${many} vehicles.*no link/`);
    same(await page.locator("#alarms li", { hasText: "no link" }).count(), 1, "lines");
    const since = (await text(page, "#vehicles tbody tr:has-text('lauv-0')")).match(/no link since (\d+):(\d+)/);
    same(since !== null && Number(since[1]) * 60 + Number(since[2]) <= 21, true, `since it was heard last: ${since}`);
    await picture(page, "many");
    await page.click("#alarms li:has-text('vehicles') >> text=Seen");
    await page.waitForSelector("#alarms", { state: "hidden" });
  });

  await test("a server that is silent greys the page within three seconds, and no page has the helm then", async () => {
    await page.waitForSelector("#helm >> text=you have the helm");
    server().kill("SIGSTOP");
    const before = Date.now();
    await page.waitForSelector("body.dead");
    same(Date.now() - before < 3500, true, `after ${Date.now() - before} ms`);
    same(await page.locator("#helm >> text=you have the helm").count(), 0, "the helm");
    await picture(page, "dead");
    server().kill("SIGCONT");
    await page.waitForSelector("body:not(.dead)");
    await page.waitForSelector("#helm >> text=/the helm/");
  });

  await page.click("#stop");
  await over(page);
  await page.selectOption("#speed", "60");
}
