// The map: areas and positions of the program, ways of described plans, own layers, measuring, many vehicles.
import { execFileSync } from "node:child_process";
import { writeFileSync } from "node:fs";
import { join } from "node:path";

// A chart of one level, whose tiles are one red picture.
const mbtiles = `
import base64, sqlite3, sys
db = sqlite3.connect(sys.argv[1])
db.execute("CREATE TABLE metadata (name text, value text)")
db.execute("CREATE TABLE tiles (zoom_level integer, tile_column integer, tile_row integer, tile_data blob)")
db.execute("CREATE UNIQUE INDEX tile_index ON tiles (zoom_level, tile_column, tile_row)")
db.executemany("INSERT INTO metadata VALUES (?, ?)", [("format", "png"), ("minzoom", "14"), ("maxzoom", "14"),
               ("attribution", "<a href='x'>The Harbour Office</a>")])
red = base64.b64decode("iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAYAAAAfFcSJAAAADUlEQVR42mP8z8BQDwAEhQGAhKmMIQAAAABJRU5ErkJggg==")
x, y = 7795, 6131
for column in range(x - 1, x + 3):
    for row in range(y - 1, y + 3):
        db.execute("INSERT INTO tiles VALUES (14, ?, ?, ?)", (column, 2 ** 14 - 1 - row, red))
db.commit()
`;

