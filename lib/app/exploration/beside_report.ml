open Dolphin_semantics
module Safe_print = Dolphin_display.Safe_print
module Side_by_side = Dolphin_explore.Side_by_side
module Position = Dolphin_geo.Position

let called (program : Program_file.t) (v, (p : Core.platform_task)) =
  let place = Option.fold (Program_file.at program p.task_site) ~none:"" ~some:(Printf.sprintf "%s: ") in
  Printf.sprintf "%splan %s on %s" place (Side_by_side.name p) v

let line program (pair : Side_by_side.pair) =
  let both = Printf.sprintf "%s, beside %s" (called program pair.one) (called program pair.other) in
  match pair.nearness with
  | Unknown -> both ^ ": distance unknown"
  | Near near ->
    Format.asprintf "%s: %.1f m between %s and %s, at %a" both near.metres near.maneuver near.other Position.pp
      near.place

let print program pairs =
  if pairs <> [] then begin
    Safe_print.line "\nplans that may run side by side:";
    List.iter (fun pair -> Safe_print.line ("  " ^ line program pair)) pairs
  end

let json_of_pair program (pair : Side_by_side.pair) : Yojson.Safe.t =
  let plan (v, (p : Core.platform_task)) maneuver : Yojson.Safe.t =
    let at = Option.fold (Program_file.at program p.task_site) ~none:`Null ~some:(fun at -> `String at) in
    `Assoc
      ([ ("plan", `String p.name); ("vehicle", `String v); ("at", at) ]
       @ Option.fold maneuver ~none:[] ~some:(fun m -> [ ("maneuver", `String m) ]))
  in
  let both one other = [ ("one", plan pair.one one); ("other", plan pair.other other) ] in
  match pair.nearness with
  | Unknown -> `Assoc (both None None @ [ ("metres", `Null) ])
  | Near near ->
    (* To a millimetre, and to a centimetre on the ground. *)
    let number digits x : Yojson.Safe.t = `Float (Dolphin_maps.Map_text.rounded digits x) in
    `Assoc
      (both (Some near.maneuver) (Some near.other)
       @ [ ("metres", number 3 near.metres); ("latitude", number 7 near.place.latitude);
           ("longitude", number 7 near.place.longitude) ])

let json program pairs : Yojson.Safe.t = `List (List.map (json_of_pair program) pairs)
