// Replace: the run that goes on gets another program. The dialog shows what differs and what the check has found, and
// asks once. The server reads the program and explores in processes beside the one that commands.

import { Chunk } from "@codemirror/merge";
import { Text } from "@codemirror/state";
import { type Json, type Status, Refusal, ask, get, post } from "./api";
import { $, h } from "./dom";

interface Wanted { program: string; running: string; faults: string; real: Node | null }
type Check = { state: "asked" | "running"; progress: string } | { state: "cancelled" } | { state: "refused"; why: string } | { state: "over"; found: Json };

const around = 2;  // lines that are shown before and after a difference
const most = 400;

// The lines that differ, with those around them.
function differences(before: string, after: string): Node[] {
  const a = Text.of(before.split("\n")), b = Text.of(after.split("\n"));
  const from = (text: Text, at: number) => text.lineAt(Math.min(at, text.length)).number;
  const shown: Node[] = [];
  const line = (kind: string, number: number, text: string) =>
    shown.push(h("div", { class: kind }, h("span", { class: "line" }, String(number)), kind === "removed" ? "− " : kind === "added" ? "+ " : "  ", text));
  let last = 0;  // the last line of [b] that is shown
  for (const c of Chunk.build(a, b)) {
    const startA = from(a, c.fromA), startB = from(b, c.fromB);
    const endA = c.fromA === c.toA ? startA : from(a, c.endA) + 1, endB = c.fromB === c.toB ? startB : from(b, c.endB) + 1;
    if (shown.length && startB - around > last + 1) shown.push(h("div", { class: "gap" }, "⋯"));
    for (let n = Math.max(last + 1, startB - around); n < startB; n++) line("same", n, b.line(n).text);
    for (let n = startA; n < endA; n++) line("removed", n, a.line(n).text);
    for (let n = startB; n < endB; n++) line("added", n, b.line(n).text);
    last = Math.min(b.lines, endB + around - 1);
    for (let n = endB; n <= last; n++) line("same", n, b.line(n).text);
  }
  return shown.length > most ? [...shown.slice(0, most), h("div", { class: "gap" }, `and ${shown.length - most} more lines`)] : shown;
}

const plural = (n: number, what: string) => `${n} ${what}${n === 1 ? "" : "s"}`;

function verdict(v: Json): Node {
  const steps: string[] = v.run ?? [];
  const after = steps.length > 4 ? `…, ${steps.slice(-4).join(", ")}` : steps.join(", ");
  return h("li", { class: "violated" }, h("b", {}, "✗"), ` ${v.property}: violated`, steps.length ? h("small", {}, ` after ${plural(steps.length, "step")}: ${after}`) : null);
}

export class Replacing {
  private el = $<HTMLDialogElement>("replacement");
  private wanted: Wanted | null = null;
  private texts: { before: string; after: string } | null = null;
  private check: Check = { state: "asked", progress: "" };
  private number = 0;  // replies to an earlier request are late
  private isSent = false;

  constructor(private done: (text: string) => void) {
    this.el.addEventListener("keydown", (e) => { if (e.key === "Escape") this.close(); });
  }

  open(wanted: Wanted) {
    this.wanted = wanted;
    this.texts = null;
    this.isSent = false;
    this.draw();
    this.el.show();
    $("replacement-cancel").focus();
    void this.begin();
  }

  private async begin() {
    const mine = ++this.number, { program, faults } = this.wanted!;
    this.check = { state: "asked", progress: "" };
    this.draw();
    try {
      const texts = await post("run/differences", { program });
      if (mine !== this.number) return;
      this.texts = texts;
      this.draw();
      if (texts.before === texts.after) return;
      await post("replacement", { program, faults: faults || null });
      if (mine !== this.number) return;
      this.check = { state: "running", progress: "" };
      await this.look(mine);
    } catch (e) {
      if (mine !== this.number) return;
      const first = e instanceof Refusal && e.diagnostics[0];
      this.check = { state: "refused", why: (e as Error).message + (first ? ` (line ${first.line}: ${first.message})` : "") };
    }
    this.draw();
  }

  // The check as it is now.
  private async look(mine: number) {
    const found = await get("replacement");
    if (mine !== this.number || this.check.state !== "running") return;
    if (found.program !== this.wanted!.program) this.check = { state: "refused", why: `Another page checks ${found.program}.` };
    else if (found.state === "over") this.check = { state: "over", found };
    else if (found.state === "failed") this.check = { state: "refused", why: found.error };
    else if (found.state === "cancelled") this.check = { state: "cancelled" };
    else this.check.progress = found.progress;
    this.draw();
  }

