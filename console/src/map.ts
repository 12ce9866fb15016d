// The map: vehicles with their tracks, and the places of plans. It needs no tiles: a net of meridians and parallels,
// and a scale.

import * as L from "leaflet";
import type { Fence, Place, Way } from "./api";
import type { Sketch } from "./plans";
import { type Run, type Vehicle, clock, trouble, whereabouts } from "./model";
import { h } from "./dom";
import { Clusters, pressed } from "./clusters";
import { Measure } from "./measure";
import { Tracks } from "./tracks";

export interface PlanPlace { plan: string; latitude: number; longitude: number }

const fenceColour = "#c0271a";
const colours = ["#1769aa", "#b3470b", "#1b7f3b", "#8a3ab9", "#a8123e", "#00737d", "#7a5c00", "#5a5f66"];
export const colour = (index: number) => colours[index % colours.length];
// Of a vehicle of this run; grey for one of another run alone.
export function tintOf(run: Run, id: string): string {
  const index = [...run.vehicles.keys()].indexOf(id);
  return index < 0 ? "#5a5f66" : colour(index);
}

interface Shown { marker: L.Marker; track: L.Polyline; key: string; size: { width: number; height: number } | null }

// Where a name may stand, from its vehicle.
const sides = [["", 14, -9], ["left", 14, -9], ["up", 0, -28], ["down", 0, 11]] as const;

const steps = [0.0001, 0.0002, 0.0005, 0.001, 0.002, 0.005, 0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 1, 2, 5, 10, 20, 45];

// A circle's own bounds need the map that it is on, and its group may be hidden.
const boundsOf = (shape: L.Polyline | L.Circle) =>
  shape instanceof L.Circle ? shape.getLatLng().toBounds(2 * shape.getRadius()) : shape.getBounds();

export class ChartMap {
  readonly map: L.Map;
  private net = L.layerGroup();
  private places = L.layerGroup();
  private program = L.layerGroup();  // what its variables are on the map
  private fences = L.layerGroup();
  private legend = h("ul", { class: "map-legend", hidden: true, "aria-label": "Fences" });
  private ways = L.layerGroup();
  readonly shapes = L.layerGroup();  // of the text in the editor
  private sketched = L.layerGroup();  // a plan before it runs
  private then = L.layerGroup();  // where vehicles were when something happened
  private drawn = { program: "", ways: "", fences: "" };
  private following = h("button", { class: "map-button", type: "button", hidden: true });
  private shown = new Map<string, Shown>();
  private fitted = false;  // all that is known now is in view, or somebody has chosen the view
  private chosen = false;
  private follow: string | null = null;
  private buttons = h("div", { class: "map-buttons" });
  private clusters: Clusters;
  private latest: Run | null = null;
  readonly tracks: Tracks;
  private arrows = h("div", { class: "map-arrows" });  // to vehicles that are out of view

