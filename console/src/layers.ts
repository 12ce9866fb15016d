// Layers of one's own below the vehicles: maps and tiles of the folder, and the tiles that the console was started with.

import * as L from "leaflet";
import { type Json, get } from "./api";
import { $, h } from "./dom";
import type { ChartMap } from "./map";

const look = { color: "#8a3ab9", weight: 1.5, fillOpacity: 0.07 };

export class Layers {
  private shown = new Map<string, L.Layer>();
  private chosen: Set<string> = new Set(JSON.parse(localStorage.getItem("layers") ?? "[]"));
  private ground: L.TileLayer | null = null;
  private groundUrl: string | null = null;

  constructor(private map: ChartMap, private tell: (why: string) => void) {}

  // A box for each layer there is; those that were shown before are shown again.
  offer(paths: string[]) {
    $("layers").hidden = paths.length === 0;
    $("layer-list").replaceChildren(...paths.map((path) => h("label", { class: "check", "data-path": path },
      h("input", { type: "checkbox", checked: this.chosen.has(path), change: (e: Event) => void this.choose(path, (e.target as HTMLInputElement).checked) }), path)));
    for (const path of paths) if (this.chosen.has(path)) void this.choose(path, true);
  }

  turnOn(path: string) {
    const box = $("layer-list").querySelector<HTMLInputElement>(`[data-path="${CSS.escape(path)}"] input`);
    if (box) box.checked = true;
    if (box) void this.choose(path, true);
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
    this.credit(path, "");
    if (!on) return;
    try {
      const found = await get("layer?path=" + encodeURIComponent(path));
      if (!this.chosen.has(path)) return;
      const layer = found.tiles ? pictures(path, found.tiles) : L.layerGroup(found.shapes.map(shape));
      this.shown.get(path)?.remove();
      this.shown.set(path, layer.addTo(this.map.map));
      if (found.tiles) this.credit(path, found.tiles.attribution);
    } catch (e) { this.tell((e as Error).message); }
  }

  // The source of its pictures, beside its box.
  private credit(path: string, whom: string) {
    const label = $("layer-list").querySelector(`[data-path="${CSS.escape(path)}"]`);
    label?.querySelector("small")?.remove();
    const text = new DOMParser().parseFromString(whom, "text/html").body.textContent?.trim();
    if (text) label?.append(h("small", {}, " " + text));
  }
}

function pictures(path: string, t: Json): L.TileLayer {
  const bounds = t.bounds && L.latLngBounds([t.bounds[1], t.bounds[0]], [t.bounds[3], t.bounds[2]]);
  return L.tileLayer(`/api/tile?path=${encodeURIComponent(path)}&zoom={z}&column={x}&row={y}`,
    { minNativeZoom: t.minimum, maxNativeZoom: t.maximum, maxZoom: 21, noWrap: true, ...(bounds ? { bounds } : {}) });
}

function shape(s: Json): L.Layer {
  const layer = s.position ? L.circleMarker(s.position, { ...look, radius: 4 })
    : s.line ? L.polyline(s.line, look)
    : s.centre ? L.circle(s.centre, { ...look, radius: s.radius })
    : L.polygon(s.rings, look);
  return s.name ? layer.bindTooltip(document.createTextNode(s.name) as any) : layer;
}
