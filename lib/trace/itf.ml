open Dolphin_semantics
open Core

let text x = `String x
let unserializable x : Yojson.Safe.t = `Assoc [ ("#unserializable", text x) ]
let integer i : Yojson.Safe.t = `Assoc [ ("#bigint", text (string_of_int i)) ]
let map entries : Yojson.Safe.t = `Assoc [ ("#map", `List (List.map (fun (k, x) -> `List [ text k; x ]) entries)) ]

let rec value : value -> Yojson.Safe.t = function
  | Boolean b -> `Bool b
  | Integer i -> integer i
  | String s -> text s
  | List xs -> `List (List.map value (Vector.to_list xs))
  | Map entries -> map (List.map (fun (k, x) -> (k, value x)) entries)
  | Vehicles vs -> `List (List.map text vs)
  | ( Null | Number _ | Wildcard | Symbol _ | Range _ | Position _ | Area _ | Task _ | Closure _ | Host _
    | Settings _ | Reading _ | Unknown _ ) as x -> unserializable (Format.asprintf "%a" Value.pp x)

let control program (c : Configuration.t) : Yojson.Safe.t =
  let place fault =
    match Fault.location program fault with
    | Some at -> [ ("at", text (Format.asprintf "%a" Dolphin_syntax.Location.pp at)) ]
    | None -> []
  in
  let at m = place (Fault.make (Machine.site m) "") in
  let state name more = `Assoc (("state", text name) :: more) in
  match c.control with
  | Script m -> state "script" (at m)
  | Waiting (m, _) -> state "waiting" (at m)
  | Executing (m, r) -> state "executing" (at m @ [ ("task", text (Format.asprintf "%a" Residual.pp r)) ])
  | Ended Completed -> state "completed" []
  | Ended Interrupted -> state "interrupted" []
  | Ended (Halted message) -> state "halted" [ ("message", text message) ]
  | Ended (Failed fault) -> state "failed" (place fault @ [ ("message", text fault.message) ])

let variables program (c : Configuration.t) =
  let running = Vehicle_map.bindings c.shared.allocation in
  let pairs (k, xs) = (k, `List (List.map value xs)) in
  let variable (i, x) = (program.global_names.(i), value x) in
  [ ("control", control program c);
    ("A", map (List.map (fun (v, (p : platform_task)) -> (v, text p.name)) running));
    ("B", `List (List.map text c.shared.bound));
    ("N", map (List.map pairs (Tuples.bindings c.shared.tuples)));
    ("store", map (List.map variable (Store.bindings c.shared.store))) ]

let way (t : Transition.t) =
  let rule r = text (Rule.name r) in
  let assumed a = text (Format.asprintf "%a" World.pp_assumption a) in
  [ ("label", text (Format.asprintf "%a" Label.pp t.label)); ("rules", `List (List.map rule t.rules)) ]
  @ if t.assumed = [] then [] else [ ("assumed", `List (List.map assumed t.assumed)) ]

let without_last xs = List.filteri (fun i _ -> i < List.length xs - 1) xs

let trace program ~description c steps ~cycle : Yojson.Safe.t =
  (* The last transition of a cycle leads to a state that is there already. *)
  let shown = steps @ without_last cycle in
  let state i (way, c) = `Assoc (("#meta", `Assoc (("index", `Int i) :: way)) :: variables program c) in
  let states = ([], c) :: List.map (fun (t : Transition.t) -> (way t, t.next)) shown in
  let loop, back =
    match List.rev cycle with
    | [] -> ([], [])
    | last :: _ -> ([ ("loop", `Int (List.length steps)) ], [ ("back", `Assoc (way last)) ])
  in
  let meta =
    [ ("format", text "ITF");
      ("format-description", text "https://apalache-mc.org/docs/adr/015adr-trace.html");
      ("source", text program.source_name);
      ("description", text description) ]
    @ back
  in
  let vars = `List (List.map (fun (name, _) -> text name) (variables program c)) in
  `Assoc ([ ("#meta", `Assoc meta); ("vars", vars); ("states", `List (List.mapi state states)) ] @ loop)
