// Positions and areas of the program in the editor, on the map: handles move them, and the text follows. The places of
// their numbers are the server's.

import * as L from "leaflet";
import { type Pair, type Shape, type ShapeNumber, type ShapePoint, post } from "./api";
import type { Editor } from "./editor";
import { h } from "./dom";
import type { ChartMap } from "./map";

const look = { color: "#7a5c00", weight: 2, fillOpacity: 0.1, interactive: false, className: "shape", smoothFactor: 0, noClip: true, renderer: L.svg() };
const mostHandles = 300;

// As it stands in a text: a hundred-millionth of a right angle's part, about a centimetre.
export function degrees(x: number): string {
  const text = x.toFixed(7).replace(/0+$/, "");
  return text.endsWith(".") ? text + "0" : text;
}

interface Moved { number: ShapeNumber; text: string; value: number; before: number }
interface Handle { key: string; marker: L.Marker; at: L.LatLng; moves: (to: L.LatLng) => Moved[]; preview: (to: L.LatLng) => void; reset: () => void }

export class Shapes {
  private layer = L.layerGroup();
  private found: { path: string; doc: unknown; shapes: Shape[]; first: number } | null = null;
  private due = 0;
  private asked = 0;
  private visible = false;
  private above = false;
  private drawn = "";
  private path = "";
  private focused: string | null = null;
  private dragged = false;  // a handle under the pointer is not made again

  // [may]: whether the text may be changed here.
  constructor(private map: ChartMap, private editor: Editor, private may: () => boolean, private tell: (why: string, bad?: boolean) => void) {
    map.shapes.addLayer(this.layer);
  }

  // Visible, and with [above] its handles are above vehicles.
  show(visible: boolean, above: boolean) {
    if (visible !== this.visible || above !== this.above) {
      this.visible = visible;
      this.above = above;
      this.map.hideProgram(visible);
      this.draw();
    }
  }

  // The text is another one: what is on the map is out of date, and rests until the server has read it.
  changed() {
    this.asked++;
    this.map.map.getContainer().classList.add("stale");
    clearTimeout(this.due);
    this.due = window.setTimeout(() => void this.read(), 250);
  }

  async read(): Promise<{ first: number } | null> {
    const number = ++this.asked, { path, document: doc } = this.editor;
    if (!path) return null;
    try {
      const reply = await post("shapes", { path, text: this.editor.text });
      if (number !== this.asked || this.editor.document !== doc || this.editor.path !== path) return null;
      this.found = { path, doc, ...reply };
      this.map.map.getContainer().classList.remove("stale");
      this.draw();
      return reply;
    } catch { return null; }  // a text with faults: the shapes rest where they were
  }

  private isFresh() { return this.found !== null && this.found.doc === this.editor.document && this.may(); }

  private draw() {
    const { found } = this;
    const shapes = this.visible && found && found.path === this.editor.path ? found.shapes : [];
    const key = JSON.stringify([shapes, this.above, this.may()]);
    if (key === this.drawn || this.dragged) return;
    this.drawn = key;
    const before = this.focused;  // removed, it loses the focus
    this.layer.clearLayers();
    this.focusable.clear();
    let handles = 0;
    shapes.forEach((shape, i) => {
      const movable = shape.points.length + (shape.holes ?? []).flat().length;
      this.add(shape, String(i), this.may() && handles + movable <= mostHandles);
      handles += movable;
    });
    if (before !== null) this.focusable.get(before)?.focus();
    if (found && this.path !== found.path && shapes.length) { this.path = found.path; this.map.more(); }
  }

  private focusable = new Map<string, HTMLElement>();

