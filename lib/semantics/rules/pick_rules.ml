open Dolphin_results

let ( let* ) = Result.bind

let candidates world s (pick : Settings.pick) = Fit.vehicles world s pick.filter

let bind (s : Shared.t) m effects vs =
  let control = Configuration.Script (Machine.give (Vehicles vs) m) in
  Conclusion.make ~effects:(effects @ [ Effect.Bind vs ]) Pick_bind (Bind vs) control { s with bound = s.bound @ vs }

let bindings world s m (pick : Settings.pick) =
  match pick.count with
  | All -> Decision.Decided Seq.empty
  | Exactly n when n > World.count world -> Decision.Decided Seq.empty
  | Exactly n ->
    let bind = bind s m [ Effect.Cancel_timer Residual.script_timer ] in
    let all candidates = Seq.map bind (Sublists.of_length n candidates) in
    Decision.look world (fun world -> Result.map all (candidates world s pick))

(* {1 Picks that are not met} *)

let why_not world (s : Shared.t) (pick : Settings.pick) (v : World.vehicle_state) =
  let f = pick.filter in
  let because reason = Ok (Printf.sprintf "%s %s" v.id reason) in
  if List.mem v.id s.bound then because "is already bound"
  else if not v.connected then because "is not connected"
  else if not (World.is_ready v) then because (Option.value v.unready ~default:"is not ready")
  else if Option.fold ~none:false ~some:(fun id -> id <> v.id) f.id then because "has another id"
  else if Option.fold ~none:false ~some:(fun kind -> kind <> v.kind) f.kind then because ("is a " ^ v.kind)
  else if not (World.carries f.payload v) then
    because ("lacks " ^ String.concat ", " (List.filter (fun d -> not (World.carries [ d ] v)) f.payload))
  else
    match f.region with
    | None -> because "fits"
    | Some area ->
      let* place = World.place world v in
      because
        (if Dolphin_geo.Area.contains area place then "fits"
         else Format.asprintf "is at %a, outside of the region" Dolphin_geo.Position.pp place)

let no_vehicles world s m (pick : Settings.pick) =
  let* there =
    match World.vehicles world with
    | [] -> Ok "no vehicle was heard of"
    | states ->
      let shown = List.filteri (fun i _ -> i < 8) states in
      let more = List.length states - List.length shown in
      let* reasons = Results.map (why_not world s pick) shown in
      Ok (String.concat "; " reasons ^ if more > 0 then Printf.sprintf "; and %d more" more else "")
  in
  let message = Format.asprintf "could not pick %a: %s" Settings.pp_pick pick there in
  Ok
    (if pick.otherwise then Conclusion.make Pick_else (No_vehicles message) (Script (Machine.give Null m)) s
     else Conclusion.ending [ Pick_err ] (No_vehicles message) s (Failed (Fault.make (Machine.site m) message)))

let timed_out world s m (pick : Settings.pick) =
  Decision.look world (fun world ->
      let* candidates = candidates world s pick in
      match pick.count, candidates with
      | All, (_ :: _ as vs) -> Ok (Some (bind s m [] vs))
      | Exactly n, vs when List.length vs >= n -> Ok None
      | (All | Exactly _), _ -> Result.map Option.some (no_vehicles world s m pick))
