// Drawing: points that are set on the map become text of the program, at the cursor. Maps of other programs come into
// the folder by being dropped on the page.

import * as L from "leaflet";
import { get, ask } from "./api";
import type { Editor } from "./editor";
import { $, h } from "./dom";
import type { ChartMap } from "./map";
import { type Shapes, degrees } from "./shapes";

type Kind = "position" | "way" | "area" | "circle" | "plan";
const least: Record<Kind, number> = { position: 1, way: 2, area: 3, circle: 2, plan: 1 };
const titles: Record<Kind, string> = { position: "Point", way: "Way", area: "Area", circle: "Circle", plan: "Plan" };
const mostBytes = 1024 * 1024;

const place = (p: L.LatLng) => `location(${degrees(p.lat)}, ${degrees(p.lng)})`;
const lines = (open: string, points: L.LatLng[], close: string) => [open, ...points.map((p, i) => `    ${place(p)}${i < points.length - 1 ? "," : ""}`), close];

// The text of what was drawn, line by line.
function text(kind: Kind, points: L.LatLng[], name: string): string[] {
  switch (kind) {
    case "position": return [place(points[0])];
    case "way": return lines("[", points, "]");
    case "area": return lines("polygon([", points, "])");
    case "circle": return [`${place(points[0])} ^ ${Math.max(1, Math.round(points[0].distanceTo(points[1])))}`];
    case "plan": return ["imcPlan {", `    planName '${name}'`, ...points.map((p) => `    goTo location: ${place(p)}`), "}"];
  }
}

export class Draw {
  open = false;
  private kind: Kind | null = null;
  private points: L.LatLng[] = [];
  private sketch = L.layerGroup();
  private button = h("button", { class: "map-button", type: "button", id: "draw-open", "aria-expanded": "false", "aria-controls": "draw",
    title: "Points, ways, areas and plans for the program", click: () => this.toggle(!this.open) }, "Draw");

  constructor(private map: ChartMap, private editor: Editor, private shapes: Shapes, private events: {
    may: () => boolean; changed: () => void; tell: (why: string, bad?: boolean) => void; stored: (layers: string[], path: string) => void }) {
    this.sketch.addTo(map.map);
    map.addButton(this.button);
    $("draw-kinds").append(...(Object.keys(titles) as Kind[]).map((kind) =>
      h("button", { type: "button", "data-kind": kind, "aria-pressed": "false", click: () => this.begin(kind) }, titles[kind])));
    $("draw-done").addEventListener("click", () => this.done());
    $("draw-back").addEventListener("click", () => this.back());
    $("draw-cancel").addEventListener("click", () => this.cancel());
    $("draw-close").addEventListener("click", () => this.toggle(false));
    $("draw-import").addEventListener("click", () => $("draw-file").click());
    $("draw-file").addEventListener("change", () => { const field = $<HTMLInputElement>("draw-file"); void this.imports([...(field.files ?? [])]); field.value = ""; });
    map.map.on("click", (e) => { if (this.kind) this.add(e.latlng); });
    map.map.on("mousemove", (e) => { if (this.kind && this.points.length) this.render(e.latlng); });
    map.map.getContainer().addEventListener("keydown", (e) => this.key(e));
    window.addEventListener("keydown", (e) => { if (this.kind && e.key === "Escape") this.cancel(); });
    window.addEventListener("dragover", (e) => { if (e.dataTransfer?.types.includes("Files")) e.preventDefault(); });
    // Also where nothing is imported: the browser would leave the page for the file.
    window.addEventListener("drop", (e) => {
      if (!e.dataTransfer?.files.length) return;
      e.preventDefault();
      e.stopPropagation();
      void this.imports([...e.dataTransfer.files]);
    }, true);
  }

  // The rights of this page may change.
  show() {
    this.button.hidden = !this.events.may();
    if (this.button.hidden && this.open) this.toggle(false);
  }

  private toggle(open: boolean) {
    this.cancel();
    this.open = open;
    $("draw").hidden = !open;
    this.button.setAttribute("aria-expanded", String(open));
    if (open) $("draw-kinds").querySelector("button")!.focus();
    else if ($("draw").contains(document.activeElement) || document.activeElement === document.body) this.button.focus();
    this.events.changed();
  }

  // {1 Points}

  private begin(kind: Kind) {
    if (!this.events.may()) return;
    this.cancel();
    this.kind = kind;
    this.map.hold();
    this.map.map.doubleClickZoom.disable();
    this.map.map.getContainer().classList.add("draws");
    this.map.map.getContainer().focus();
    this.render();
  }