  constructor(el: HTMLElement, private select: (id: string) => void) {
    this.map = L.map(el, { center: [41.185, -8.706], zoom: 15, maxZoom: 21, minZoom: 2, attributionControl: false,
      zoomAnimation: false, fadeAnimation: false, preferCanvas: true });
    L.control.scale({ imperial: false }).addTo(this.map);
    for (const layer of [this.net, this.fences, this.program, this.shapes, this.ways, this.sketched, this.then, this.places]) layer.addTo(this.map);
    this.clusters = new Clusters(this.map, (id) => { this.focus(id); this.select(id); }, () => { this.chosen = true; this.unfollow(); });
    this.map.on("moveend resize", () => { this.draw(); if (this.latest) this.arrange(this.latest); });
    this.map.on("dragstart", () => this.unfollow());
    for (const event of ["pointerdown", "wheel", "keydown"]) el.addEventListener(event, () => { this.chosen = true; });
    const Fit = L.Control.extend({ onAdd: () => {
      const { buttons } = this;
      buttons.append(
        h("button", { class: "map-button", type: "button", title: "Show all vehicles, places and ways",
          click: () => { this.chosen = false; this.unfollow(); this.fit(); } }, "All"),
        h("button", { class: "map-button", type: "button", title: "Show the vehicles where they are now",
          click: () => { this.chosen = true; this.unfollow(); this.fitFleet(); } }, "Fleet"),
        new Measure(this.map).button, this.following);
      this.following.addEventListener("click", () => this.unfollow());
      L.DomEvent.disableClickPropagation(buttons);
      return buttons;
    } });
    new Fit({ position: "topright" }).addTo(this.map);
    new (L.Control.extend({ onAdd: () => this.legend }))({ position: "bottomleft" }).addTo(this.map);
    this.tracks = new Tracks(this.map);
    L.DomEvent.disableClickPropagation(this.arrows);
    el.append(this.arrows);
    this.map.on("move", () => this.point());
    new ResizeObserver(() => this.map.invalidateSize({ animate: false })).observe(el);
    this.draw();
  }

  // Another run: its vehicles may be elsewhere.
  reset() {
    for (const s of this.shown.values()) { s.marker.remove(); s.track.remove(); }
    this.shown.clear();
    this.fitted = this.chosen = false;
    this.unfollow();
  }

  // More is on the map: it comes into view, unless somebody has chosen what to see.
  more() { this.fitted = this.chosen; }

  // What is in view stays there.
  hold() { this.chosen = true; this.unfollow(); }

  // While the text in the editor is shown, the values that its variables had in a run are not.
  hideProgram(hide: boolean) { if (hide) this.program.remove(); else this.program.addTo(this.map); }

  addButton(el: HTMLElement) { this.buttons.append(el); }

  private unfollow() { this.follow = null; this.following.hidden = true; }

  focus(id: string) {
    this.follow = id;
    this.following.hidden = false;
    this.following.textContent = `Follows ${id} ✕`;
    this.following.title = "Do not follow it any more";
    const s = this.shown.get(id);
    if (s) this.map.panTo(s.marker.getLatLng(), { animate: false });
  }

  setPlaces(places: PlanPlace[]) {
    this.places.clearLayers();
    for (const p of places)
      L.marker([p.latitude, p.longitude], { keyboard: false, icon: L.divIcon({ className: "place", iconSize: [0, 0],
        html: h("span", {}, p.plan) as any }) }).addTo(this.places);
  }

  fit() {
    const points = [...this.shown.values()].flatMap((s) => s.track.getLatLngs() as L.LatLng[]).concat(this.tracks.points());
    this.places.eachLayer((p) => points.push((p as L.Marker).getLatLng()));
    const bounds = L.latLngBounds(points);
    const ofShapes = this.shapes.getLayers().flatMap((l) => (l as L.LayerGroup).getLayers());
    const ofGroups = [...(this.map.hasLayer(this.program) ? [this.program] : []), this.ways, this.sketched].flatMap((group) => group.getLayers());
    for (const l of [...ofShapes, ...ofGroups])
      bounds.extend(l instanceof L.Marker ? l.getLatLng() : boundsOf(l as L.Polyline | L.Circle));
    if (bounds.isValid()) this.map.fitBounds(bounds.pad(0.25), { animate: false, maxZoom: 18 });
  }

  private fitFleet() {
    const bounds = L.latLngBounds([...this.shown.values()].map((s) => s.marker.getLatLng()));
    if (bounds.isValid()) this.map.fitBounds(bounds.pad(0.4), { animate: false, maxZoom: 18 });
  }

