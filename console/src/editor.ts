// The editor: colours, faults as one types, completion, what a name is. All that it knows the server's language service
// says.

import { EditorState, StateEffect, StateField } from "@codemirror/state";
import { Decoration, type DecorationSet, EditorView, type Tooltip, closeHoverTooltips, hoverTooltip, keymap, showTooltip, lineNumbers, highlightActiveLine, drawSelection } from "@codemirror/view";
import { defaultKeymap, history, historyKeymap, isolateHistory } from "@codemirror/commands";
import { StreamLanguage, HighlightStyle, syntaxHighlighting, bracketMatching, indentUnit } from "@codemirror/language";
import { linter, lintGutter, lintKeymap } from "@codemirror/lint";
import { autocompletion, closeCompletion, completionKeymap, type CompletionContext } from "@codemirror/autocomplete";
import { search, searchKeymap, highlightSelectionMatches } from "@codemirror/search";
import { tags } from "@lezer/highlight";
import { type Diagnostic, post } from "./api";
import { constants as constantNames, words as listed } from "./words";

const words = new Set([...listed, "include", "vehicle", "plan", "answer", "reply"]);
const constants = new Set([...constantNames, "_"]);

const language = StreamLanguage.define<{ block: boolean }>({
  name: "dolphin",
  startState: () => ({ block: false }),
  token(s, state) {
    if (state.block) {
      if (s.skipTo("*/")) { s.match("*/"); state.block = false; } else s.skipToEnd();
      return "comment";
    }
    if (s.eatSpace()) return null;
    if (s.match("//")) { s.skipToEnd(); return "comment"; }
    if (s.match("/*")) { state.block = true; return "comment"; }
    if (s.match(/^'(?:[^'\\]|\\.)*'?/) || s.match(/^"(?:[^"\\]|\\.)*"?/)) return "string";
    if (s.match(/^\d+(\.\d+)?/)) return "number";
    if (s.match(/^[A-Za-z_]\w*/)) {
      const word = s.current();
      return words.has(word) ? "keyword" : constants.has(word) ? "atom" : /^[A-Z]/.test(word) ? "typeName" : "variableName";
    }
    s.next();
    return "operator";
  },
  languageData: { commentTokens: { line: "//", block: { open: "/*", close: "*/" } }, closeBrackets: { brackets: ["(", "[", "{", "'", '"'] } },
});

const colours = HighlightStyle.define([
  { tag: tags.keyword, color: "var(--code-keyword)", fontWeight: "600" },
  { tag: tags.string, color: "var(--code-string)" },
  { tag: tags.comment, color: "var(--code-comment)", fontStyle: "italic" },
  { tag: tags.number, color: "var(--code-number)" },
  { tag: tags.atom, color: "var(--code-number)" },
  { tag: tags.typeName, color: "var(--code-type)" },
]);

const look = EditorView.theme({
  "&": { height: "100%", fontSize: "13px", color: "var(--text)", backgroundColor: "var(--panel)" },
  ".cm-scroller": { fontFamily: "ui-monospace, 'DejaVu Sans Mono', monospace" },
  ".cm-gutters": { backgroundColor: "var(--panel)", color: "var(--faint)", border: "none" },
  ".cm-activeLine": { backgroundColor: "var(--hover)" },
  ".cm-content": { caretColor: "var(--text)" },
  ".cm-cursor": { borderLeftColor: "var(--text)" },
  "&.cm-focused .cm-selectionBackground, .cm-selectionBackground": { backgroundColor: "var(--select) !important" },
  ".cm-tooltip": { backgroundColor: "var(--panel)", color: "var(--text)", border: "1px solid var(--line)", maxWidth: "32rem" },
  ".cm-tooltip .hover": { padding: "4px 8px", whiteSpace: "pre-wrap" },
  ".cm-signature": { padding: "2px 8px" },
  ".cm-here": { backgroundColor: "var(--here)" },
  ".cm-panels": { backgroundColor: "var(--panel)", color: "var(--text)" },
  ".cm-tooltip-autocomplete ul li[aria-selected]": { backgroundColor: "var(--accent)", color: "#fff" },
});

// The line that the program stands at.
const setHere = StateEffect.define<number | null>();
const here = StateField.define<DecorationSet>({
  create: () => Decoration.none,
  update(shown, tr) {
    shown = shown.map(tr.changes);
    for (const e of tr.effects) if (e.is(setHere)) {
      const n = e.value;
      shown = n === null || n < 1 || n > tr.state.doc.lines ? Decoration.none
        : Decoration.set([Decoration.line({ class: "cm-here" }).range(tr.state.doc.line(n).from)]);
    }
    return shown;
  },
  provide: (f) => EditorView.decorations.from(f),
});

