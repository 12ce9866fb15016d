// The map: vehicles with their tracks, and the places of plans. It needs no tiles: a net of meridians and parallels,
// and a scale.

import * as L from "leaflet";
import { type Run, type Vehicle, clock, trouble } from "./model";
import { h } from "./dom";

export interface Place { plan: string; latitude: number; longitude: number }

const colours = ["#1769aa", "#b3470b", "#1b7f3b", "#8a3ab9", "#a8123e", "#00737d", "#7a5c00", "#5a5f66"];
export const colour = (index: number) => colours[index % colours.length];

interface Shown { marker: L.Marker; track: L.Polyline; key: string }

const steps = [0.0001, 0.0002, 0.0005, 0.001, 0.002, 0.005, 0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 1, 2, 5, 10, 20, 45];

export class ChartMap {
  private map: L.Map;
  private net = L.layerGroup();
  private places = L.layerGroup();
  private shown = new Map<string, Shown>();
  private fitted = false;
  private follow: string | null = null;

  constructor(el: HTMLElement, private select: (id: string) => void) {
    this.map = L.map(el, { center: [41.185, -8.706], zoom: 15, maxZoom: 21, minZoom: 2, attributionControl: false,
      zoomAnimation: false, fadeAnimation: false, preferCanvas: true });
    L.control.scale({ imperial: false }).addTo(this.map);
    this.net.addTo(this.map); this.places.addTo(this.map);
    this.map.on("moveend resize", () => this.draw());
    this.map.on("dragstart", () => (this.follow = null));
    const Fit = L.Control.extend({ onAdd: () => {
      const button = h("button", { class: "map-button", type: "button", title: "Show all vehicles",
        click: (e: Event) => { e.stopPropagation(); this.follow = null; this.fit(); } }, "All");
      L.DomEvent.disableClickPropagation(button);
      return button;
    } });
    new Fit({ position: "topright" }).addTo(this.map);
    new ResizeObserver(() => this.map.invalidateSize({ animate: false })).observe(el);
    this.draw();
  }

  // Another run: its vehicles may be elsewhere.
  reset() {
    for (const s of this.shown.values()) { s.marker.remove(); s.track.remove(); }
    this.shown.clear();
    this.fitted = false;
    this.follow = null;
  }

  focus(id: string) {
    this.follow = id;
    const s = this.shown.get(id);
    if (s) this.map.panTo(s.marker.getLatLng(), { animate: false });
  }

  setPlaces(places: Place[]) {
    this.places.clearLayers();
    for (const p of places)
      L.marker([p.latitude, p.longitude], { keyboard: false, icon: L.divIcon({ className: "place", iconSize: [0, 0],
        html: h("span", {}, p.plan) as any }) }).addTo(this.places);
  }

  fit() {
    const points = [...this.shown.values()].flatMap((s) => s.track.getLatLngs() as L.LatLng[]);
    this.places.eachLayer((p) => points.push((p as L.Marker).getLatLng()));
    if (points.length) this.map.fitBounds(L.latLngBounds(points).pad(0.25), { animate: false, maxZoom: 18 });
  }

  render(run: Run) {
    const ids = [...run.vehicles.keys()];
    for (const [id, s] of this.shown)
      if (!run.vehicles.get(id)?.samples.length) { s.marker.remove(); s.track.remove(); this.shown.delete(id); }
    ids.forEach((id, i) => {
      const v = run.vehicles.get(id)!;
      if (v.samples.length) this.vehicle(run, v, colour(i));
    });
    if (!this.fitted && this.shown.size) { this.fitted = true; this.fit(); }
    if (this.follow) this.focus(this.follow);
    this.labels(run);
  }

  private vehicle(run: Run, v: Vehicle, tint: string) {
    const last = v.samples[v.samples.length - 1];
    const at = L.latLng(last.latitude, last.longitude);
    let s = this.shown.get(v.id);
    if (!s) {
      const marker = L.marker(at, { title: v.id, alt: v.id, icon: L.divIcon({ className: "vehicle", iconSize: [0, 0], html: "" }) });
      marker.on("click", () => this.select(v.id));
      s = { marker: marker.addTo(this.map), track: L.polyline([], { color: tint, weight: 2, opacity: 0.75 }).addTo(this.map), key: "" };
      this.shown.set(v.id, s);
    }
    s.marker.setLatLng(at);
    s.track.setLatLngs(v.samples.map((p) => L.latLng(p.latitude, p.longitude)));
    const heading = headingOf(v), t = trouble(run, v), plan = run.allocation.get(v.id) ?? "";
    const age = run.moves ? run.time - v.heard : 0;
    const key = [heading, t.rank, plan, Math.floor(age / 5)].join();
    if (key !== s.key) {
      s.key = key;
      const el = s.marker.getElement()!;
      el.replaceChildren(icon(tint, heading, !v.connected),
        h("span", { class: "name" + (t.rank > 0 ? " bad" : "") }, v.id, plan ? h("small", {}, plan) : null,
          t.rank > 0 ? h("small", {}, t.text) : age > 15 ? h("small", {}, `${clock(age)} old`) : null));
    }
  }

  // Where names would lie upon each other, that of whom needs less of a look goes.
  private labels(run: Run) {
    const kept: DOMRect[] = [];
    const order = [...this.shown.entries()].sort(([a], [b]) =>
      trouble(run, run.vehicles.get(b)!).rank - trouble(run, run.vehicles.get(a)!).rank);
    for (const [, s] of order) {
      const name = s.marker.getElement()?.querySelector<HTMLElement>(".name");
      if (!name) continue;
      let free = false;
      for (const side of ["", "left", "up", "down"]) {
        name.dataset.side = side;
        const r = name.getBoundingClientRect();
        if (!kept.some((k) => k.left < r.right && r.left < k.right && k.top < r.bottom && r.top < k.bottom)) {
          kept.push(r); free = true; break;
        }
      }
      name.style.visibility = free ? "" : "hidden";
    }
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
function headingOf(v: Vehicle): number | null {
  const s = v.samples, last = s[s.length - 1];
  for (let i = s.length - 2; i >= Math.max(0, s.length - 20); i--) {
    const north = last.latitude - s[i].latitude;
    const east = (last.longitude - s[i].longitude) * Math.cos((last.latitude * Math.PI) / 180);
    if (Math.hypot(north, east) > 1e-5) return Math.round((Math.atan2(east, north) * 180) / Math.PI);
  }
  return null;
}

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
