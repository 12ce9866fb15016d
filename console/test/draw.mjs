// Drawing: what is set on the map becomes text, literals of the text are moved on the map, and maps are dropped on the page.
import { readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";

export default async function draw({ folder, page, test, same, text, choose, open, picture, home, browser }) {
  writeFileSync(join(folder, "drawn.dol"), `// Before all.
quay = location(41.1850, -8.7060)
basin = polygon([location(41.1840, -8.7080), location(41.1860, -8.7080), quay])
west = location(41.1845, 8.7050.west)
zone = quay ^ 100.m

`);
  const source = () => page.evaluate(() => [...document.querySelector("#editor").shadowRoot.querySelectorAll(".cm-line")].map((l) => l.textContent).join("\n"));
  const handle = (name) => page.locator(`#map .handle[aria-label="${name}"]`);
  const centre = async (l) => { const { x, y, width, height } = await l.boundingBox(); return [x + width / 2, y + height / 2]; };
  const drag = async (l, dx, dy) => {
    const [x, y] = await centre(l);
    await page.mouse.move(x, y);
    await page.mouse.down();
    await page.mouse.move(x + dx / 2, y + dy / 2, { steps: 3 });
    await page.mouse.move(x + dx, y + dy, { steps: 3 });
    await page.mouse.up();
  };
  const fresh = () => page.waitForFunction(() => !document.querySelector("#map.stale"));
  const cursorAtEnd = async () => { await page.locator(".cm-content").click(); await page.keyboard.press("Control+End"); };
  await page.reload();
  await choose(page, "drawn.dol");
  await page.waitForSelector("#map .handle");

  await test("what stands in the program is on the map, and is moved there: the text follows in one step", async () => {
    const before = await source();
    same(await page.locator("#map .handle").count(), 4, "handles: a position, two corners, a radius");
    same(await page.locator("#map .place.of-program >> text=west").count(), 1, "another unit is fixed");
    await page.click("#draw-open");
    // The handles are made again, above the vehicles.
    await page.waitForFunction(() => Number(document.querySelector("#map .handle")?.style.zIndex) > 900);
    await picture(page, "draw");
    await drag(handle("basin: corner 2"), 40, -30);
    await page.waitForFunction((was) => [...document.querySelector("#editor").shadowRoot.querySelectorAll(".cm-line")].map((l) => l.textContent).join("\n") !== was, before);
    const [was, now] = [before, await source()].map((t) => t.split("\n"));
    same(was.filter((l, i) => l !== now[i]).length, 1, "lines that changed");
    const found = /^basin = polygon\(\[location\(41\.1840, -8\.7080\), location\((\S+), (\S+)\), quay\]\)$/.exec(now[2]);
    same(found !== null && /^\d+\.\d{1,7}$/.test(found[1]) && Number(found[1]) > 41.186 && Number(found[2]) > -8.708, true, now[2]);
    await page.locator(".cm-content").click();
    await page.keyboard.press("Control+z");
    same(await source(), before, "undone at once");
    await page.keyboard.press("Control+y");
    await fresh();
  });

  await test("by keyboard, too; and Escape leaves it as it was", async () => {
    const before = await source();
    await handle("quay").focus();
    for (const key of ["ArrowUp", "ArrowUp", "Escape"]) await page.keyboard.press(key);
    same(await source(), before, "left");
    for (const key of ["ArrowUp", "ArrowUp", "Enter"]) await page.keyboard.press(key);
    await page.waitForFunction(() => /^quay = location\(41\.185\d{2,}, -8\.7060\)/m.test(
      [...document.querySelector("#editor").shadowRoot.querySelectorAll(".cm-line")].map((l) => l.textContent).join("\n")));
    await fresh();
    // The handle is made again where the text has it now.
    await page.waitForFunction(() => document.activeElement?.getAttribute("aria-label") === "quay");
  });

  await test("an area is drawn by clicks, at the cursor", async () => {
    await cursorAtEnd();
    await page.click("#draw-kinds >> text=Area");
    const map = await page.locator("#map").boundingBox();
    for (const [x, y] of [[300, 420], [420, 420], [420, 500]]) await page.mouse.click(map.x + x * map.width / 800, map.y + y * map.height / 600);
    same(await text(page, "#draw-count"), "3 points", "points");
    await page.click("#draw-done");
    await page.waitForSelector(".cm-line >> text=area1 = polygon([");
    await page.waitForFunction(() => document.querySelectorAll('#map .handle[aria-label^="area1: corner"]').length === 3);
    await page.waitForSelector("#faults >> text=no errors");
    await picture(page, "drawn");
  });

  await test("a plan is drawn by keyboard, and Cancel writes nothing", async () => {
    await cursorAtEnd();
    const before = await source();
    await page.click("#draw-kinds >> text=Plan");
    await page.keyboard.press("Space");
    await page.click("#draw-cancel");
    same(await source(), before, "cancelled");
    await page.click("#draw-kinds >> text=Plan");
    for (const key of ["Space", "ArrowRight", "Space", "ArrowDown", "Space", "Backspace", "Enter"]) await page.keyboard.press(key);
    await page.waitForSelector(".cm-line >> text=planName 'plan1'");
    await page.waitForFunction(() => document.querySelectorAll('#map .handle[aria-label^="plan1: point"]').length === 2);
    await page.waitForSelector("#faults >> text=no errors");
  });

  await test("a map that is dropped is put into the folder, and into the program", async () => {
    const drop = (name, contents) => page.evaluate(([name, contents]) => {
      const data = new DataTransfer();
      data.items.add(new File([contents], name));
      document.querySelector("#map").dispatchEvent(new DragEvent("drop", { dataTransfer: data, bubbles: true, cancelable: true }));
    }, [name, contents]);
    const buoy = '{"type":"Feature","properties":{"name":"buoy"},"geometry":{"type":"Point","coordinates":[-8.7062,41.185]}}';
    await drop("the-harbour.geojson", buoy);
    await page.waitForSelector(".cm-line >> text=the_harbour = map 'the-harbour.geojson'");
    same(readFileSync(join(folder, "the-harbour.geojson"), "utf8"), buoy, "the file");
    same((await source()).split("\n").slice(0, 2).join("; "), "// Before all.; the_harbour = map 'the-harbour.geojson'", "its line");
    await page.waitForFunction(() => document.querySelector("#layer-list [data-path='the-harbour.geojson'] input:checked"));
    await drop("wrong.gpx", "<gpx><wpt lat='91' lon='0'/></gpx>");
    await page.waitForSelector("#banner >> text=wrong.gpx");
    await drop("huge.gpx", "x".repeat(1024 * 1024 + 1));
    await page.waitForSelector("#banner >> text=by hand");
    await page.evaluate(() => document.querySelector("#layer-list [data-path='the-harbour.geojson'] input").click());
  });

  await test("a phone draws by touch, and nothing is moved by who watches", async () => {
    const phone = await open({ viewport: { width: 390, height: 844 }, isMobile: true, hasTouch: true });
    // The program's places come when its shapes are shown instead, and its circle is on no map.
    await phone.addInitScript(() => {
      const Source = window.EventSource;
      window.EventSource = class extends Source {
        addEventListener(name, f) {
          const later = (e) => document.querySelector("#map .handle") ? f(e) : setTimeout(() => later(e), 20);
          super.addEventListener(name, name === "places" ? later : f);
        }
      };
    });
    await phone.goto(phone.url().replace(/#.*/, "") + "#drawn.dol");
    await phone.reload();
    await phone.tap("#draw-open");
    await phone.waitForSelector("#map .handle");
    await phone.tap("#draw-kinds >> text=Circle");
    same(await phone.evaluate(() => document.documentElement.scrollWidth <= window.innerWidth), true, "it fits");
    const map = await phone.locator("#map").boundingBox();
    await phone.touchscreen.tap(map.x + 120, map.y + map.height - 90);
    await phone.touchscreen.tap(map.x + 160, map.y + map.height - 90);
    await phone.waitForSelector(".cm-line >> text=/\\^ \\d+$/", { state: "attached" });
    await picture(phone, "draw-phone");
    await phone.context().close();
    const watcher = await browser.newContext();
    await watcher.addInitScript(() => {
      const Source = window.EventSource;
      window.EventSource = class extends Source {
        addEventListener(name, f) { super.addEventListener(name, name !== "role" ? f : (e) => f(new MessageEvent("role", { data: e.data.replace('"steers"', '"watches"') }))); }
      };
    });
    const looks = await watcher.newPage();
    await looks.goto(page.url());
    await looks.waitForFunction(() => document.querySelectorAll("#program option").length > 0);
    await choose(looks, "stuck.dol");
    await choose(looks, "drawn.dol");
    await looks.waitForSelector("#map .place.of-program >> text=quay");
    same(await looks.locator("#map .handle").count(), 0, "handles of a watcher");
    same(await looks.locator("#draw-open").isVisible(), false, "Draw of a watcher");
    await watcher.close();
  });

  await page.click("#draw-close");
  await page.click("#save");
  await page.waitForFunction(() => document.querySelector("#save").disabled);
}