  private key(e: KeyboardEvent) {
    if (!this.kind || e.target !== this.map.map.getContainer()) return;
    const step = e.shiftKey ? 8 : 80;
    const [x, y] = { ArrowLeft: [-step, 0], ArrowRight: [step, 0], ArrowUp: [0, -step], ArrowDown: [0, step] }[e.key] ?? [0, 0];
    if (x || y) this.map.map.panBy([x, y], { animate: false });
    else if (e.key === " ") this.add(this.map.map.getCenter());
    else if (e.key === "Enter") this.done();
    else if (e.key === "Backspace") this.back();
    else return;
    e.preventDefault();
    e.stopPropagation();
  }

  private add(p: L.LatLng) {
    const last = this.points[this.points.length - 1];
    // A double click is one point.
    if (last && this.map.map.latLngToContainerPoint(last).distanceTo(this.map.map.latLngToContainerPoint(p)) < 4) return;
    this.points.push(p.wrap());
    if ((this.kind === "position" || this.kind === "circle") && this.points.length === least[this.kind]) this.done();
    else this.render();
  }

  private back() {
    this.points.pop();
    this.render();
  }

  private cancel() {
    this.kind = null;
    this.points = [];
    this.map.map.doubleClickZoom.enable();
    this.map.map.getContainer().classList.remove("draws");
    this.render();
  }

  private render(next?: L.LatLng) {
    const { kind, points } = this;
    this.sketch.clearLayers();
    const look = { color: "#a8123e", weight: 2, fillOpacity: 0.08, interactive: false, className: "sketched", renderer: L.svg() };
    const way = next ? [...points, next] : points;
    if (kind === "circle" && way.length > 1) this.sketch.addLayer(L.circle(way[0], { ...look, radius: way[0].distanceTo(way[1]) }));
    else if (kind && way.length > 1) this.sketch.addLayer(kind === "area" ? L.polygon(way, look) : L.polyline(way, look));
    for (const p of points) this.sketch.addLayer(L.circleMarker(p, { ...look, radius: 4, fillOpacity: 1 }));
    for (const el of $("draw-kinds").querySelectorAll<HTMLElement>("button")) el.setAttribute("aria-pressed", String(el.dataset.kind === kind));
    $("draw-steps").hidden = kind === null;
    if (!kind) return;
    $<HTMLButtonElement>("draw-done").disabled = points.length < least[kind];
    $<HTMLButtonElement>("draw-back").disabled = points.length === 0;
    const asks = kind === "circle" ? (points.length ? "Its rim" : "Its centre") : kind === "position" ? "The point" : `${points.length} ${points.length === 1 ? "point" : "points"}`;
    if ($("draw-count").textContent !== asks) $("draw-count").textContent = asks;
  }

  private done() {
    const { kind, points } = this;
    if (!kind || points.length < least[kind] || !this.events.may()) return;
    this.cancel();
    const name = this.editor.unused({ position: "point", way: "way", area: "area", circle: "area", plan: "plan" }[kind]);
    const line = this.editor.write(name, text(kind, points, name));
    this.events.tell(`The program has it in line ${line}; Ctrl-Z takes it out.`, false);
    this.events.changed();
  }

  // {1 Maps of other programs}

  async imports(files: File[]) {
    for (const file of files) try { await this.import(file); } catch (e) { this.events.tell(`${file.name}: ${(e as Error).message}`); }
  }

  private async import(file: File) {
    if (!this.events.may()) throw new Error("this page may not change the program");
    if (/['"\\$/]/.test(file.name)) throw new Error("rename it without quotes, $ and slashes");
    if (file.size > mostBytes) throw new Error("a map of more than 1 MiB is put into the folder by hand");
    const path = this.editor.path.replace(/[^/]*$/, "") + file.name;
    const bytes = new Uint8Array(await file.arrayBuffer());
    const contents = [...bytes].map((b) => b.toString(16).padStart(2, "0")).join("");
    const { names, notes } = await ask("PUT", "layer", { path, contents });
    this.events.stored((await get("files")).layers, path);
    const found = await this.shapes.read();
    if (!found) throw new Error("the file is in the folder; mend the program, then drop it again for its line");
    const base = file.name.replace(/\.[^.]*$/, "").replace(/\W+/g, "_").replace(/^(\d|_*$)/, "map_$1");
    if (!this.editor.text.includes(`map '${file.name}'`))
      this.editor.change([{ from: found.first, to: found.first, insert: `${this.editor.unused(base, true)} = map '${file.name}'\n` }]);
    this.events.tell([`${file.name}: ${names.length ? names.join(", ") : "nothing"}`, ...notes].join(". "), false);
  }
}