export default async function maps({ pictures, folder, page, test, same, choose, over, picture, phone }) {
  writeFileSync(join(folder, "charted.dol"), `harbour = Location.APDL
zone = harbour ^ 300.m
basin = polygon([harbour, harbour.displace(0, 300), harbour.displace(200, 300), harbour.displace(200, 0)])
v = pick { type 'UUV' }
input 'over'
execute until { poll over: true } run (imcPlan {
    planName 'lawn'
    skeeping duration: 60.min, location: harbour.displace(150, 150)
}) >> condition { poll never: 1 }
`);
  writeFileSync(join(folder, "charted.fleet"), "vehicle 'lauv-1', { type 'UUV' }\ninput 'over', true\n");
  const point = (name, x, y) => ({ type: "Feature", properties: { name }, geometry: { type: "Point", coordinates: [x, y] } });
  writeFileSync(join(folder, "buoys.geojson"), JSON.stringify({ type: "FeatureCollection",
    features: [point("buoy <b>1</b>", -8.706, 41.186), point("buoy 2", -8.708, 41.187)] }));
  writeFileSync(join(folder, "broken.geojson"), "{");
  writeFileSync(join(folder, "zones.kml"), `<kml><Document><Placemark><name>restricted</name><Polygon><outerBoundaryIs><LinearRing>
    <coordinates>-8.709,41.184 -8.707,41.184 -8.707,41.186 -8.709,41.184</coordinates></LinearRing></outerBoundaryIs></Polygon></Placemark></Document></kml>`);
  execFileSync("python3", ["-c", mbtiles, join(folder, "chart.mbtiles")]);
  writeFileSync(join(folder, "many.dol"), "vs = pick { count 40 }\nexecute task('survey')[vs]\n");
  writeFileSync(join(folder, "many.fleet"), Array.from({ length: 40 }, (_, i) =>
    `vehicle 'vehicle-${i}', { type 'UUV'; at ${(41.185 + (i % 8) * 0.0006).toFixed(4)}, ${(-8.706 + Math.floor(i / 8) * 0.0015).toFixed(4)} }`).join("\n") +
    "\nplan 'survey', { duration 1.min }\n");

  await test("areas and positions of the program stand on the map, and the way of a plan that it describes", async () => {
    await page.reload();
    await choose(page, "charted.dol");
    await page.click("#run");
    for (const name of ["harbour", "zone", "basin"]) await page.waitForSelector(`.of-program >> text=${name}`);
    await page.waitForSelector("#log pre >> text=starts lawn");
    await page.waitForFunction(() => {
      const map = document.querySelector("#map").getBoundingClientRect();
      return [...document.querySelectorAll(".of-program")].every((e) => {
        const { x, y } = e.getBoundingClientRect();
        return x > map.left && x < map.right && y > map.top && y < map.bottom;
      });
    });
    await page.click("#vehicles >> text=lauv-1");
    await page.waitForSelector("text=Follows lauv-1");
    await page.click("text=Follows lauv-1");
    await page.waitForSelector("text=Follows lauv-1", { state: "hidden" });
    await page.click(".map-buttons >> text=All");
    if (pictures && await page.locator("[aria-label='close lauv-1']").isVisible()) await page.click("[aria-label='close lauv-1']");
    await picture(page, "map");
  });

  await test("layers of the folder are shown, and come back when the page is loaded again", async () => {
    await page.click("#layers summary");
    await page.check("#layer-list >> text=buoys.geojson");
    await page.waitForFunction(() => localStorage.getItem("layers") === '["buoys.geojson"]');
    await page.check("#layer-list >> text=broken.geojson");
    await page.waitForSelector("#banner >> text=/broken.geojson: .*line 1/i");
    await page.uncheck("#layer-list >> text=broken.geojson");
    await page.check("#layer-list >> text=zones.kml");
    await page.check("#layer-list >> text=chart.mbtiles");
    await page.waitForSelector("#layer-list >> text=The Harbour Office");
    await page.waitForFunction(() => [...document.querySelectorAll("#map img.leaflet-tile-loaded")].some((i) => i.naturalWidth === 1));
    await picture(page, "layers");
    await page.reload();
    await page.click("#layers summary");
    await page.waitForFunction(() => document.querySelectorAll("#layer-list input:checked").length === 3);
    await page.waitForSelector("#map img.leaflet-tile-loaded");
    await phone("map-phone");
    for (const name of ["chart.mbtiles", "zones.kml", "buoys.geojson"]) await page.uncheck("#layer-list >> text=" + name);
    await page.waitForFunction(() => !document.querySelector("#map img.leaflet-tile"));
    await page.click("#layers summary");
  });

  await test("a distance is measured", async () => {
    await page.click("text=Measure");
    const map = await page.locator("#map").boundingBox();
    await page.mouse.click(map.x + 150, map.y + 250);
    await page.mouse.click(map.x + 250, map.y + 250);
    await page.waitForSelector(".map-button >> text=/^[0-9.]+ k?m, 090°$/");
    await page.keyboard.press("Escape");
    await page.waitForSelector(".map-button >> text=/^Measure$/");
    await page.click("[aria-label='post over: true']");
    await over(page);
  });

  await test("the names of 40 vehicles do not lie upon each other", async () => {
    await choose(page, "many.dol");
    await page.waitForFunction(() => document.querySelectorAll("#map .vehicle .name").length === 40);
    await page.click(".map-buttons >> text=All");
    // How many fit depends on the zoom, which follows from the size of the map.
    const names = () => {
      const shown = [...document.querySelectorAll("#map .vehicle .name")].filter((n) => n.style.visibility !== "hidden" && n.offsetWidth > 0).map((n) => n.getBoundingClientRect());
      const upon = (a, b) => a.left < b.right - 1 && b.left < a.right - 1 && a.top < b.bottom - 1 && b.top < a.bottom - 1;
      const pairs = shown.flatMap((a, i) => shown.slice(i + 1).filter((b) => upon(a, b)).map((b) => [a, b]));
      return { shown: shown.length, pairs, map: document.querySelector("#map").getBoundingClientRect() };
    };
    for (let tries = 0; ; tries++) {
      const { shown, pairs, map } = await page.evaluate(names);
      if (shown >= 10 && pairs.length === 0) break;
      if (tries === 100) throw new Error(`${shown} names on a map of ${JSON.stringify(map)}, upon each other: ${JSON.stringify(pairs.slice(0, 2))}`);
      await page.waitForTimeout(100);
    }
    await picture(page, "many");
  });
}
