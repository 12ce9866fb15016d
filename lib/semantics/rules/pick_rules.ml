(* fit(q, w, B). *)
let candidates world (s : Shared.t) (pick : Settings.pick) =
  let is_near (v : World.vehicle_state) area = Dolphin_geo.Area.contains area (World.place world v) in
  let fits (v : World.vehicle_state) =
    Settings.accepts { pick.filter with region = None } v
    && (not (List.mem v.id s.bound))
    && Option.fold ~none:true ~some:(is_near v) pick.filter.region
  in
  List.map (fun (v : World.vehicle_state) -> v.id) (List.filter fits (World.vehicles world))

(* All lists of [n] elements of [xs] in their order, the first ones first. *)
let choices n xs : 'a list Seq.t =
  let rec from n xs length () =
    match xs with
    | _ when n = 0 -> Seq.return [] ()
    | x :: rest when n <= length ->
      let chosen = Seq.map (fun chosen -> x :: chosen) (from (n - 1) rest (length - 1)) in
      Seq.append chosen (from n rest (length - 1)) ()
    | _ -> Seq.Nil
  in
  from n xs (List.length xs)

let bind (s : Shared.t) m effects vs =
  let control = Configuration.Script (Machine.give (Vehicles vs) m) in
  Conclusion.make ~effects:(effects @ [ Effect.Bind vs ]) Pick_bind (Bind vs) control { s with bound = s.bound @ vs }

let bindings world s m (pick : Settings.pick) =
  match pick.count with
  | All -> Seq.empty
  | Exactly n ->
    Seq.map (bind s m [ Effect.Cancel_timer Residual.script_timer ]) (choices n (candidates world s pick))

(* {1 Picks that are not met} *)

let why_not world (s : Shared.t) (pick : Settings.pick) (v : World.vehicle_state) =
  let f = pick.filter in
  let place = lazy (World.place world v) in
  let is_missed area = not (Dolphin_geo.Area.contains area (Lazy.force place)) in
  let region_missed = lazy (Option.fold ~none:false ~some:is_missed f.region) in
  let reason =
    if List.mem v.id s.bound then "is already bound"
    else if not v.connected then "is not connected"
    else if Option.fold ~none:false ~some:(fun id -> id <> v.id) f.id then "has another id"
    else if Option.fold ~none:false ~some:(fun kind -> kind <> v.kind) f.kind then "is a " ^ v.kind
    else if not (World.carries f.payload v) then
      "lacks " ^ String.concat ", " (List.filter (fun d -> not (World.carries [ d ] v)) f.payload)
    else if Lazy.force region_missed then
      Format.asprintf "is at %a, outside of the region" Dolphin_geo.Position.pp (Lazy.force place)
    else "fits"
  in
  Printf.sprintf "%s %s" v.id reason

let no_vehicles world (s : Shared.t) m pick =
  let there =
    match World.vehicles world with
    | [] -> "no vehicle was heard of"
    | states ->
      let shown = List.filteri (fun i _ -> i < 8) states in
      let more = List.length states - List.length shown in
      String.concat "; " (List.map (why_not world s pick) shown)
      ^ if more > 0 then Printf.sprintf "; and %d more" more else ""
  in
  let message = Format.asprintf "could not pick %a: %s" Settings.pp_pick pick there in
  Conclusion.ending [ Pick_err ] (No_vehicles message) s (Failed (Fault.make (Machine.site m) message))

let timed_out world s m (pick : Settings.pick) =
  match pick.count, candidates world s pick with
  | All, (_ :: _ as vs) -> Some (bind s m [] vs)
  | All, [] -> Some (no_vehicles world s m pick)
  | Exactly n, vs -> if List.length vs >= n then None else Some (no_vehicles world s m pick)