  // An arrow at the edge for each vehicle out of view, the nearest twelve of them; pressed, the map follows it.
  private point() {
    const { x: wide, y: high } = this.map.getSize(), middle = { x: wide / 2, y: high / 2 }, edge = 16;
    const away = [...this.shown.entries()].map(([id, s]) => ({ id, tint: s.track.options.color!, at: this.map.latLngToContainerPoint(s.marker.getLatLng()) }))
      .filter(({ at }) => at.x < 0 || at.y < 0 || at.x > wide || at.y > high)
      .map((a) => ({ ...a, far: Math.hypot(a.at.x - middle.x, a.at.y - middle.y) })).sort((a, b) => a.far - b.far).slice(0, 12);
    const known = new Map([...this.arrows.querySelectorAll<HTMLElement>("button")].map((el) => [el.dataset.vehicle!, el]));
    const used: { x: number; y: number }[] = [];
    for (const { id, tint, at } of away) {
      const dx = at.x - middle.x, dy = at.y - middle.y;
      const scale = Math.min((middle.x - edge) / Math.max(Math.abs(dx), 1e-9), (middle.y - edge) / Math.max(Math.abs(dy), 1e-9));
      const spot = { x: middle.x + dx * scale, y: middle.y + dy * scale };
      // Arrows never lie upon each other: those in one direction stand side by side.
      while (used.some((u) => Math.hypot(u.x - spot.x, u.y - spot.y) < 26)) {
        if (Math.abs(dx) * middle.y > Math.abs(dy) * middle.x) spot.y += 26; else spot.x += 26;
      }
      used.push(spot);
      const el = known.get(id) ?? h("button", { type: "button", "data-vehicle": id, "aria-label": `${id} is out of view: follow it`, title: id,
        click: () => { this.focus(id); this.select(id); } }, h("span", {}, "➤"));
      known.delete(id);
      el.style.color = tint;
      el.style.transform = `translate(${spot.x.toFixed(0)}px, ${spot.y.toFixed(0)}px)`;
      (el.firstElementChild as HTMLElement).style.transform = `rotate(${Math.atan2(dy, dx).toFixed(2)}rad)`;
      if (!el.parentElement) this.arrows.append(el);
    }
    for (const el of known.values()) el.remove();
  }

  private isOut() {
    const bounds = this.map.getBounds();
    return [...this.shown.values()].some((s) => !bounds.contains(s.marker.getLatLng()));
  }

  // A second run beside it has the colours of the first one.
  render(run: Run, second: Run | null = null) {
    if (this.tracks.show(second, (id) => tintOf(run, id))) this.more();
    const ids = [...run.vehicles.keys()];
    for (const [id, s] of this.shown)
      if (!run.vehicles.get(id)?.samples.length) { s.marker.remove(); s.track.remove(); this.shown.delete(id); }
    ids.forEach((id, i) => {
      const v = run.vehicles.get(id)!;
      if (v.samples.length) this.vehicle(run, v, colour(i));
    });
    this.fenced(run.fences);
    this.charted(run.places);
    this.planned(run);
    if (!this.fitted && this.shown.size) { this.fitted = true; this.fit(); }
    // Vehicles move out of a view that nobody has chosen: it grows.
    if (!this.chosen && !this.follow && this.sketched.getLayers().length === 0 && this.isOut()) this.fit();
    if (this.follow) this.focus(this.follow);
    this.arrange(run);
    this.point();
  }

  // Where there is little room: groups, and names beside the others.
  private arrange(run: Run) {
    this.latest = run;
    this.clusters.show([...this.shown.entries()].filter(([id]) => id !== this.follow && run.vehicles.has(id)).map(([id, s]) =>
      ({ id, at: s.marker.getLatLng(), bad: trouble(run, run.vehicles.get(id)!).rank > 0, element: s.marker.getElement() })));
    const followed = this.follow && this.shown.get(this.follow)?.marker.getElement();
    if (followed) followed.style.display = "";
    this.labels(run);
  }

