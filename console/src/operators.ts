// The operators of the console, for an admin: their roles and pages, and a way to end the access of one.

import { get, post, type Operator } from "./api";
import { choose } from "./choice";
import { $, h } from "./dom";

interface Listed { name: string; role: string; duties: string[]; pages: number }

// Whether this page's operator may answer a question for [to], and whether it is asked to.
export const mayAnswer = (me: Operator | null, to: string | null) => to === null || me?.admin === true || isAsked(me, to);
export const isAsked = (me: Operator | null, to: string | null) =>
  to === null || (me !== null && (me.name === to || me.duties.includes(to)));

export class Operators {
  private dialog = $<HTMLDialogElement>("operators");
  private button = $("operators-open");
  private me: Operator | null = null;

  constructor(private attempt: (f: () => Promise<unknown>) => () => void) {
    this.button.addEventListener("click", this.attempt(() => this.open()));
    this.dialog.addEventListener("keydown", (e) => { if (e.key === "Escape") this.dialog.close(); });
  }

  show(me: Operator | null) {
    this.me = me;
    this.button.hidden = !me?.admin;
  }

  private async open() {
    this.draw((await get("operators")).operators);
    if (!this.dialog.open) this.dialog.show();  // not modal: Stop works while it is open
  }

  private draw(all: Listed[]) {
    const shutOut = (o: Listed) => this.attempt(async () => {
      if (await choose(`Shut out ${o.name}? Access ends at once, until the console is started again.`, "Shut out", "Cancel", "danger"))
        this.draw((await post("operators", { shut_out: o.name })).operators);
    });
    const row = (o: Listed) => h("tr", {}, h("td", {}, o.name), h("td", {}, o.role), h("td", {}, o.duties.join(", ")),
      h("td", { class: "number" }, String(o.pages)),
      h("td", {}, o.name === this.me?.name ? "you" : h("button", { "aria-label": "Shut out " + o.name, click: shutOut(o) }, "Shut out")));
    this.dialog.replaceChildren(h("h2", { id: "operators-title" }, "Operators"),
      h("table", {}, h("thead", {}, h("tr", {}, ...["name", "role", "duties", "pages", ""].map((t) => h("th", { scope: "col" }, t)))),
        h("tbody", {}, ...all.map(row))),
      h("div", { class: "buttons" }, h("button", { class: "main", click: () => this.dialog.close() }, "Close")));
  }
}
