// The button that stops the run: always at the same place, above all else, and the key F8. It works with and without the
// helm, and is repeated until the server has it.

import { Refusal, makeWay, post, type RunStatus } from "./api";
import { $ } from "./dom";

// A double click must not end what the first one has begun.
const guard = 1500;
const patience = 1000;

export class Stop {
  private el = $<HTMLButtonElement>("stop");
  private run: RunStatus | null = null;
  private watches = false;
  private stopped = "";  // the run that this page has stopped, and when
  private since = 0;
  private sending = false;

  constructor(private tell: (text: string) => void) {
    this.el.addEventListener("click", () => void this.press());
    window.addEventListener("keydown", (e) => {
      if (e.key !== "F8" || e.ctrlKey || e.altKey || e.metaKey) return;
      e.preventDefault();
      e.stopPropagation();
      if (!e.repeat) void this.press();
    }, true);
  }

  show(run: RunStatus | null, watches: boolean) {
    this.run = run;
    this.watches = watches;
    this.draw();
  }

  private draw() {
    const state = this.run?.state, going = state === "running" || state === "stopping";
    const guarded = state === "stopping" && this.stopped === this.run!.id && Date.now() - this.since < guard;
    const text = this.sending ? "Stopping…" : state === "stopping" ? "Stop all" : "Stop";
    if (this.el.firstChild!.textContent !== text) this.el.firstChild!.textContent = text;
    this.el.disabled = this.watches || !going || guarded;
    this.el.title = state === "stopping" ? "Ends what the program executes by onInterrupt, too (F8)"
      : "As the program says by onInterrupt; else stops all (F8). With and without the helm.";
    if (guarded) setTimeout(() => this.draw(), guard - (Date.now() - this.since) + 10);
  }

  private async press() {
    if (this.el.disabled || this.sending || !this.run) return;
    const run = this.run.id, all = this.run.state === "stopping";
    this.stopped = run;
    this.since = Date.now();
    this.sending = true;
    this.draw();
    makeWay();
    // Until it is delivered: each try waits for a second at most.
    for (let tries = 1; this.sending; tries++) {
      try { await post("run/stop", { all }, AbortSignal.timeout(patience)); this.sending = false; }
      catch (e) {
        const over = this.run?.id !== run || this.run.state === "over";
        if (e instanceof Refusal || over) { this.sending = false; if (!over) this.tell((e as Error).message); }
        else {
          this.tell(`Stop was not delivered (try ${tries}): the server does not answer. It is sent again.`);
          await new Promise((done) => setTimeout(done, 250));
        }
      }
    }
    this.draw();
  }
}