  private vehicle(run: Run, v: Vehicle, tint: string) {
    const last = v.samples[v.samples.length - 1];
    const at = L.latLng(last.latitude, last.longitude);
    let s = this.shown.get(v.id);
    if (!s) {
      const marker = L.marker(at, { title: v.id, alt: v.id, icon: L.divIcon({ className: "vehicle", iconSize: [0, 0], html: "" }) });
      pressed(marker, () => this.select(v.id));
      s = { marker: marker.addTo(this.map), track: L.polyline([], { color: tint, weight: 2, opacity: 0.75 }).addTo(this.map), key: "", size: null };
      this.shown.set(v.id, s);
    }
    s.marker.setLatLng(at);
    s.track.setLatLngs(v.samples.map((p) => L.latLng(p.latitude, p.longitude)));
    const heading = courseOf(v), t = trouble(run, v), plan = run.allocation.get(v.id) ?? "";
    const age = run.moves ? run.time - v.heard : 0;
    const key = [heading, t.rank, plan, Math.floor(age / 5), percent(last.battery)].join();
    if (key !== s.key) {
      s.key = key;
      s.size = null;
      const el = s.marker.getElement()!;
      el.title = [v.id, v.kind, plan || "no task", v.connected ? "" : "no link", last.battery === null ? "" : `battery ${percent(last.battery)}`,
        run.moves ? `heard ${clock(age)} ago` : ""].filter(Boolean).join(", ");
      el.replaceChildren(icon(tint, heading, !v.connected),
        h("span", { class: "name" + (t.rank > 0 ? " bad" : "") }, v.id, plan ? h("small", {}, plan) : null,
          t.rank > 0 ? h("small", {}, t.text) : age > 15 ? h("small", {}, `${clock(age)} old`) : null));
    }
  }

  // Where names would lie upon each other, that of whom needs less of a look goes.
  private labels(run: Run) {
    // No name lies upon a vehicle, either.
    const kept = [...this.shown.values()].map((s) => {
      const { x, y } = this.map.latLngToContainerPoint(s.marker.getLatLng());
      return { left: x - 8, right: x + 8, top: y - 8, bottom: y + 8 };
    });
    // Nor below the buttons.
    const map = this.map.getContainer().getBoundingClientRect();
    for (const el of this.map.getContainer().querySelectorAll(".map-button:not([hidden])")) {
      const { left, right, top, bottom } = el.getBoundingClientRect();
      kept.push({ left: left - map.left, right: right - map.left, top: top - map.top, bottom: bottom - map.top });
    }
    const frame = this.map.getSize();
    const order = [...this.shown.entries()].filter(([id]) => run.vehicles.has(id) && !this.clusters.has(id)).sort(([a], [b]) =>
      trouble(run, run.vehicles.get(b)!).rank - trouble(run, run.vehicles.get(a)!).rank);
    for (const [, s] of order) {
      const name = s.marker.getElement()?.querySelector<HTMLElement>(".name");
      if (!name) continue;
      s.size ??= { width: name.offsetWidth, height: name.offsetHeight };
      const at = this.map.latLngToContainerPoint(s.marker.getLatLng()), { width, height } = s.size;
      if (at.x < 0 || at.y < 0 || at.x > frame.x || at.y > frame.y) continue;
      const room = sides.map(([side, dx, dy]) => {
        const left = at.x + (side === "left" ? -dx - width : dx || -width / 2), top = at.y + dy;
        return { side, left, right: left + width, top, bottom: top + height };
      }).find((r) => !kept.some((k) => k.left < r.right && r.left < k.right && k.top < r.bottom && r.top < k.bottom));
      if (room) { kept.push(room); if (name.dataset.side !== room.side) name.dataset.side = room.side; }
      const visibility = room ? "" : "hidden";
      if (name.style.visibility !== visibility) name.style.visibility = visibility;
    }
  }

  // {1 What the program says}

