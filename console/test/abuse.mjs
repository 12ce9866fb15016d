// Hostile clients that watch: node test/abuse.mjs ORIGIN TOKEN OPENAPI WALKERS. They keep doing, in parallel, what costs a
// server most; and as many walkers as given make each request of docs/openapi.json in turn, but that of Stop, with values
// of its schema, with hostile ones, and without a token. It prints a line for each thing that it has begun.
import { readFileSync } from "node:fs";

const [origin, token, openapi, walkers] = process.argv.slice(2);
const authorization = { Authorization: "Bearer " + token };

async function post(client, path, body) {
  const headers = { ...authorization, "Content-Type": "application/json", "X-Dolphin-Client": client };
  await (await fetch(`${origin}/api/${path}`, { method: "POST", headers, body: JSON.stringify(body) })).text();
}

async function get(client, path, least = Infinity) {
  const stop = new AbortController();
  const reply = await fetch(`${origin}/api/${path}`, { headers: { ...authorization, "X-Dolphin-Client": client }, signal: stop.signal });
  let length = 0;
  for await (const piece of reply.body) if ((length += piece.length) >= least) break;
  stop.abort();
}

const assignments = Array.from({ length: 4000 }, (_, i) => `x${i} = ${i}`).join("\n");
const attacks = [
  (client) => post(client, "check", { path: "mission.dol", text: assignments }),
  (client) => post(client, "check", { path: "mission.dol", text: assignments }),
  (client) => get(client, "replay?path=long.run"),
  (client) => get(client, "replay?path=long.run", 1_000_000),
  (client) => post(client, "check", { path: "mission.dol", text: "include 'pipe.dol'\nx = map 'pipe.geojson'\n" }),
  (client) => get(client, "file?path=pipe.dol"),
  (client) => get(client, "world?program=mission.dol&fleet=pipe.fleet"),
  (client) => post(client, "plans", { program: "mission.dol", fleet: "pipe.fleet" }),
  (client) => get(client, "runs"),
  (client) => get(client, "files"),
];

for (const [i, attack] of attacks.entries())
  for (const twin of [1, 2]) {
    const client = `watcher-${i}-${twin}`;
    (async () => {
      for (;;) {
        const done = attack(client).catch(() => {});
        console.log(i);
        await done;
        // What is refused comes back at once.
        await new Promise((go) => setTimeout(go, 5));
      }
    })();
  }

// {1 Each request}

const file = JSON.parse(readFileSync(openapi, "utf8"));
const operations = Object.entries(file.paths).flatMap(([path, verbs]) => Object.entries(verbs)
  .filter(([verb]) => ["get", "put", "post", "delete", "patch"].includes(verb)).map(([verb, { parameters = [], requestBody }]) =>
    ({ verb: verb.toUpperCase(), path, parameters, schema: requestBody?.content?.["application/json"]?.schema })))
  .filter(({ path }) => path !== "/api/run/stop");

const names = ["mission.dol", "long.run", "pipe.dol", "mission.fleet", "../mission.dol", "-rf.dol", "", "a".repeat(5000), "\u0000", "${1}"];
const texts = [assignments, "x = " + "(".repeat(20000), "'", "while (true) { }", "v = pick { count 100000 }", "\u2028".repeat(1000)];
const draw = (list) => list[Math.floor(Math.random() * list.length)];

// A value of the schema; its texts are hostile.
function valueOf(schema, name, depth = 0) {
  if (!schema || depth > 8) return null;
  if (schema.$ref) return valueOf(file.components.schemas[schema.$ref.split("/").pop()], name, depth + 1);
  const choices = schema.oneOf ?? schema.anyOf;
  if (choices) return valueOf(draw(choices), name, depth + 1);
  if (schema.allOf) return Object.assign({}, ...schema.allOf.map((part) => valueOf(part, name, depth + 1)));
  if (schema.enum) return draw(schema.enum);
  if (schema.const !== undefined) return schema.const;
  const type = Array.isArray(schema.type) ? draw(schema.type) : schema.type;
  if (type === "object" || schema.properties)
    return Object.fromEntries(Object.entries(schema.properties ?? {}).map(([key, part]) => [key, valueOf(part, key, depth + 1)]));
  if (type === "array") return Array.from({ length: 3 }, () => valueOf(schema.items, name, depth + 1));
  if (type === "integer" || type === "number") return draw([0, 1, -1, 1e9, 0.5, 2 ** 53, 1e308]);
  if (type === "boolean") return Math.random() < 0.5;
  if (type === "null") return null;
  return draw(/text|content/.test(name ?? "") ? texts : names);
}

const hostile = [() => "[".repeat(50000), () => JSON.stringify({ path: { path: [] }, program: 1, text: [] }), () => "", () => "{\"text\":\"" + "x".repeat(300000) + "\"}", () => "null"];

async function request({ verb, path, parameters, schema }) {
  const headers = { "Content-Type": "application/json", "X-Dolphin-Client": "walker-" + Math.floor(Math.random() * 50) };
  if (Math.random() < 0.8) Object.assign(headers, authorization);
  const query = new URLSearchParams(parameters.filter((p) => p.in === "query").map((p) => [p.name, String(valueOf(p.schema, p.name))]));
  const body = verb === "GET" ? undefined : Math.random() < 0.6 ? JSON.stringify(valueOf(schema)) : draw(hostile)();
  const reply = await fetch(`${origin}${path}?${query}`, { method: verb, headers, body, signal: AbortSignal.timeout(1500) });
  let length = 0;
  for await (const piece of reply.body) if ((length += piece.length) > 200000) break;
}

for (let walker = 0; walker < Number(walkers); walker++) (async () => {
  for (let i = walker; ; i++) {
    const operation = operations[i % operations.length];
    const done = request(operation).catch(() => {});
    console.log(`${operation.verb} ${operation.path}`);
    await done;
    await new Promise((go) => setTimeout(go, 5));
  }
})();
console.log(`operations ${operations.length}`);
