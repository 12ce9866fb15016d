// A choice between two things, as a dialog that leaves the rest of the page alive: Stop works while it is open.

import { $, h } from "./dom";

let pending: ((yes: boolean) => void) | null = null;

export function choose(text: string | Node, yes: string, no = "Cancel", kind = "main"): Promise<boolean> {
  const el = $<HTMLDialogElement>("choice"), before = document.activeElement as HTMLElement | null;
  pending?.(false);
  return new Promise((done) => {
    const end = (answer: boolean) => {
      pending = null;
      el.close();
      el.onkeydown = null;
      before?.focus();
      done(answer);
    };
    pending = end;
    const cancel = h("button", { click: () => end(false) }, no);
    el.replaceChildren(typeof text === "string" ? h("p", { id: "choice-text" }, text) : h("div", { id: "choice-text" }, text),
      h("div", { class: "buttons" }, cancel, h("button", { class: kind, click: () => end(true) }, yes)));
    el.onkeydown = (e) => { if (e.key === "Escape") end(false); };
    el.show();
    cancel.focus();  // nothing is done by an Enter that was meant for something else
  });
}
