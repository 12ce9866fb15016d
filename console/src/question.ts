// The dialog of the question that the program asks. Yes and No for confirm.

import type { Question } from "./api";
import { $, h } from "./dom";

export interface Answer { question: number; text: string }

export class Dialog {
  private question: Question | null = null;
  private given = "";  // the answer that was given last
  private key = "";  // of the question that was opened last: put off, it stays closed
  private el = $<HTMLDialogElement>("question");
  private field = $<HTMLInputElement>("answer");

  constructor(private give: (a: Answer) => void, private goTo: (at: string) => void) {
    $("give").addEventListener("click", (e) => { e.preventDefault(); this.answer(this.field.value.trim()); });
    $("later").addEventListener("click", () => this.el.close());
    this.el.addEventListener("keydown", (e) => { if (e.key === "Escape") this.el.close(); });
  }

  // The question there is now, of this run. One for another operator does not open by itself.
  show(run: string, q: Question | null, isAsked: boolean) {
    this.question = q;
    const key = q ? `${run}/${q.number}` : "";
    if (!q) this.el.close();
    else if (key !== this.key) { if (isAsked) this.open(); else this.el.close(); }
    this.key = key;
  }

  open() {
    const q = this.question;
    if (!q) return;
    const truth = q.kind === "truth";
    $("prompt").textContent = q.prompt;
    $("where").replaceChildren(q.at ? h("button", { type: "button", class: "link", click: () => this.goTo(q.at!) }, `line ${q.at.split(":")[0]}`) : "");
    $("refused").textContent = q.refused ?? "";
    $("free").hidden = $("hint").hidden = $("give").hidden = truth;
    $("choices").hidden = !truth;
    $("choices").replaceChildren(...(truth ? [["Yes", "true"], ["No", "false"]] : []).map(([name, text]) =>
      h("button", { type: "button", class: "main", click: () => this.answer(text) }, name)));
    this.field.value = q.refused ? this.given : "";  // to be mended
    if (!this.el.open) this.el.show();  // not modal: Stop works while it is open
    // Enter by chance gives neither yes nor no.
    (truth ? $("later") : this.field).focus();
  }

  private answer(text: string) {
    this.given = text;
    if (this.question && text) this.give({ question: this.question.number, text });
  }
}