  status(s: Status) {
    if (!this.wanted) return;
    if (s.run?.state !== "running" && s.run?.state !== "stopping") { this.close(); this.done("The run is over: its program was not replaced."); return; }
    if (this.check.state !== "running") return;
    if (s.replacement?.state !== "running") void this.look(this.number).catch((e) => { this.check = { state: "refused", why: e.message }; this.draw(); });
    else if (this.check.progress !== s.replacement.progress) { this.check.progress = s.replacement.progress; this.draw(); }
  }

  private close() {
    if (this.check.state === "running") void ask("DELETE", "replacement", {}).catch(() => {});
    this.number++;
    this.wanted = null;
    this.el.close();
  }

  private async replace() {
    const { program } = this.wanted!, mine = this.number;
    this.isSent = true;
    this.draw();
    try {
      // Of the text that was checked, and no other one.
      const { hash } = this.check.state === "over" ? this.check.found : await get("replacement");
      await post("run/replace", { program, hash });
      if (mine !== this.number) return;
      this.close();
      this.done(`The run goes on with ${program}.`);
    } catch (e) {
      if (mine !== this.number) return;
      this.isSent = false;
      this.check = { state: "refused", why: (e as Error).message };
      this.draw();
    }
  }

  private draw() {
    const w = this.wanted;
    if (!w) return;
    const focused = document.activeElement?.id;
    const shown = this.texts && differences(this.texts.before, this.texts.after);
    this.el.replaceChildren(
      h("h2", { id: "replacement-title" }, w.running === w.program ? `Replace ${w.program} by its new text` : `Replace ${w.running} by ${w.program}`),
      w.real ?? "",
      h("div", { id: "differences", tabindex: 0, role: "region", "aria-label": "What differs" },
        ...(shown === null ? [h("p", { class: "empty" }, "…")] : shown.length ? shown : [h("p", { class: "empty" }, "Nothing differs from the program of the run.")])),
      h("div", { id: "checked", role: "status" }, ...this.found()),
      h("div", { class: "buttons" }, h("button", { id: "replacement-cancel", click: () => this.close() }, "Cancel"), ...this.buttons(w)));
    if (focused && this.el.open) document.getElementById(focused)?.focus();
  }

  private found(): Node[] {
    const c = this.check, with_ = this.wanted!.faults ? `, with faults ${this.wanted!.faults}` : "";
    if (this.texts && this.texts.before === this.texts.after) return [];
    switch (c.state) {
      case "asked": return [h("p", { class: "hint" }, "The past of the run is compared with the new program …")];
      case "running": return [h("p", { class: "hint" }, `The run so far is the beginning of a run of the new program. All that may follow is explored${with_} … ${c.progress}`)];
      case "cancelled": return [h("p", { class: "trouble" }, "The check was cancelled: what may follow is not known.")];
      case "refused": return [h("pre", { class: "trouble" }, c.why)];
      case "over": {
        const { outcome, result } = c.found, violated = result.verdicts.filter((v: Json) => v.verdict === "violated");
        const of = `${plural(result.states, "state")}${with_}`;
        const text = outcome === "holds" ? `✓ All that may follow was explored: ${of}. No property is violated.`
          : outcome === "violated" ? `✗ What may follow can go wrong (${of}):` : `– Only a part of what may follow was explored (${of}); nothing goes wrong there.`;
        return [h("p", { class: outcome === "holds" ? "holds" : "trouble" }, text), violated.length ? h("ul", { class: "verdicts" }, ...violated.map(verdict)) : h("span")];
      }
    }
  }

  private buttons(w: Wanted): Node[] {
    const c = this.check, on = w.real ? " on REAL vehicles" : "";
    const replace = (text: string, kind: string) =>
      h("button", { id: "replacement-replace", class: kind, disabled: this.isSent, click: () => void this.replace() }, text + on);
    switch (c.state) {
      case "asked": return [];
      case "running": return [h("button", { id: "replacement-unchecked", click: () => void ask("DELETE", "replacement", {}).then(() => this.look(this.number)) }, "Cancel the check")];
      case "cancelled": return [replace("Replace without the check", "danger")];
      case "refused": return [h("button", { id: "replacement-again", click: () => void this.begin() }, "Check again")];
      case "over": return [c.found.outcome === "holds" ? replace("Replace", w.real ? "danger" : "main") : replace("Replace all the same", "danger")];
    }
  }
}
