// The plans of a program and of its fleet: listed, looked at, and drawn on the map before anything runs.
import { writeFileSync } from "node:fs";
import { join } from "node:path";

export default async function plans({ folder, page, test, same, text, choose, picture }) {
  writeFileSync(join(folder, "plans.dol"), `parameter side = 100, 'metres'
v = pick { id 'lauv-1' }
w = pick { id 'lauv-2' }
execute task('survey')[v]
execute v: imcPlan {
    planName 'square'
    speed 1.5, Speed.Units.METERS_PS
    locate Location.APDL
    move side, 0
    goTo()
    move 0, side
    goTo()
    move(-side, 0)
    goTo()
    skeeping duration: 60
}
execute w: imcPlan { planName 'hold'; locate Location.APDL; skeeping() }
`);
  writeFileSync(join(folder, "plans.fleet"), `vehicle 'lauv-1', { type 'UUV'; at 41.1850, -8.7060 }
vehicle 'lauv-2', { type 'UUV'; at 41.1845, -8.7050 }
plan 'survey'
plan 'deep', { only 'lauv-2' }
`);
  // How many stretches the way on the map has.
  const stretches = () => page.evaluate(() => [...document.querySelectorAll("path.sketch")].map((p) => p.getAttribute("d").split("L").length - 1).join());
  const plan = (name) => page.locator("#plans .plans button", { hasText: name });

  await test("the plans that a program gives, and those that each vehicle knows, are listed before anything runs", async () => {
    await page.reload();
    await choose(page, "plans.dol");
    await page.click("#tab-plans");
    await page.waitForSelector("#plans .plans >> text=square");
    same(await page.locator("#plans .plans li").count(), 3, "plans");
    same((await text(page, "#plans .plans li:has-text('survey')")).includes("by name"), true, "it says that it has no way");
    same(await page.locator("#plans .plans li:has-text('survey') button").count(), 0, "buttons of a plan by name");
    same((await page.locator("#plans .known tr").allInnerTexts()).join("; ").replaceAll("\t", " "), "lauv-1 survey; lauv-2 survey, deep", "what they know");
  });

  await test("one that is chosen shows its maneuvers, and its way on the map", async () => {
    same(await stretches(), "", "ways");
    await plan("square").click();
    await page.waitForSelector(".of-plan >> text=1.Goto");
    await page.waitForSelector(".of-plan >> text=3.Goto, 4.StationKeeping");
    same(await stretches(), "4", "stretches of its way");
    same(await page.locator("#plans .plans tbody tr").count(), 4, "maneuvers");
    same((await text(page, "#plans .plans tbody tr:last-child")).includes("1:00"), true, "it stays");
    await page.waitForFunction(() => {
      const map = document.querySelector("#map").getBoundingClientRect();
      return [...document.querySelectorAll(".of-plan")].every((e) => {
        const { x, y } = e.getBoundingClientRect();
        return x > map.left && x < map.right && y > map.top && y < map.bottom;
      });
    });
    await picture(page, "plans");
    await plan("hold").click();
    await page.waitForSelector(".of-plan >> text=1.StationKeeping");
    same(await stretches(), "1", "the other one's");
    await plan("hold").click();
    await page.waitForFunction(() => !document.querySelector("path.sketch") && !document.querySelector(".of-plan"));
  });

  await test("plans follow the text when it is saved, and parameters", async () => {
    await plan("square").click();
    await page.waitForSelector("path.sketch");
    await page.click("#tab-source");
    await page.locator(".cm-content").click();
    await page.keyboard.press("Control+End");
    await page.keyboard.insertText("\nexecute v: imcPlan { planName 'again'; locate Location.APDL; goTo() }\n");
    await page.waitForSelector("#faults >> text=no errors");
    await page.click("#tab-plans");
    await page.waitForSelector("#plans >> text=as it was saved");
    await page.click("#tab-source");
    await page.click("#save");
    // All of it was loaded anew: what was known of plans is forgotten.
    await page.waitForFunction(() => document.querySelector("#plans").textContent === "");
    await page.click("#tab-plans");
    await plan("again").waitFor();
    const before = await text(page, "#plans .plans li:has-text('square')");
    await page.fill("#parameter-side", "300");
    await page.click("#tab-plans");
    await page.waitForFunction((was) => [...document.querySelectorAll("#plans .plans li")].some((l) => l.innerText.includes("square"))
      && ![...document.querySelectorAll("#plans .plans li")].some((l) => l.innerText === was), before);
    await choose(page, "targets.dol");
    await page.waitForFunction(() => !document.querySelector("path.sketch"));
    await page.click("#tab-source");
  });

  await test("fences are on the map before a run, and a plan that breaks one shows where", async () => {
    writeFileSync(join(folder, "fences.dol"), `fence outside location(41.1870, -8.7060) ^ 60
fence depth 12.m
def to(name, metres) { imcPlan { planName name; locate location(41.1850, -8.7060).displace(metres, 0); goTo() } }
v = pick { id 'lauv-1' }
execute to('near', 50)[v]
execute watch to('across', 400)[v] onError { e -> ignore() }
`);
    writeFileSync(join(folder, "fences.fleet"), `vehicle 'lauv-1', { type 'UUV'; at 41.1850, -8.7060 }
fence inside location(41.1850, -8.7060) ^ 1.km
`);
    const fences = async () => [await page.locator("path.fence").count(), (await page.locator(".map-legend li").allInnerTexts()).join("; ")].join(" ");
    const all = "2 fence outside location(41.187, -8.706) ^ 60; fence depth 12.m; fence inside location(41.185, -8.706) ^ 1.km";
    await page.reload();
    await choose(page, "fences.dol");
    await page.waitForSelector(".map-legend >> text=fence depth");
    same(await fences(), all, "fences before the run");
    await page.click("#tab-plans");
    await plan("across").click();
    await page.waitForSelector(".of-breach >> text=breaks a fence");
    same((await text(page, "#plans .plans li:has-text('across')")).includes("breaks fence outside"), true, "it says what is broken");
    same((await text(page, "#plans .plans li:has-text('near')")).includes("breaks"), false, "the other breaks none");
    await picture(page, "fences");
    await page.click("#tab-source");
    await choose(page, "targets.dol");
    await page.waitForFunction(() => document.querySelector(".map-legend").hidden && !document.querySelector("path.fence"));
  });
}
