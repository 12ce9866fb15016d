// The quantities that vehicles report: battery, speed, depth, altitude, and their own readings.

import type { Sample, Vehicle } from "./model";

export interface Quantity { name: string; unit: string; of: (s: Sample) => number | null | undefined }

const usual: Quantity[] = [
  { name: "battery", unit: "%", of: (s) => (s.battery === null ? null : s.battery * 100) },
  { name: "speed", unit: "m/s", of: (s) => s.speed },
  { name: "depth", unit: "m", of: (s) => s.depth },
  { name: "altitude", unit: "m", of: (s) => s.altitude },
];

// Those that one of these vehicles has reported.
export function quantities(vehicles: Vehicle[]): Quantity[] {
  const names = new Set<string>(), there = new Set<Quantity>();
  for (const { samples } of vehicles) for (const s of samples) {
    for (const name in s.readings) names.add(name);
    for (const q of usual) if (typeof q.of(s) === "number") there.add(q);
  }
  return [...usual.filter((q) => there.has(q)), ...[...names].sort().map((name) => ({ name, unit: "", of: (s: Sample) => s.readings?.[name] }))];
}

export const brief = (x: number) => (Math.abs(x) >= 100 ? x.toFixed(0) : Math.abs(x) >= 10 ? x.toFixed(1) : x.toFixed(2));