// How what is called is called, above the place where its arguments are written; Escape hides it until the next one.
type Signature = Tooltip & { form: string };
const setSignature = StateEffect.define<Signature | null>();
const shownSignature = StateField.define<Signature | null>({
  create: () => null,
  update(shown, tr) {
    for (const e of tr.effects) if (e.is(setSignature)) return e.value;
    return shown && tr.docChanged ? { ...shown, pos: tr.changes.mapPos(shown.pos) } : shown;
  },
  provide: (f) => showTooltip.from(f),
});

type Asked = (path: string, text: string, at: number) => Promise<{ form: string; text: string } | null>;

function signature(ask: Asked, path: () => string) {
  let number = 0, hidden = "";
  const show = async (view: EditorView) => {
    const mine = ++number, at = view.state.selection.main.head, { doc } = view.state;
    // Not for a text that was opened or changed meanwhile.
    const isOver = () => mine !== number || view.state.doc !== doc;
    await new Promise((done) => setTimeout(done, 150));
    if (isOver() || !path()) return;
    const found = await ask(path(), doc.toString(), at).catch(() => null);
    if (isOver()) return;
    if (found?.form !== hidden) hidden = "";
    const wanted = found && !hidden && view.hasFocus ? found : null;
    if (!wanted && !view.state.field(shownSignature)) return;
    view.dispatch({ effects: setSignature.of(wanted && { form: wanted.form, pos: Math.min(at, view.state.doc.length), above: true, create: () => {
      const dom = document.createElement("div"), form = document.createElement("b");
      dom.className = "cm-signature";
      form.textContent = wanted.form;
      dom.append(form, " " + wanted.text);
      return { dom };
    } }) });
  };
  return [shownSignature,
    // Where one types, and not wherever one looks.
    EditorView.updateListener.of((u) => {
      if (u.docChanged || (u.selectionSet && u.state.field(shownSignature))) void show(u.view);
      else if (u.focusChanged && !u.view.hasFocus && u.state.field(shownSignature)) setTimeout(() => u.view.dispatch({ effects: setSignature.of(null) }));
    }),
    keymap.of([{ key: "Mod-Shift-Space", run: (view) => { hidden = ""; void show(view); return true; } },
      { key: "Escape", run: (view) => {
        const shown = view.state.field(shownSignature);
        if (!shown) return false;
        hidden = shown.form;
        view.dispatch({ effects: setSignature.of(null) });
        return true;
      } }])];
}

export class Editor {
  view: EditorView;
  path = "";
  private shownLine: number | null = null;

  constructor(el: HTMLElement, private events: { changed: () => void; checked: (found: Diagnostic[]) => void; save: () => void;
    elsewhere: (path: string, from: number, to: number) => void }) {
    const root = el.attachShadow({ mode: "open" });
    const place = document.createElement("div");
    const fill = new CSSStyleSheet();
    fill.replaceSync(":host, div.place { height: 100%; display: block; }");
    root.adoptedStyleSheets = [fill];
    place.className = "place";
    root.append(place);
    this.view = new EditorView({ parent: place, root, state: this.state("") });
  }

  private state(text: string) {
    return EditorState.create({ doc: text, extensions: [
      lineNumbers(), history(), drawSelection(), highlightActiveLine(), bracketMatching(), highlightSelectionMatches(), search({ top: true }),
      indentUnit.of("    "), language, syntaxHighlighting(colours), look, here, lintGutter(),
      EditorView.contentAttributes.of({ "aria-label": "source of the program: Tab leaves it, Control and ] indents", tabindex: "0" }),
      linter((view) => this.check(view), { delay: 300 }),
      autocompletion({ override: [(c) => this.complete(c)] }),
      hoverTooltip((view, at) => this.hover(view, at)), signature((path, text, at) => post("signature", { path, text, at }), () => this.path),
      keymap.of([{ key: "Mod-s", preventDefault: true, run: () => { this.events.save(); return true; } },
        { key: "F12", run: (view) => { void this.define(view); return true; } },
        ...completionKeymap, ...searchKeymap, ...lintKeymap, ...historyKeymap, ...defaultKeymap]),
      EditorView.updateListener.of((u) => { if (u.docChanged) this.events.changed(); }),
    ] });
  }

  get text() { return this.view.state.doc.toString(); }

  open(path: string, text: string) {
    this.path = path;
    this.shownLine = null;
    // Tooltips that are about to be placed would be placed in the new text.
    closeCompletion(this.view);
    this.view.dispatch({ effects: [closeHoverTooltips, setSignature.of(null)] });
    this.view.setState(this.state(text));
  }

