// What is known without running the program: times, faults, the state graph.

export default async function analyses({ page, test, same, text, choose, picture, phone }) {
  await test("time tells when runs and tasks end, and goes through a run that ends last", async () => {
    await choose(page, "rendezvous.dol");
    await page.click("#time");
    await page.waitForSelector("#found-timing >> text=completed: 15:55 to 19:20");
    same(await page.locator(".time-row").count(), 9, "tasks");
    await page.waitForSelector("#found-timing .holds >> text=x8-02: battery: 98.6 % at the least");
    await picture(page, "time");
    await page.click("text=Step through a run that ends last");
    await page.waitForSelector("#banner >> text=A run that ends last");
    same(await text(page, "#step"), "19:20", "its end");
    await page.click("#banner >> text=Back to now");
  });

  await test("a deadline that is missed has a run that shows it, with times", async () => {
    await page.click("#tab-verdicts");
    await page.fill("#deadline", "18.min");
    await page.click("#time");
    await page.waitForSelector("#found-timing .violated >> text=over by 18:00");
    await page.click("#found-timing >> text=Step through a run that is not over at the deadline");
    await page.waitForSelector("#banner >> text=Counterexample: deadline 18:00");
    await page.waitForSelector("#timeline .task");
    await picture(page, "deadline");
    await page.click("#banner >> text=Back to now");
    await page.click("#tab-verdicts");
    await page.fill("#deadline", "never");
    await page.click("#time");
    await page.waitForSelector("#found-timing .trouble");
    await page.fill("#deadline", "");
  });

  await test("faults that may come are explored", async () => {
    await page.fill("#faults-allowed", "fail=1");
    await page.click("#explore");
    await page.waitForSelector("#found-exploration .violated >> text=no unhandled error");
    await page.fill("#faults-allowed", "");
  });

  await test("the state graph is shown, searched, and has a way to each state", async () => {
    await choose(page, "stuck.dol");
    await page.click("#tab-verdicts");
    await page.click("#graph");
    await page.waitForSelector("#graph-dialog[open] circle");
    await page.fill("#graph-find", "done(");
    await page.waitForFunction(() => document.querySelectorAll("circle.found").length > 0);
    await page.keyboard.press("Enter");
    await page.waitForSelector("#graph-state li >> text=done(");
    same(await page.locator(".edges .way").count(), await page.locator("#graph-state ol li").count(), "the way");
    const before = await page.getAttribute("#graph-picture svg", "viewBox");
    await page.click("#graph-in");
    same(await page.getAttribute("#graph-picture svg", "viewBox") === before, false, "the same size");
    await page.click("#graph-all");
    same(await page.getAttribute("#graph-picture svg", "viewBox"), before, "all of it");
    await picture(page, "graph");
    await page.click("#graph-close");
    await choose(page, "rendezvous.dol");
    await page.click("#graph");
    await page.waitForSelector("#found-graph .trouble >> text=more than 300 states");
  });
}
