// Tracks on the map beyond those of the run that is shown: of a second run, dotted; and all of them coloured by a reading.

import * as L from "leaflet";
import { h, svg } from "./dom";
import type { Run, Sample, Vehicle } from "./model";
import { type Quantity, brief } from "./quantities";

// Viridis: in order of lightness, also for the colour-blind.
const scale = ["#440154", "#46327e", "#365c8d", "#277f8e", "#1fa187", "#4ac16d", "#a0da39", "#fde725"];

export interface Spot { sample: Sample; tint: string }

export class Tracks {
  private second = L.layerGroup();
  private coloured = L.layerGroup();
  private spots = L.layerGroup();
  private key = "";
  private colourKey = "";
  private legend = h("div", { class: "map-legend tracks", hidden: true, role: "img" });

  constructor(map: L.Map) {
    for (const layer of [this.second, this.coloured, this.spots]) layer.addTo(map);
    new (L.Control.extend({ onAdd: () => this.legend }))({ position: "bottomleft" }).addTo(map);
  }

  points(): L.LatLng[] {
    return this.second.getLayers().flatMap((l) => (l instanceof L.Polyline ? (l.getLatLngs() as L.LatLng[]) : []));
  }

  // The second run: dotted tracks, and rings where its vehicles are. Whether there is more of it than before.
  show(run: Run | null, tint: (id: string) => string): boolean {
    const vehicles = run ? [...run.vehicles.values()].filter((v) => v.samples.length) : [];
    const key = JSON.stringify(vehicles.map((v) => [v.id, v.samples.length, v.samples[v.samples.length - 1].time]));
    if (key === this.key) return false;
    this.key = key;
    this.second.clearLayers();
    for (const v of vehicles) {
      const last = v.samples[v.samples.length - 1], at = L.latLng(last.latitude, last.longitude), colour = tint(v.id);
      L.polyline(v.samples.map((s) => L.latLng(s.latitude, s.longitude)),
        { color: colour, weight: 3, dashArray: "1 7", lineCap: "round", interactive: false, renderer: L.svg(), className: "second" }).addTo(this.second);
      L.circleMarker(at, { radius: 7, color: colour, weight: 2, fill: false, interactive: false }).addTo(this.second);
      L.marker(at, { interactive: false, keyboard: false, icon: L.divIcon({ className: "second-name", iconSize: [0, 0],
        html: h("span", {}, `${v.id}, second run`) as any }) }).addTo(this.second);
    }
    return true;
  }

  // The tracks of these vehicles in the colours of a reading; null: in none.
  colour(quantity: Quantity | null, vehicles: Vehicle[]) {
    const key = quantity ? JSON.stringify([quantity.name, vehicles.map((v) => [v.id, v.samples.length, v.samples[v.samples.length - 1]?.time])]) : "";
    if (key === this.colourKey) return;
    this.colourKey = key;
    this.coloured.clearLayers();
    this.legend.hidden = true;
    if (!quantity) return;
    let least = Infinity, most = -Infinity;
    for (const v of vehicles) for (const s of v.samples) {
      const value = quantity.of(s);
      if (typeof value === "number") { least = Math.min(least, value); most = Math.max(most, value); }
    }
    if (least > most) return;
    // One line of many parts for each colour.
    const parts: L.LatLng[][][] = scale.map(() => []);
    for (const { samples } of vehicles)
      for (let i = 1; i < samples.length; i++) {
        const value = quantity.of(samples[i]);
        if (typeof value !== "number") continue;
        const n = most > least ? Math.min(scale.length - 1, Math.floor(((value - least) / (most - least)) * scale.length)) : 0;
        parts[n].push([samples[i - 1], samples[i]].map((s) => L.latLng(s.latitude, s.longitude)));
      }
    for (const [color, weight] of [["#fff", 7], [null, 4]] as const)
      parts.forEach((lines, n) => {
        if (lines.length) L.polyline(lines, { color: color ?? scale[n], weight, interactive: false, smoothFactor: 0 }).addTo(this.coloured);
      });
    this.explain(quantity, least, most);
  }

  private explain({ name, unit }: Quantity, least: number, most: number) {
    const text = `${name}: ${brief(least)} to ${brief(most)} ${unit}`.trim();
    const bar = svg("svg", { width: 128, height: 10 }, ...scale.map((fill, n) => svg("rect", { x: n * 16, y: 0, width: 16, height: 10, fill })));
    this.legend.replaceChildren(h("b", {}, name), h("span", {}, brief(least)), bar, h("span", {}, `${brief(most)} ${unit}`));
    this.legend.setAttribute("aria-label", "Tracks by " + text);
    this.legend.hidden = false;
  }

  // Rings at these places.
  mark(spots: Spot[]) {
    this.spots.clearLayers();
    for (const { sample, tint } of spots)
      L.circleMarker([sample.latitude, sample.longitude], { radius: 9, color: tint, weight: 3, fill: false, interactive: false }).addTo(this.spots);
  }
}
