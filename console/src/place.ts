// Places in programs, as journals and faults have them: "3:5" in the program itself, "lib/areas.dol:3:5" in a file that
// it includes, seen from the folder of the program.

export interface SourcePlace { file: string | null; line: number }

export function read(at: string): SourcePlace | null {
  const found = /^(?:(.*):)?(\d+):\d+$/.exec(at);
  return found ? { file: found[1] ?? null, line: Number(found[2]) } : null;
}

export function inWords(at: string): string {
  const place = read(at);
  return !place ? at : (place.file ? place.file + " " : "") + "line " + place.line;
}

// What [file] is called below the console's folder; null: it lies elsewhere.
export function beside(program: string, file: string): string | null {
  const parts = program.split("/").slice(0, -1);
  if (file.startsWith("/") || file.startsWith("<")) return null;
  for (const part of file.split("/"))
    if (part === "..") { if (!parts.length) return null; parts.pop(); }
    else if (part !== ".") parts.push(part);
  return parts.join("/");
}
