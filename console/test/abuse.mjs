// A hostile client that watches: node test/abuse.mjs ORIGIN TOKEN. It keeps doing, in parallel, all that a watcher may,
// and prints a line for each thing that it has begun.
const [origin, token] = process.argv.slice(2);
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
