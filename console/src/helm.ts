// Who has the helm, as this page sees it: asking, taking, handing over. A change rings and marks the title.

import { post, type Status } from "./api";
import { choose } from "./choice";
import { $, h } from "./dom";
import { mark, ring } from "./title";

const keepEvery = 2000;

export class HelmView {
  private key = "";
  private helm: Status["helm"] | null = null;
  private me = "";
  private gaveUp = false;
  private kept = 0;

  constructor(private attempt: (f: () => Promise<unknown>) => () => void, private tell: (text: string, bad?: boolean) => void) {
    const seen = () => mark("helm", "");
    for (const event of ["pointerdown", "keydown"]) window.addEventListener(event, seen, true);
  }

  mine() { return this.helm !== null && this.helm.holder === this.me; }

  // Something came from the server: the holder answers that it is alive.
  alive() {
    if (!this.mine() || Date.now() - this.kept < keepEvery) return;
    this.kept = Date.now();
    void post("helm", { want: "keep" }, AbortSignal.timeout(5000)).catch(() => {});
  }

  show(helm: Status["helm"] | null, me: string, role: string) {
    const before = this.helm, knew = this.me === me;
    const had = before !== null && knew && before.holder === me;
    this.helm = helm;
    this.me = me;
    if (before && helm && knew) this.notice(before, helm, had);
    this.draw(role);
  }

  private notice(before: Status["helm"], now: Status["helm"], had: boolean) {
    const has = now.holder === this.me;
    if (had && !has && !this.gaveUp) this.say("The helm was taken from this page", `${now.holder ?? "another page"} has taken the helm. Stop works all the same.`);
    else if (!had && has && before.holder !== null) this.say("You have the helm", "You have the helm now.", false);
    else if (has) {
      const asks = now.asking.find((other) => !before.asking.includes(other));
      if (asks) this.say("Somebody asks for the helm", `${asks} asks for the helm.`, false);
    }
    if (!had) this.gaveUp = false;
  }

  private say(title: string, text: string, bad = true) {
    mark("helm", "⚓ " + title);
    ring();
    this.tell(text, bad);
  }

  private want(what: string) {
    return this.attempt(() => {
      this.gaveUp = what === "give-up";
      return post("helm", { want: what });
    });
  }

  private async force() {
    if (await choose("Take the helm by force? The page that has it is told, and commands nothing from then on.", "Take it", "Cancel", "danger"))
      await post("helm", { want: "force" });
  }

  // Buttons stay the same elements until something changes: a press is not lost.
  private draw(role: string) {
    const helm = this.helm, key = JSON.stringify([helm, this.me, role]);
    if (key === this.key) return;
    this.key = key;
    if (role !== "steers") return $("helm").replaceChildren(role === "answers" ? "this link is for answers" : "this link is for watching");
    const mine = this.mine(), asking = helm?.asking.includes(this.me);
    $("helm").replaceChildren(
      !helm || helm.holder === null ? "" : mine ? "you have the helm" : "another page has the helm",
      helm?.holder && !mine && !asking ? h("button", { click: this.want("take") }, "Ask for it") : "",
      asking ? " (asked for)" : "",
      helm?.holder && !mine ? h("button", { click: this.attempt(() => this.force()) }, "Take it") : "",
      mine && helm!.asking.length ? h("button", { class: "main", click: this.want("give-up") }, "Hand it over") : "");
  }
}