  get document(): unknown { return this.view.state.doc; }

  // One step to undo.
  change(changes: { from: number; to: number; insert: string }[]) {
    this.view.dispatch({ changes, annotations: isolateHistory.of("full") });
  }

  // A name that the text does not have: the word, and a number if it needs one.
  unused(word: string, bare = false): string {
    const has = (name: string) => new RegExp(`\\b${name}\\b`).test(this.text) || words.has(name);
    if (bare && !has(word)) return word;
    let n = 1;
    while (has(word + n)) n++;
    return word + n;
  }

  // Lines at the cursor: as an expression where one is being written, else as a variable called [name] in lines of its
  // own. The result is the number of the first line.
  write(name: string, lines: string[]): number {
    const { state } = this.view, { from, to } = state.selection.main, line = state.doc.lineAt(from);
    const before = line.text.slice(0, from - line.from), after = state.doc.lineAt(to).text.slice(to - state.doc.lineAt(to).from);
    const indent = /^\s*/.exec(line.text)![0], all = lines.join("\n" + indent);
    const isOpen = before.trim() !== "" && (after.trim() !== "" || /[=([,:^|&+-]\s*$/.test(before) || from !== to);
    const statement = `${name} = ${all}`;
    const change = isOpen ? { from, to, insert: all }
      : line.text.trim() === "" ? { from: line.from, to: line.to, insert: indent + statement + "\n" }
      : before.trim() === "" ? { from: line.from, to: line.from, insert: indent + statement + "\n" }
      : { from: line.to, to: line.to, insert: "\n" + indent + statement };
    const start = change.from + (change.insert.startsWith("\n") ? 1 : 0);
    this.view.dispatch({ changes: change, selection: { anchor: change.from + change.insert.length }, annotations: isolateHistory.of("full"),
      effects: EditorView.scrollIntoView(change.from, { y: "center" }) });
    return this.view.state.doc.lineAt(start).number;
  }

  replace(text: string) {
    this.view.dispatch({ changes: { from: 0, to: this.view.state.doc.length, insert: text } });
  }

  show(line: number | null, scroll: boolean) {
    if (line === this.shownLine) return;
    this.shownLine = line;
    const effects: StateEffect<any>[] = [setHere.of(line)];
    if (scroll && line !== null && line <= this.view.state.doc.lines)
      effects.push(EditorView.scrollIntoView(this.view.state.doc.line(line).from, { y: "center" }));
    this.view.dispatch({ effects });
  }

  private async check(view: EditorView) {
    if (!this.path) return [];
    let found: Diagnostic[];
    try { found = (await post("check", { path: this.path, text: view.state.doc.toString() })).diagnostics; }
    catch { return []; }  // without a server nobody knows
    this.events.checked(found);
    const end = view.state.doc.length;
    return found.map((d) => ({ from: Math.min(d.from, end), to: Math.min(Math.max(d.to, d.from), end), severity: d.severity,
      message: d.message + (d.hint ? `\n${d.hint}` : "") }));
  }

  private async complete(c: CompletionContext) {
    if (!c.explicit && !c.matchBefore(/[\w.'"]$/)) return null;
    const found = await post("complete", { path: this.path, text: c.state.doc.toString(), at: c.pos }).catch(() => null);
    if (!found) return null;
    return { from: found.from, to: c.pos, validFor: /^\w*$/,
      options: found.items.map((i: any) => ({ label: i.label, type: i.kind, detail: i.form === i.label ? "" : i.form, info: i.text })) };
  }

  private async hover(view: EditorView, at: number) {
    const found = await post("hover", { path: this.path, text: view.state.doc.toString(), at }).catch(() => null);
    if (!found) return null;
    return { pos: found.from, end: found.to, create: () => {
      const dom = document.createElement("div");
      dom.className = "hover";
      dom.textContent = found.text.replace(/```\w*\n?/g, "").trim();
      return { dom };
    } };
  }

  private async define(view: EditorView) {
    const { doc } = view.state;
    const found = await post("definition", { path: this.path, text: doc.toString(), at: view.state.selection.main.head }).catch(() => null);
    if (!found || view.state.doc !== doc) return;
    if (found.file === this.path) this.select(found.from, found.to);
    else this.events.elsewhere(found.file, found.from, found.to);
  }

  select(from: number, to: number) {
    this.view.dispatch({ selection: { anchor: from, head: to }, effects: EditorView.scrollIntoView(from, { y: "center" }) });
    this.view.focus();
  }
}
