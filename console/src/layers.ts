// Layers of one's own below the vehicles: GeoJSON files of the folder, and the tiles that the console was started with.

import * as L from "leaflet";
import { type Json, get } from "./api";
import { $, h } from "./dom";
import type { ChartMap } from "./map";

export class Layers {
  private shown = new Map<string, L.GeoJSON>();
  private chosen: Set<string> = new Set(JSON.parse(localStorage.getItem("layers") ?? "[]"));
  private ground: L.TileLayer | null = null;
  private groundUrl: string | null = null;

  constructor(private map: ChartMap, private tell: (why: string) => void) {}

  // A box for each layer there is; those that were shown before are shown again.
  offer(paths: string[]) {
    $("layers").hidden = paths.length === 0;
    $("layer-list").replaceChildren(...paths.map((path) => h("label", { class: "check" },
      h("input", { type: "checkbox", checked: this.chosen.has(path), change: (e: Event) => void this.choose(path, (e.target as HTMLInputElement).checked) }), path)));
    for (const path of paths) if (this.chosen.has(path)) void this.choose(path, true);
  }

  tiles(url: string | null) {
    if (url === this.groundUrl) return;
    this.ground?.remove();
    this.groundUrl = url;
    this.ground = url ? L.tileLayer(url, { maxZoom: 21 }).addTo(this.map.map) : null;
  }

  private async choose(path: string, on: boolean) {
    if (on) this.chosen.add(path); else this.chosen.delete(path);
    localStorage.setItem("layers", JSON.stringify([...this.chosen]));
    this.shown.get(path)?.remove();
    this.shown.delete(path);
    if (!on) return;
    try {
      const json = JSON.parse((await get("file?path=" + encodeURIComponent(path))).text);
      if (this.chosen.has(path)) this.shown.set(path, this.layer(json).addTo(this.map.map));
    } catch (e) { this.tell(`${path} is no GeoJSON that can be shown: ${(e as Error).message}`); }
  }

  private layer(json: Json) {
    return L.geoJSON(json, {
      style: () => ({ color: "#8a3ab9", weight: 1.5, fillOpacity: 0.07 }),
      pointToLayer: (_, at) => L.circleMarker(at, { radius: 4 }),
      onEachFeature: (feature, layer) => {
        const name = feature.properties?.name ?? feature.properties?.title;
        if (name !== undefined) layer.bindTooltip(document.createTextNode(String(name)) as any);
      },
    });
  }
}
