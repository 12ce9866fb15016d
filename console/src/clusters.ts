// Vehicles that are near each other on the screen: one marker with their number for four or more. Pressed, the map shows
// them alone; where it cannot take them apart, it lists them.

import * as L from "leaflet";
import { h } from "./dom";

export interface Spot { id: string; at: L.LatLng; bad: boolean; element: HTMLElement | undefined }

const near = 20;  // pixels
const least = 4;

// Each group is around its first member, in the order of [points].
export function groups(points: { id: string; x: number; y: number }[]): string[][] {
  const taken = new Set<string>(), found: string[][] = [];
  for (const seed of points) {
    if (taken.has(seed.id)) continue;
    const members = points.filter((p) => !taken.has(p.id) && Math.hypot(p.x - seed.x, p.y - seed.y) <= near).map((p) => p.id);
    if (members.length < least) continue;
    members.forEach((id) => taken.add(id));
    found.push(members);
  }
  return found;
}

// By the pointer, or by Enter.
export function pressed(marker: L.Marker, act: () => void) {
  marker.on("click", act);
  marker.on("keypress", (e) => { if (((e as unknown) as L.LeafletKeyboardEvent).originalEvent.key === "Enter") act(); });
}

export class Clusters {
  private shown = new Map<string, { marker: L.Marker; spots: Spot[] }>();
  private within = new Set<string>();

  constructor(private map: L.Map, private select: (id: string) => void, private chosen: () => void) {}

  has(id: string) { return this.within.has(id); }

  show(spots: Spot[]) {
    const at = (s: Spot) => ({ id: s.id, ...this.map.latLngToContainerPoint(s.at) });
    const byId = new Map(spots.map((s) => [s.id, s])), found = groups(spots.map(at));
    this.within = new Set(found.flat());
    for (const s of spots) if (s.element) s.element.style.display = this.within.has(s.id) ? "none" : "";
    const keys = new Set(found.map((ids) => ids.join("\n")));
    for (const [key, { marker }] of this.shown) if (!keys.has(key)) { marker.remove(); this.shown.delete(key); }
    for (const ids of found) this.draw(ids.join("\n"), ids.map((id) => byId.get(id)!));
  }

  private draw(key: string, spots: Spot[]) {
    let one = this.shown.get(key);
    if (!one) {
      const marker = L.marker(spots[0].at, { icon: L.divIcon({ className: "cluster", iconSize: [0, 0], html: h("span", {}, String(spots.length)) as any }) });
      one = { marker: marker.addTo(this.map), spots };
      this.shown.set(key, one);
      pressed(marker, () => this.open(this.shown.get(key)?.spots ?? spots));
    }
    one.spots = spots;
    one.marker.setLatLng(L.latLngBounds(spots.map((s) => s.at)).getCenter());
    const el = one.marker.getElement()!, bad = spots.filter((s) => s.bad).map((s) => s.id);
    el.classList.toggle("bad", bad.length > 0);
    const names = spots.map((s) => s.id).join(", ");
    el.title = `${spots.length} vehicles: ${names}` + (bad.length ? `; in trouble: ${bad.join(", ")}` : "");
    el.setAttribute("aria-label", el.title);
  }

  private open(spots: Spot[]) {
    const bounds = L.latLngBounds(spots.map((s) => s.at)).pad(0.3), zoom = this.map.getBoundsZoom(bounds);
    if (zoom > this.map.getZoom()) { this.chosen(); this.map.fitBounds(bounds, { animate: false }); return; }
    const choose = (id: string) => { this.map.closePopup(); this.select(id); };
    const list = h("ul", { class: "cluster-list" }, ...spots.map((s) => h("li", {}, h("button", { class: "link" + (s.bad ? " trouble" : ""), click: () => choose(s.id) }, s.id))));
    L.popup({ autoPan: false }).setLatLng(bounds.getCenter()).setContent(list).openOn(this.map);
  }
}
