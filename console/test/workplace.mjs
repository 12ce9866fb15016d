// The page as a workplace: the panel of a vehicle, layouts, sizes and hidden panels that are kept, arrows to vehicles out of
// view, and a phone.
import { writeFileSync } from "node:fs";
import { join } from "node:path";

const small = { viewport: { width: 360, height: 640 }, isMobile: true, hasTouch: true };

// Of the things one presses that are on the page, those below 44 pixels in width or height.
const tooSmall = (page) => page.evaluate(() => [...document.querySelectorAll("button, select, summary, input, [role=tab]")]
  .filter((e) => e.checkVisibility() && !e.closest(".cm-editor"))
  .map((e) => ({ e, box: (e.type === "checkbox" ? e.closest("label") : e).getBoundingClientRect() }))
  .filter(({ box }) => box.width > 0 && (box.width < 43.5 || box.height < 43.5))
  .map(({ e, box }) => `${e.id || e.outerHTML.slice(0, 80)}: ${Math.round(box.width)} x ${Math.round(box.height)}`).join("\n"));

export default async function workplace({ folder, page, open, test, same, text, choose, over, picture, pictures }) {
  writeFileSync(join(folder, "work.dol"), `input 'over'
x = confirm 'Begin now?'
vs = pick { count 2; type 'UUV' }
execute until { poll over: true } run task('survey')[vs[0]]
`);
  writeFileSync(join(folder, "work.fleet"), `vehicle 'adamastor', { type 'UUV'; at 41.1850, -8.7060; battery 80.percent; drain 30.percent }
vehicle 'lauv-xplore-2', { type 'UUV'; at 41.1838, -8.7051 }
plan 'survey', { duration 3.hours; at 41.25, -8.60 }
`);
  await page.reload();
  await choose(page, "work.dol");
  await page.selectOption("#speed", "60");
  await page.click("#run");
  await page.click("#choices >> text=Yes");
  await page.waitForSelector("#timeline .task");

  await test("a vehicle's panel has its link, battery, speed, course, task and plots", async () => {
    await page.click("#vehicles button >> text=adamastor");
    await page.waitForSelector("#vehicle:not([hidden]) >> text=survey");
    await page.waitForFunction(() => document.querySelectorAll("#vehicle .plots tr").length >= 1);
    for (const what of ["link", "battery", "position"]) await page.waitForSelector(`#vehicle dt >> text=${what}`);
    await page.waitForSelector("#vehicle dt >> text=course");
    same(await page.locator("#vehicle .plot").first().getAttribute("aria-label").then((t) => /^battery: from \d/.test(t)), true, "the plot's name");
    await page.waitForFunction(() => /% an hour/.test(document.querySelector("#vehicle").innerText));
    await picture(page, "vehicle");
  });

  await test("the panel has the vehicle's silence, and what the program waits for", async () => {
    await page.click("#vehicles button >> text=lauv-xplore-2");
    await page.waitForSelector("#vehicle .of-vehicle >> text=/Bound. The program waits for poll over/");
    await page.click("[aria-label='close lauv-xplore-2']");
    await page.waitForSelector("#vehicle", { state: "hidden" });
  });

  await test("the map fits as vehicles move; one out of view has an arrow, which leads to it", async () => {
    await page.click(".map-button >> text=All");
    const inView = () => page.evaluate(() => { const map = document.querySelector("#map").getBoundingClientRect();
      return [...document.querySelectorAll("#map .vehicle")].every((v) => { const b = v.getBoundingClientRect(); return b.x > map.x && b.x < map.right && b.y > map.y && b.y < map.bottom; }); });
    await page.waitForTimeout(4000);
    same(await inView(), true, "all are in view");
    same(await page.locator(".map-arrows button").count(), 0, "arrows");
    const box = await page.locator("#map").boundingBox();
    await page.mouse.move(box.x + box.width / 2, box.y + box.height / 2);
    for (let i = 0; i < 8; i++) { await page.mouse.down(); await page.mouse.move(box.x + 20, box.y + box.height / 2); await page.mouse.up(); await page.mouse.move(box.x + box.width - 30, box.y + box.height / 2); }
    await page.waitForSelector(".map-arrows [data-vehicle='adamastor']");
    await picture(page, "arrows");
    await page.focus(".map-arrows [data-vehicle='adamastor']");
    await page.keyboard.press("Enter");
    await page.waitForSelector(".map-button >> text=Follows adamastor");
    await page.waitForSelector(".map-arrows [data-vehicle='adamastor']", { state: "detached" });
    await page.click(".map-button >> text=Fleet");
    await page.waitForFunction(() => document.querySelectorAll(".map-arrows button").length === 0);
    await page.click("[aria-label='close adamastor']");
  });

  await test("layouts, hidden panels and sizes are kept by the browser", async () => {
    const width = async (id) => (await page.locator(id).boundingBox()).width;
    const before = await width("#map-panel");
    await page.selectOption("#layout", "run");
    same(await page.locator("#editor-panel").isVisible(), false, "the program, in a run");
    same(await width("#map-panel") > 1.5 * before, true, "the map is large");
    await picture(page, "layout-run");
    await page.focus("[role=separator][aria-orientation=vertical]");
    const first = await width("#map-panel");
    await page.keyboard.press("ArrowLeft");
    await page.keyboard.press("ArrowLeft");
    const second = await width("#map-panel");
    same(second < first - 50, true, `smaller: ${first} ${second}`);
    await page.click("#panels-menu summary");
    await page.uncheck("#panels label:has-text('Log') input");
    await page.click("#panels-menu summary");
    await page.reload();
    await page.waitForSelector("#timeline .task");
    same(await page.inputValue("#layout"), "run", "the layout");
    same(await width("#map-panel"), second, "the size");
    same(await page.locator("#log-panel").isVisible(), false, "the hidden panel");
    await page.selectOption("#layout", "review");
    same(await page.locator("#log-panel").isVisible(), true, "in another layout");
    await picture(page, "layout-review");
    await page.selectOption("#layout", "run");
    const bar = await page.locator("[role=separator][aria-orientation=vertical]").first().boundingBox();
    await page.mouse.move(bar.x + 4, bar.y + 60);
    await page.mouse.down();
    await page.mouse.move(bar.x + 104, bar.y + 60, { steps: 4 });
    await page.mouse.up();
    same(Math.abs(await width("#map-panel") - second - 100) < 4, true, `dragged: ${second} ${await width("#map-panel")}`);
    await page.click("#panels-menu summary");
    await page.click("#layout-usual");
    await page.click("#panels-menu summary");
    same(await page.locator("#log-panel").isVisible(), true, "as usual");
    same(Math.abs(await width("#map-panel") - first) < 1, true, "its size");
    await page.selectOption("#layout", "plan");
  });

  await test("panels exchange their places by the arrow keys and by dragging, kept by the browser", async () => {
    const place = async (id) => { const { x, y } = await page.locator(id).boundingBox(); return `${Math.round(x)} ${Math.round(y)}`; };
    const [map, now, log] = [await place("#map-panel"), await place("#now-panel"), await place("#log-panel")];
    await page.focus("[aria-label='Move Map']");
    await page.keyboard.press("ArrowRight");
    same((await place("#now-panel")).split(" ")[1], map.split(" ")[1], "the row");
    same(await page.evaluate(() => document.activeElement.getAttribute("aria-label")), "Move Map", "the focus stays");
    same(parseInt(await place("#map-panel")) > parseInt(await place("#now-panel")), true, "the map is on the right");
    await page.keyboard.press("ArrowDown");
    same(await place("#log-panel") === now || parseInt((await place("#map-panel")).split(" ")[1]) > parseInt(now.split(" ")[1]), true, "and below");
    await page.reload();
    await page.waitForSelector("#timeline .task");
    same(parseInt((await place("#map-panel")).split(" ")[1]), parseInt(log.split(" ")[1]), "also after a reload");
    const middle = async (id) => { const b = await page.locator(id).boundingBox(); return [b.x + b.width / 2, b.y + b.height / 2]; };
    const before = await place("#vehicles-panel");
    await page.mouse.move(...await middle("[aria-label='Move Map']"));
    await page.mouse.down();
    await page.mouse.move(...await middle("#vehicles-panel"), { steps: 3 });
    same(await page.locator("#vehicles-panel.target").count(), 1, "it is marked");
    await page.mouse.up();
    same(await place("#map-panel"), before, "dragged");
    await picture(page, "moved");
    await page.click("#panels-menu summary");
    await page.click("#layout-usual");
    await page.click("#panels-menu summary");
    same(await place("#map-panel"), map, "as usual");
  });

  for (const colorScheme of ["light", "dark"]) await test(`on a phone the layout is that of a run, and all that one presses has 44 pixels, ${colorScheme}`, async () => {
    const phone = await open({ ...small, colorScheme });
    await phone.waitForSelector("#timeline .task");
    same(await phone.inputValue("#layout"), "run", "the layout");
    same(await phone.locator("#editor-panel").isVisible(), false, "the program");
    same(await phone.evaluate(() => document.documentElement.scrollWidth <= window.innerWidth), true, "it fits");
    same(await tooSmall(phone), "", "too small");
    const stop = await phone.locator("#stop").boundingBox();
    same((await phone.locator("#now-panel").boundingBox()).y < 400, true, "what it asks and waits for is in sight");
    same(stop.y >= 0 && stop.y + stop.height <= 640 && stop.x + stop.width <= 360, true, "Stop is in sight");
    await phone.evaluate(() => window.scrollTo(0, 1200));
    same((await phone.locator("#stop").boundingBox()).y, stop.y, "also below");
    await phone.evaluate(() => window.scrollTo(0, 0));
    await phone.locator("#vehicles button >> text=adamastor").tap();
    await phone.waitForSelector("#vehicle:not([hidden])");
    same(await tooSmall(phone), "", "too small, with a vehicle's panel");
    if (pictures) await phone.screenshot({ path: join(pictures, `phone-${colorScheme}.png`), fullPage: true });
    await phone.context().close();
  });

  for (const [name, width, height] of [["large", 1920, 1080], ["tablet", 820, 1180]])
    for (const colorScheme of ["light", "dark"]) await test(`it fits ${name}, ${colorScheme}`, async () => {
      const other = await open({ viewport: { width, height }, colorScheme });
      await other.selectOption("#layout", "run");
      await other.waitForSelector("#timeline .task");
      await other.click("#vehicles button >> text=adamastor");
      await other.waitForSelector("#vehicle:not([hidden]) .plot");
      same(await other.evaluate(() => document.documentElement.scrollWidth <= window.innerWidth), true, "its width");
      if (pictures) await other.screenshot({ path: join(pictures, `${name}-${colorScheme}.png`) });
      await other.context().close();
    });

  await test("a question is answered, and the run stopped, on a phone", async () => {
    await page.fill("#input-over", "true");
    await page.keyboard.press("Enter");
    await over(page);
    await page.click("#run");
    const phone = await open(small);
    await phone.waitForSelector("dialog[open] >> text=Begin now?");
    same(await tooSmall(phone), "", "too small, in a question");
    if (pictures) await phone.screenshot({ path: join(pictures, "phone-question.png") });
    await phone.tap("#later");
    await phone.tap("#stop");
    await page.waitForSelector(".outcome.interrupted");
    await phone.context().close();
  });

  await test("a vehicle is commanded from its panel: it is held, and goes on where it was", async () => {
    writeFileSync(join(folder, "steered.dol"), `include 'prelude'
input 'hold', 'goOn', 'abort', of: 'vehicle'
way = imcPlan { planName 'lane'; locate 41.185, -8.706; goTo speed: 0.5; locate 41.205, -8.706; goTo speed: 0.5 }
vs = pick { type 'UUV'; count 2 }
execute par((0..1).collect { n -> commanded(vs[n], way) })
`);
    writeFileSync(join(folder, "steered.fleet"), "vehicle 'boat-1', { type 'UUV'; at 41.185, -8.706 }\nvehicle 'boat-2', { type 'UUV'; at 41.185, -8.707 }\n");
    await page.reload();
    await choose(page, "steered.dol");
    await page.selectOption("#speed", "10");
    await page.click("#run");
    await page.waitForSelector("#timeline .task");
    await page.click("#vehicles button >> text=boat-1");
    await page.waitForSelector("#command-abort");
    same(await page.locator("#vehicle .commands button").allInnerTexts().then((t) => t.join()), "hold,goOn,abort", "the commands that the program takes");
    await page.click("#command-hold");
    await page.waitForSelector("#log pre >> text=boat-1 stops lane");
    await page.waitForSelector("#vehicle .of-vehicle >> text=/Last: lane, stopped/");
    await picture(page, "commands");
    await page.focus("#command-goOn");
    await page.keyboard.press("Enter");
    await page.waitForFunction(() => document.querySelector("#log").innerText.match(/boat-1\s+starts lane/g)?.length === 2);
    same(await page.evaluate(() => document.activeElement.id), "command-goOn", "the focus stays");
    same(await page.locator("#log pre >> text=boat-2 stops").count(), 0, "stops of the other vehicle");
    await page.click("#command-abort");
    await page.waitForSelector("#log pre >> text=aborted by command");
    await over(page);
    same(await page.locator("#vehicle .commands").count(), 0, "commands after the end");
    await page.click("[aria-label='close boat-1']");
  });

  await test("vehicles near each other are one marker, which leads to them", async () => {
    const spots = Array.from({ length: 6 }, (_, i) => `vehicle 'near-${i}', { type 'UUV'; at ${41.185 + i * 2e-5}, -8.706${i % 2 ? "; battery 5.percent" : ""} }`);
    const same_ = Array.from({ length: 4 }, (_, i) => `vehicle 'same-${i}', { type 'UUV'; at 41.2, -8.7 }`);
    writeFileSync(join(folder, "crowd.fleet"), [...spots, ...same_, "vehicle 'far', { type 'UUV'; at 41.25, -8.6 }", "plan 'survey'"].join("\n") + "\n");
    writeFileSync(join(folder, "crowd.dol"), "v = pick { type 'UUV' }\nexecute task('survey')[v]\n");
    await page.reload();
    await choose(page, "crowd.dol");
    await page.waitForFunction(() => [...document.querySelectorAll("#map .cluster")].map((c) => c.innerText).sort().join() === "4,6");
    same(await page.evaluate(() => [...document.querySelectorAll("#map .vehicle")].filter((v) => v.style.display !== "none").map((v) => v.title.split(",")[0]).join()), "far", "another one stands alone");
    await page.waitForSelector("#map .cluster.bad >> text=6");
    await picture(page, "clusters");
    await page.locator("#map .cluster", { hasText: "6" }).press("Enter");
    await page.waitForFunction(() => [...document.querySelectorAll("#map .vehicle")].filter((v) => v.title.startsWith("near-") && v.style.display !== "none").length === 6);
    await page.click(".map-button >> text=All");
    // Those at one place cannot be taken apart: they are listed.
    for (let i = 0; i < 12 && !await page.locator(".cluster-list").count(); i++) await page.locator("#map .cluster", { hasText: "4" }).press("Enter");
    await page.click(".cluster-list >> text=same-2");
    await page.waitForSelector("#vehicle:not([hidden]) >> text=same-2");
    await page.waitForSelector(".map-button >> text=Follows same-2");
    await page.click("[aria-label='close same-2']");
  });
}
