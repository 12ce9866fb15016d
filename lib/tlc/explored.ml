open Dolphin_semantics
open Dolphin_lts
module Reference = Dolphin_explore.Reference

let ending (c : Configuration.t) =
  match c.control with
  | Ended Completed -> if Tuples.is_empty c.shared.tuples then "completed" else "completed, with tuples left"
  | Ended (Halted message) -> "halted: " ^ message
  | Ended (Failed fault) -> "failed: " ^ fault.message
  | Ended Interrupted -> "interrupted"
  | Script _ | Waiting _ | Executing _ -> ""

(* {1 Labels} *)

let label_text (t : Transition.t) = Format.asprintf "%a" Label.pp t.label

(* Objects of the host are named by their calls. *)
let effect_text : Effect.t -> string = function
  | Call_host { subject; member; _ } -> "call " ^ Machine.name_of_call ~subject ~member
  | e -> Format.asprintf "%a" Effect.pp e

(* Vehicles that stop one after another, in pick order, recruits last: the semantics leaves open in which. *)
let rec in_pick_order bound : Effect.t list -> Effect.t list = function
  | Stop _ :: _ as effects ->
    let rec split stopped : Effect.t list -> _ = function
      | Stop v :: rest -> split (v :: stopped) rest
      | rest -> (stopped, rest)
    in
    let stopped, rest = split [] effects in
    let in_order = List.filter (fun v -> List.mem v stopped) bound in
    List.map (fun v -> Effect.Stop v) in_order @ in_pick_order bound rest
  | e :: rest -> e :: in_pick_order bound rest
  | [] -> []

let label_and_effects (c : Configuration.t) (t : Transition.t) =
  match in_pick_order (c.shared.bound @ Configuration.recruits c) t.effects with
  | [] -> label_text t
  | effects -> label_text t ^ " ! " ^ String.concat "; " (List.map effect_text effects)

let with_rules (t : Transition.t) text =
  Printed_graph.label ~rules:(String.concat ", " (List.map Rule.name t.rules)) text

(* {1 What is seen of a state} *)

(* One mark for all pairs of a key if their order matters, otherwise one for each pair. *)
let marks_of_key (c : Configuration.t) (k, values) =
  let pair x = Format.asprintf "%a" Value.pp_tuple (k, x) in
  if Tuples.is_ordered k c.shared.tuples then
    [ Printf.sprintf "N %s in order" (String.concat ", " (List.map pair values)) ]
  else
    let rec runs = function
      | [] -> []
      | x :: rest -> (
          match runs rest with
          | (y, n) :: others when Value.compare x y = 0 -> (y, n + 1) :: others
          | others -> (x, 1) :: others)
    in
    List.map (fun (x, n) -> Printf.sprintf "N %s * %d" (pair x) n) (runs values)

let marks (c : Configuration.t) =
  let ended = match ending c with "" -> [] | how -> [ "ended: " ^ how ] in
  let bound = if c.shared.bound = [] then [] else [ "B " ^ String.concat ", " c.shared.bound ] in
  let runs (v, (p : Core.platform_task)) = Printf.sprintf "A %s: %s" v p.name in
  ended @ bound
  @ List.map runs (Vehicle_map.bindings c.shared.allocation)
  @ List.concat_map (marks_of_key c) (Tuples.bindings c.shared.tuples)

let graph ?(effects = false) (space : Reference.t) =
  let b = Graph.Builder.create () in
  let state s (edges : (Transition.t * int) list) =
    let c = space.states.(s).configuration in
    let label t = with_rules t (if effects then label_and_effects c t else label_text t) in
    List.iter (fun (t, target) -> Graph.Builder.add b s (label t) target) edges;
    List.iter (fun m -> Graph.Builder.add b s (Printed_graph.mark m) s) (marks c)
  in
  Array.iteri state space.edges;
  Graph.Builder.finish ~states:(Array.length space.states) b