  private charted(places: Place[]) {
    const key = JSON.stringify(places);
    if (key === this.drawn.program) return;
    this.drawn.program = key;
    this.more();
    this.program.clearLayers();
    const look = { color: "#7a5c00", weight: 1.5, fillOpacity: 0.08, interactive: false };
    for (const p of places) {
      const name = (at: L.LatLngExpression) => L.marker(at, { interactive: false, keyboard: false,
        icon: L.divIcon({ className: "place of-program", iconSize: [0, 0], html: h("span", {}, p.name) as any }) }).addTo(this.program);
      if (p.position) name(p.position);
      else if (p.centre) {
        const circle = L.circle(p.centre, { ...look, radius: p.radius! }).addTo(this.program);
        name([boundsOf(circle).getNorth(), p.centre[1]]);
      }
      else if (p.rings) { const shape = L.polygon(p.rings, look).addTo(this.program); name(shape.getBounds().getCenter()); }
    }
  }

  // What vehicles must keep to: areas as lines, depths and the like only in the legend, where no map shows them.
  private fenced(fences: Fence[]) {
    const key = JSON.stringify(fences);
    if (key === this.drawn.fences) return;
    this.drawn.fences = key;
    this.fences.clearLayers();
    for (const f of fences) {
      const look = { color: fenceColour, weight: 2, interactive: false, className: "fence", renderer: L.svg(),
        ...(f.rule === "outside" ? { fillOpacity: 0.12 } : { fill: false, dashArray: "8 5" }) };
      if (f.centre) L.circle(f.centre, { ...look, radius: f.radius! }).addTo(this.fences);
      else if (f.rings) L.polygon(f.rings, look).addTo(this.fences);
    }
    this.legend.hidden = fences.length === 0;
    this.legend.replaceChildren(...fences.map((f) => h("li", { class: f.rule, title: f.fence },
      f.fence)));
  }

  // The ways of plans that vehicles run now.
  private planned(run: Run) {
    const now: Way[] = [...run.ways.values()].filter((w) => run.allocation.get(w.vehicle) === w.plan);
    const key = JSON.stringify(now.map((w) => [w.vehicle, w.plan, w.path.length, w.path[0]]));
    if (key === this.drawn.ways) return;
    this.drawn.ways = key;
    this.more();
    this.ways.clearLayers();
    const ids = [...run.vehicles.keys()];
    for (const w of now)
      L.polyline(w.path, { color: colour(ids.indexOf(w.vehicle)), weight: 2, dashArray: "5 6", interactive: false }).addTo(this.ways);
  }

  // Where vehicles were at [time], [first] of all; null: nowhere.
  past(run: Run, time: number | null, first: string | null) {
    this.then.clearLayers();
    if (time === null) return;
    [...run.vehicles.values()].forEach((v) => {
      const s = whereabouts(v, time);
      if (!s) return;
      const at = L.latLng(s.latitude, s.longitude), says = `${v.id}, ${clock(time)}`;
      L.marker(at, { interactive: false, keyboard: false, icon: L.divIcon({ className: "then", iconSize: [0, 0],
        html: h("span", {}, v.id === first ? says : "") as any }) }).addTo(this.then).getElement()!.style.setProperty("--tint", tintOf(this.latest ?? run, v.id));
      if (v.id === first && !this.map.getBounds().contains(at)) { this.chosen = true; this.unfollow(); this.map.panTo(at, { animate: false }); }
    });
  }

