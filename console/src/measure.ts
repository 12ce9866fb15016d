// Measuring on the map: a way of points, its length and the bearing of its last part.

import * as L from "leaflet";
import { h } from "./dom";

export class Measure {
  readonly button = h("button", { class: "map-button", type: "button", "aria-pressed": "false", title: "Distances: click points, Escape ends" }, "Measure");
  private line = L.polyline([], { color: "#a8123e", weight: 2, interactive: false });
  private points: L.LatLng[] = [];
  private on = false;

  constructor(private map: L.Map) {
    this.button.addEventListener("click", () => this.toggle(!this.on));
    map.on("click", (e) => { if (this.on) { this.points.push(e.latlng); this.draw(e.latlng); } });
    map.on("mousemove", (e) => { if (this.on && this.points.length) this.draw(e.latlng); });
    window.addEventListener("keydown", (e) => { if (this.on && e.key === "Escape") this.toggle(false); });
  }

  private toggle(on: boolean) {
    this.on = on;
    this.points = [];
    this.button.setAttribute("aria-pressed", String(on));
    this.map.getContainer().classList.toggle("measures", on);
    if (on) this.line.setLatLngs([]).addTo(this.map); else this.line.remove();
    this.button.textContent = on ? "Measure: click points" : "Measure";
  }

  private draw(last: L.LatLng) {
    const way = [...this.points, last];
    this.line.setLatLngs(way);
    let length = 0;
    for (let i = 1; i < way.length; i++) length += way[i - 1].distanceTo(way[i]);
    const from = way.length > 1 && way[way.length - 2].distanceTo(last) > 0.01 ? way[way.length - 2] : way[Math.max(0, way.length - 3)];
    this.button.textContent = `${distance(length)}, ${bearing(from, last)}°`;
  }
}

export const distance = (m: number) => (m < 1000 ? `${Math.round(m)} m` : `${(m / 1000).toFixed(2)} km`);

function bearing(a: L.LatLng, b: L.LatLng) {
  const r = Math.PI / 180, east = (b.lng - a.lng) * r;
  const y = Math.sin(east) * Math.cos(b.lat * r);
  const x = Math.cos(a.lat * r) * Math.sin(b.lat * r) - Math.sin(a.lat * r) * Math.cos(b.lat * r) * Math.cos(east);
  return String(Math.round((Math.atan2(y, x) / r + 360) % 360)).padStart(3, "0");
}
