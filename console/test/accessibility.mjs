// axe finds nothing serious in what a newcomer sees, light and dark; all is done by keyboard; the page prints.
import { readFileSync } from "node:fs";
import { createRequire } from "node:module";

const axe = readFileSync(createRequire(import.meta.url).resolve("axe-core/axe.min.js"), "utf8");

export async function serious(page) {
  // The page's policy forbids scripts of others; what the browser is told to evaluate it does not ask for.
  await page.evaluate(axe);
  const found = await page.evaluate(() => window.axe.run(document, { resultTypes: ["violations"] }));
  return found.violations.filter((v) => v.impact === "serious" || v.impact === "critical")
    .map((v) => `${v.id}: ${v.nodes.slice(0, 3).map((n) => n.target.join(" ") + " " + (n.any[0]?.message ?? "")).join("; ")}`).join("\n");
}

// Whoever takes longer than five seconds to load a page again has lost the helm.
const takeHelm = (page) => page.evaluate(() => fetch("/api/helm", {
  method: "POST", body: JSON.stringify({ want: "take" }),
  headers: { "Content-Type": "application/json", "X-Dolphin-Client": sessionStorage.getItem("client") },
}));

export default async function accessibility({ page: holder, open, test, same, choose, pictures }) {
  await takeHelm(holder);
  for (const colorScheme of ["light", "dark"]) {
    const page = await open({ colorScheme });
    await page.click("#helm >> text=Ask for it");
    await holder.click("#helm >> text=Hand it over");
    await page.waitForSelector("#helm >> text=you have the helm");
    holder = page;
    const sees = async (what, f) => test(`axe finds nothing serious: ${what}, ${colorScheme}`, async () => {
      await f();
      same(await serious(page), "", "found");
    });
    await sees("a program", async () => {
      await choose(page, "rendezvous.dol");
      await page.waitForSelector(".cm-line >> text=Radius of operation area");
    });
    await sees("verdicts and times", async () => {
      await page.click("#tab-verdicts");
      await page.click("#explore");
      await page.waitForSelector("#found-exploration .holds");
      await page.click("#time");
      await page.waitForSelector(".times");
    });
    await sees("plans, one of them drawn", async () => {
      await choose(page, "plans.dol");
      await page.click("#tab-plans");
      await page.click("#plans .plans >> text=square");
      await page.waitForSelector(".of-plan >> text=1.Goto");
    });
    await sees("a run that was, and its end", async () => {
      await page.click("#tab-runs");
      await page.click("#runs tr:has-text('alarms.dol') >> text=Replay");
      await page.waitForSelector("#timeline .task");
      await page.waitForSelector("#log pre");
      await page.click("#banner >> text=Back to now");
    });
    await sees("the state graph", async () => {
      await choose(page, "stuck.dol");
      await page.click("#tab-verdicts");
      await page.click("#graph");
      await page.waitForSelector("#graph-dialog[open] circle");
    });
    await page.keyboard.press("Escape");
    await sees("a question and alarms", async () => {
      await choose(page, "alarms.dol");
      await page.click("#run");
      await page.waitForSelector("dialog[open] >> text=Begin now?");
      await page.waitForSelector("#alarms li");
    });
    await test(`a question is put off, opened and answered by keyboard, ${colorScheme}`, async () => {
      await page.keyboard.press("Escape");
      await page.waitForSelector("#question", { state: "hidden" });
      await page.focus("#now .asks button.main");
      await page.keyboard.press("Enter");
      await page.waitForSelector("#question[open]");
      await page.keyboard.press("Shift+Tab");
      await page.keyboard.press("Enter");
      await page.waitForSelector("#log pre >> text=says: begins: false");
      await page.click("#stop");
      await page.waitForSelector(".outcome.interrupted");
    });
    if (colorScheme === "light") await test("the page prints: its panels one below the other, without buttons", async () => {
      await page.emulateMedia({ media: "print" });
      same(await page.locator("#run").isVisible(), false, "a button");
      same(await page.evaluate(() => document.documentElement.scrollWidth <= window.innerWidth), true, "it fits");
      same(await page.evaluate(() => getComputedStyle(document.querySelector("#log")).overflowY), "visible", "the log is whole");
      same(await page.evaluate(() => document.querySelector("#map").clientHeight > 300), true, "the map is there");
      if (pictures) await page.screenshot({ path: `${pictures}/print.png`, fullPage: true });
      await page.emulateMedia({ media: "screen" });
    });
  }
}
