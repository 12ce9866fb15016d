open Dolphin_semantics
module Phrase = Dolphin_trace.Phrase

type t = {
  now : float;
  bound : Core.vehicle list;
  running : (Core.platform_task * float) Vehicle_map.t;  (* with the time of its start *)
  seen : World.vehicle_state Vehicle_map.t;
}

let start = { now = 0.; bound = []; running = Vehicle_map.empty; seen = Vehicle_map.empty }
let most_lines = 12

let transition b ~time (s : Transition.t) =
  (* Only what a transition starts or ends is looked at: a board of a thousand vehicles changes often. *)
  let ended running v = if Vehicle_map.mem v s.next.shared.allocation then running else Vehicle_map.remove v running in
  let of_effect running : Effect.t -> _ = function
    | Start (v, p) -> Vehicle_map.add v (p, time) running
    | Stop v -> Vehicle_map.remove v running
    | Set_timer _ | Cancel_timer _ | Look_for _ | Bind _ | Release _ | Set_connection_timeout _ | Say _ | Ask _
    | Call_host _ | End _ -> running
  in
  let running = match s.label with Done (v, _) | Fail (v, _, _) -> ended b.running v | _ -> b.running in
  { b with now = time; bound = s.next.shared.bound; running = List.fold_left of_effect running s.effects }

let news b ~time (state : World.vehicle_state) = { b with now = time; seen = Vehicle_map.add state.id state b.seen }

(* {1 Lines} *)

let row b v =
  let task, time =
    match Vehicle_map.find_opt v b.running with
    | Some (p, since) -> (p.Core.name, Phrase.time (b.now -. since))
    | None -> ("-", "")
  in
  let place, battery =
    match Vehicle_map.find_opt v b.seen with
    | Some s ->
      ( Printf.sprintf "%.5f, %.5f" s.position.latitude s.position.longitude,
        if not s.connected then "no link"
        else if not (World.is_ready s) then "not ready"
        else Printf.sprintf "%.0f%%" (100. *. s.battery) )
    | None -> ("", "")
  in
  [ Phrase.one_line v; Phrase.one_line task; time; place; battery ]

let head b =
  let busy = Vehicle_map.cardinal b.running in
  Printf.sprintf "%7s  %d vehicle%s, %d busy" (Phrase.time b.now) (List.length b.bound)
    (if List.length b.bound = 1 then "" else "s")
    busy

let rec first n = function x :: rest when n > 0 -> x :: first (n - 1) rest | _ -> []

let lines b =
  if b.bound = [] then []
  else
    let rows = List.map (row b) (first most_lines b.bound) in
    let wider = List.map2 (fun width cell -> max width (Phrase.width cell)) in
    let widths = List.fold_left wider [ 0; 0; 0; 0; 0 ] rows in
    let show cells = "         " ^ String.concat "  " (List.map2 Phrase.pad widths cells) in
    let more = List.length b.bound - most_lines in
    (head b :: List.map show rows)
    @ if more > 0 then [ Printf.sprintf "         and %d more" more ] else []