  private add(shape: Shape, key: string, movable: boolean) {
    const rings: Pair[][] = [shape.points, ...(shape.holes ?? [])].map((ps) => ps.map((p: ShapePoint) => [...p.at] as Pair));
    let radius = shape.radius ?? 0;
    let outline: { redraw: () => void; layer: L.Layer } | null = null;
    if (shape.kind === "area") { const l = L.polygon(rings, look); outline = { layer: l, redraw: () => l.setLatLngs(rings) }; }
    else if (shape.kind === "way" || shape.kind === "plan") {
      const l = L.polyline(rings[0], { ...look, ...(shape.kind === "plan" ? { dashArray: "7 5" } : {}) });
      outline = { layer: l, redraw: () => l.setLatLngs(rings[0]) };
    } else if (shape.kind === "circle") {
      const l = L.circle(rings[0][0], { ...look, radius });
      outline = { layer: l, redraw: () => { l.setLatLng(rings[0][0]); l.setRadius(radius); } };
    } else if (shape.rings) outline = { layer: L.polygon(shape.rings, { ...look, fillOpacity: 0.05 }), redraw: () => {} };
    else if (shape.centre) outline = { layer: L.circle(shape.centre, { ...look, radius: shape.radius! }), redraw: () => {} };
    if (outline) this.layer.addLayer(outline.layer);
    const redraw = () => outline?.redraw();
    [shape.points, ...(shape.holes ?? [])].forEach((points, r) => points.forEach((p: ShapePoint, j: number) => {
      const { latitude, longitude } = p;
      const what = shape.kind === "position" ? shape.name : shape.kind === "circle" ? `${shape.name}: centre`
        : `${shape.name}: ${shape.kind === "area" ? "corner" : "point"} ${j + 1}${r ? ` of hole ${r}` : ""}`;
      if (!movable || !latitude || !longitude) { this.layer.addLayer(fixed(p.at, shape.kind === "position" ? shape.name : "", what)); return; }
      this.handle({ key: `${key}.${r}.${j}`, at: L.latLng(p.at), what, name: shape.kind === "position" || (r === 0 && j === 0) ? shape.name : "",
        moves: (to) => [{ number: latitude, value: to.lat, before: p.at[0], text: degrees(to.lat) }, { number: longitude, value: to.lng, before: p.at[1], text: degrees(to.lng) }],
        preview: (to) => { rings[r][j] = [to.lat, to.lng]; redraw(); }, reset: () => { rings[r][j] = [...p.at]; redraw(); } });
    }));
    if (shape.kind === "circle" && shape.metres && movable) {
      const centre = L.latLng(rings[0][0]), { metres } = shape;
      const rim = L.latLng(centre.lat, centre.lng + east(centre, shape.radius!));
      const of = (to: L.LatLng) => Math.max(1, Math.round(centre.distanceTo(to)));
      this.handle({ key: `${key}.radius`, at: rim, what: `${shape.name}: radius`, name: "",
        moves: (to) => [{ number: metres, value: of(to), before: shape.radius!, text: String(of(to)) }],
        preview: (to) => { radius = of(to); redraw(); }, reset: () => { radius = shape.radius!; redraw(); } });
    }
  }

  private handle(p: Omit<Handle, "marker"> & { what: string; name: string }) {
    const marker = L.marker(p.at, { draggable: true, keyboard: true, autoPan: true, title: `${p.what}: drag it, or arrow keys and Enter`, alt: p.what,
      zIndexOffset: this.above ? 1000 : -500, icon: L.divIcon({ className: "handle", iconSize: [36, 36], html: h("span", {}, p.name) as any }) });
    marker.on("dragstart", () => { this.dragged = true; });
    marker.on("drag", () => p.preview(marker.getLatLng()));
    // A coordinate that was not moved by a pixel stays as it is written.
    const target = () => {
      const to = marker.getLatLng().wrap(), [a, b] = [p.at, to].map((at) => this.map.map.latLngToContainerPoint(at));
      return L.latLng(Math.abs(a.y - b.y) < 1 ? p.at.lat : to.lat, Math.abs(a.x - b.x) < 1 ? p.at.lng : to.lng);
    };
    const back = () => { marker.setLatLng(p.at); p.reset(); };
    const commit = () => {
      const moved = p.moves(target()).filter((m) => m.value !== m.before);
      if (moved.length) this.write(p.key, moved, back); else back();
    };
    marker.on("dragend", () => { this.dragged = false; commit(); this.draw(); });
    marker.on("add", () => {
      const el = marker.getElement()!;
      el.setAttribute("aria-label", p.what);
      el.setAttribute("role", "button");
      this.focusable.set(p.key, el);
      el.addEventListener("focus", () => { this.focused = p.key; });
      el.addEventListener("blur", () => { this.focused = null; });
      el.addEventListener("keydown", (e) => {
        const step = e.shiftKey ? 1 : 10;
        const [x, y] = { ArrowLeft: [-step, 0], ArrowRight: [step, 0], ArrowUp: [0, -step], ArrowDown: [0, step] }[e.key] ?? [0, 0];
        if (x || y) {
          const at = this.map.map.latLngToContainerPoint(marker.getLatLng());
          marker.setLatLng(this.map.map.containerPointToLatLng([at.x + x, at.y + y]));
          p.preview(marker.getLatLng());
        }
        else if (e.key === "Enter") commit();
        else if (e.key === "Escape") back();
        else return;
        e.preventDefault();
        e.stopPropagation();
      });
    });
    this.layer.addLayer(marker);
  }

  private write(key: string, moved: Moved[], back: () => void) {
    if (!this.isFresh()) { back(); this.tell("The text has changed meanwhile: move it again."); return; }
    if (moved.some((m) => m.value < 0 && !m.number.negative)) {
      back();
      this.tell("No number below 0 may stand there without parentheses: write location(latitude, longitude).");
      return;
    }
    this.focused = this.focusable.get(key) === document.activeElement ? key : null;
    this.editor.change(moved.map(({ number, text }) => ({ from: number.from, to: number.to, insert: text })));
  }
}

// Degrees of longitude of this many metres.
const east = (at: L.LatLng, metres: number) => (metres / (6371008.8 * Math.cos((at.lat * Math.PI) / 180))) * (180 / Math.PI);

function fixed(at: Pair, name: string, what: string) {
  return L.marker(at, { interactive: false, keyboard: false, alt: what,
    icon: L.divIcon({ className: "place of-program", iconSize: [0, 0], html: h("span", {}, name) as any }) });
}