  // The way of a plan from where its vehicle would begin, and where its maneuvers end; or none.
  sketch(plan: Sketch | null) {
    this.sketched.clearLayers();
    if (!plan) return;
    const way = [plan.from, ...plan.maneuvers.flatMap((m) => m.points)];
    const line = L.polyline(way, { color: "#a8123e", weight: 3, opacity: 0.8, interactive: false, className: "sketch",
      smoothFactor: 0, noClip: true, renderer: L.svg() }).addTo(this.sketched);
    // Those that end at one place share a name there.
    const ends = new Map<string, { at: L.LatLngExpression; names: string[] }>();
    for (const { maneuver, points } of plan.maneuvers) {
      const at = points[points.length - 1], key = at?.map((x) => x.toFixed(5)).join();
      if (at) ends.set(key, { at, names: [...(ends.get(key)?.names ?? []), maneuver] });
    }
    for (const { at, names } of ends.values())
      L.marker(at, { interactive: false, keyboard: false,
        icon: L.divIcon({ className: "place of-plan", iconSize: [0, 0], html: h("span", {}, names.join(", ")) as any }) }).addTo(this.sketched);
    if (plan.breaks?.at)
      L.marker(plan.breaks.at, { interactive: false, keyboard: false, icon: L.divIcon({ className: "place of-breach", iconSize: [0, 0],
        html: h("span", {}, "breaks a fence") as any }) }).addTo(this.sketched);
    this.unfollow();
    this.map.fitBounds(line.getBounds().pad(0.4), { animate: false, maxZoom: 18 });
  }

  private draw() {
    this.net.clearLayers();
    const b = this.map.getBounds(), width = Math.abs(b.getEast() - b.getWest());
    const most = Math.max(2, Math.floor(this.map.getSize().x / 80));
    const step = steps.find((s) => width / s <= most) ?? 45;
    const digits = Math.max(0, Math.ceil(-Math.log10(step)));
    const line = (from: L.LatLngExpression, to: L.LatLngExpression) =>
      L.polyline([from, to], { color: "#7f8c99", weight: 1, opacity: 0.35, interactive: false }).addTo(this.net);
    const text = (at: L.LatLngExpression, what: string, kind: string) =>
      L.marker(at, { interactive: false, keyboard: false,
        icon: L.divIcon({ className: "net " + kind, iconSize: [0, 0], html: `<span>${what}</span>` }) }).addTo(this.net);
    for (let x = Math.ceil(b.getWest() / step) * step; x <= b.getEast(); x += step) {
      line([b.getSouth(), x], [b.getNorth(), x]);
      text([b.getNorth(), x], `${Math.abs(x).toFixed(digits)}° ${x < 0 ? "W" : "E"}`, "meridian");
    }
    for (let y = Math.ceil(b.getSouth() / step) * step; y <= b.getNorth(); y += step) {
      line([y, b.getWest()], [y, b.getEast()]);
      text([y, b.getEast()], `${Math.abs(y).toFixed(digits)}° ${y < 0 ? "S" : "N"}`, "parallel");
    }
  }
}

// Where it went last; vehicles do not tell where they look.
export function courseOf(v: Vehicle): number | null {
  const s = v.samples, last = s[s.length - 1];
  for (let i = s.length - 2; i >= Math.max(0, s.length - 20); i--) {
    const north = last.latitude - s[i].latitude;
    const east = (last.longitude - s[i].longitude) * Math.cos((last.latitude * Math.PI) / 180);
    if (Math.hypot(north, east) > 1e-5) return Math.round((Math.atan2(east, north) * 180) / Math.PI);
  }
  return null;
}

const percent = (battery: number | null) => (typeof battery === "number" ? Math.round(battery * 100) + " %" : "");

function icon(tint: string, heading: number | null, lost: boolean): Element {
  const el = document.createElementNS("http://www.w3.org/2000/svg", "svg");
  el.setAttribute("viewBox", "-10 -10 20 20");
  const shape = document.createElementNS("http://www.w3.org/2000/svg", heading === null ? "circle" : "path");
  if (heading === null) shape.setAttribute("r", "6");
  else { shape.setAttribute("d", "M0 -9 L6 7 L0 3 L-6 7 Z"); shape.setAttribute("transform", `rotate(${heading})`); }
  shape.setAttribute("fill", lost ? "none" : tint);
  shape.setAttribute("stroke", lost ? tint : "#fff");
  shape.setAttribute("stroke-width", lost ? "2" : "1.5");
  el.append(shape);
  return el;
}
