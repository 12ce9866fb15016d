(* Dark enough for white text on bars; the second is for lines on a dark ground. *)
let palette =
  [| ("#2f66a9", "#7db3f0"); ("#b5530d", "#f0a067"); ("#2a7a4b", "#6fcf97"); ("#7a4a9c", "#c79ae8");
     ("#157789", "#5fc9dc"); ("#a33b6b", "#ee93bd"); ("#7d6608", "#dcc257"); ("#56626e", "#aab6c2") |]

let colours = Array.length palette
let vehicle i = Printf.sprintf "v%d" (i mod colours)
let colour i = fst palette.(i mod colours)
let group i parts = Svg.group ~name:(Printf.sprintf "who w%d" i) parts

let light =
  {|text { font: 11px system-ui, "Helvetica Neue", Helvetica, Arial, sans-serif; fill: #1c2127; }
.paper { fill: #ffffff; }
.title { font-size: 19px; font-weight: 600; }
.heading { font-size: 12px; font-weight: 600; }
.small, .axis { fill: #5b6570; }
.axis { font-size: 10px; }
.bad { fill: #b42318; font-weight: 600; }
.grid { stroke: #e4e8ec; stroke-width: 1; }
.frame { fill: none; stroke: #b9c1c9; stroke-width: 1; }
.ruler { fill: none; stroke: #1c2127; stroke-width: 1.5; }
.halo { fill: #ffffff; opacity: 0.85; }
.held { fill: #eef1f4; }
.guide { stroke: #9aa5b0; stroke-width: 1; stroke-dasharray: 1 3; }
.leader { stroke: #9aa5b0; stroke-width: 0.7; }
.within { fill: #ffffff; font-weight: 500; }
.name { font-weight: 600; }
.name.below { font-size: 10px; font-weight: 500; }
.on-map { paint-order: stroke; stroke: #ffffff; stroke-width: 3px; stroke-opacity: 0.8; stroke-linejoin: round; }
.bar { stroke: none; }
.bar.open { fill-opacity: 0.38; }
.limit { stroke: #5b6570; stroke-width: 1; stroke-dasharray: 4 3; }
.limit.late { stroke: #d92d20; stroke-dasharray: none; }
.bar.failed, .bar.unfinished { fill-opacity: 0.82; }
.end-failed { stroke: #d92d20; stroke-width: 2.5; fill: none; }
.end-stopped { fill: #1c2127; }
.post { fill: #1c2127; } .consume { fill: #ffffff; stroke: #1c2127; stroke-width: 1.3; }
.say, .ask { fill: #2f66a9; } .ask { fill-opacity: 0.45; }
.error { stroke: #d92d20; stroke-width: 2; fill: none; }
.silent { fill: #d92d20; }
.track { fill: none; stroke-width: 1.8; stroke-linejoin: round; stroke-linecap: round; }
.planned { fill: none; stroke-width: 5; stroke-opacity: 0.24; stroke-linejoin: round; stroke-linecap: round; }
.invented { stroke-dasharray: 5 3.5; stroke-linecap: butt; }
.unseen { stroke-dasharray: 2 4; }
.fence { fill: none; stroke: #b42318; stroke-width: 1.6; stroke-dasharray: 7 3; fill-rule: evenodd; }
.fence.no-go { fill: #b42318; fill-opacity: 0.1; stroke-dasharray: none; }
.layer { fill: none; stroke-width: 1.3; stroke-linejoin: round; fill-rule: evenodd; }
.layer.filled, .layer.spot { fill-opacity: 0.1; }
.layer0 { stroke: #8a6d3b; } .layer0.filled, .layer0.spot { fill: #8a6d3b; }
.layer1 { stroke: #3b7a8a; } .layer1.filled, .layer1.spot { fill: #3b7a8a; }
.layer2 { stroke: #6d5b8a; } .layer2.filled, .layer2.spot { fill: #6d5b8a; }
.key { fill: none; stroke: #5b6570; stroke-width: 1.4; }
.key.planned { stroke-width: 5; stroke-opacity: 0.3; }
.key.flown { stroke-width: 1.8; }
.first { fill: #ffffff; stroke-width: 1.8; }
.last { stroke: #ffffff; stroke-width: 1; }
.step { fill: #ffffff; stroke-width: 1.2; }
|}

let dark =
  {|text { fill: #e6e9ed; }
.paper { fill: #14181d; }
.small, .axis { fill: #9aa5b1; }
.bad { fill: #ff8a7d; }
.grid { stroke: #272d35; }
.frame { stroke: #4a535d; }
.ruler { stroke: #e6e9ed; }
.halo { fill: #14181d; }
.held { fill: #20262d; }
.limit { stroke: #9aa5b1; }
.limit.late { stroke: #ff6b5e; }
.guide, .leader { stroke: #66717d; }
.within { fill: #ffffff; }
.end-failed, .error { stroke: #ff6b5e; }
.end-stopped { fill: #e6e9ed; }
.post { fill: #e6e9ed; } .consume { fill: #14181d; stroke: #e6e9ed; }
.say, .ask { fill: #7db3f0; }
.silent { fill: #ff6b5e; }
.first, .step { fill: #14181d; }
.key { stroke: #9aa5b1; }
.fence { stroke: #ff6b5e; } .fence.no-go { fill: #ff6b5e; }
.last, .on-map { stroke: #14181d; }
.layer0 { stroke: #c9a869; } .layer0.filled, .layer0.spot { fill: #c9a869; }
.layer1 { stroke: #6db6c9; } .layer1.filled, .layer1.spot { fill: #6db6c9; }
.layer2 { stroke: #a694c9; } .layer2.filled, .layer2.spot { fill: #a694c9; }
|}

let of_vehicle colour i pair =
  let c = colour pair in
  Printf.sprintf
    ".track.v%d, .planned.v%d, .first.v%d, .step.v%d { stroke: %s; } .last.v%d, .name.v%d { fill: %s; }\n"
    i i i i c i i c

let of_vehicles colour = String.concat "" (Array.to_list (Array.mapi (of_vehicle colour) palette))

let bars =
  let bar i (c, _) = Printf.sprintf ".bar.v%d { fill: %s; }\n" i c in
  String.concat "" (Array.to_list (Array.mapi bar palette))

let sheet =
  light ^ bars ^ of_vehicles fst
  ^ "@media screen and (prefers-color-scheme: dark) {\n"
  ^ dark ^ of_vehicles snd ^ "}\n"
