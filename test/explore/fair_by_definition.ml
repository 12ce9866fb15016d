(* Termination of tasks with rounds by the definition of fairness: on the graph of [Reference], by labels and rules
   alone. Each step that is possible is followed until it is taken, not possible, or of a round that is over. If no run
   of a strongly connected component can come to that, no fair run stays in it. Programs are such that a label, the
   rule, and the parallel part identify the step. *)

open Dolphin_semantics
open Dolphin_environment
open Dolphin_explore

(* {1 Steps} *)

let side_by_side (c : Configuration.t) =
  match c.control with
  | Executing (_, Parallel bs) -> Branches.to_list bs
  | Executing (_, r) -> [ r ]
  | Script _ | Waiting _ | Ended _ -> []

exception Ambiguous

(* The part that takes the step, if all stays as it is: the one that does so alone. *)
let unchanged world (g : Reference.t) i (t : Transition.t) =
  let { Reference.configuration = c; outside } = g.states.(i) in
  let alone r =
    match c.control with
    | Executing (machine, _) -> { c with control = Executing (machine, r) }
    | Script _ | Waiting _ | Ended _ -> c
  in
  let takes r =
    let is_it ((t' : Transition.t), _) =
      Label.equal t.label t'.label && Configuration.equal t'.next (alone r)
    in
    List.exists is_it (List.of_seq (Environment.choices g.options g.program world outside (alone r)))
  in
  match List.filter (fun (_, r) -> takes r) (List.mapi (fun i r -> (i, r)) (side_by_side c)) with
  | [ (part, _) ] -> part
  | [] | _ :: _ -> raise Ambiguous

(* The part that takes the step. *)
let part_of world g i (t : Transition.t) =
  let rec changed at = function
    | r :: rs, r' :: rs' -> if Residual.equal r r' then changed (at + 1) (rs, rs') else at
    | _ :: _, [] -> at
    | [], _ -> unchanged world g i t
  in
  changed 0 (side_by_side g.Reference.states.(i).configuration, side_by_side t.next)

type edge = {
  into : int;
  step : string;
  inside : bool;
  closes : bool;
  endless : bool;
  part : int;
  is_event : bool;
  looks : World.assumption list list;
  owed_strongly : string option;  (* its name, if a strongly fair run has to take it *)
}

let edge world (g : Reference.t) i ((t : Transition.t), into) =
  let before = side_by_side g.states.(i).configuration in
  let part = part_of world g i t in
  let has rule = List.mem rule t.rules in
  let closes = has Rule.Repeat_2 || has Repeat_again in
  let is_endless found = function Residual.Repeat { again = { until = None; _ }; _ } -> true || found | _ -> found in
  let endless =
    has Watch_retry || (closes && Residual.fold_all is_endless false (List.nth before part))
  in
  let inside = has Repeat_1 || has Repeat_2 in
  let step =
    match t.label, t.rules with
    | (Done (v, name) | Fail (v, name, _)), _ -> Printf.sprintf "%s ends on %s" name v
    | Act deeds, _ -> String.concat ", " (List.filter_map (function Code.Said m -> Some m | _ -> None) deeds)
    | Allocate _, _ -> Printf.sprintf "allocate in %d" part
    | _, (Repeat_until | Repeat_again) :: _ -> Printf.sprintf "asked in %d" part
    | label, rule :: _ -> Format.asprintf "%a by %s in %d, %B" Label.pp label (Rule.name rule) part inside
    | _, [] -> Alcotest.fail "a transition without a rule"
  in
  let owed_strongly =
    match t.label, t.rules with
    | Done (v, name), _ -> Some (Printf.sprintf "%s is done on %s" name v)
    | (Start _ | Act _ | Set_time _ | Make), _ | _, (Repeat_until | Repeat_again) :: _ -> Some step
    | _, _ -> None
  in
  let is_event = match t.label with Done _ | Fail _ | Time_out -> true | _ -> false in
  { into; step; inside; closes; endless; part; is_event; looks = t.assumed :: t.otherwise;
    owed_strongly }

(* {1 Fairness} *)

type verdict = Ends | Goes_on | By_design

let executes (g : Reference.t) i = side_by_side g.states.(i).configuration <> []

(* The states reachable by one edge or more. *)
let reached edges from =
  let found = Hashtbl.create 16 in
  let rec go i =
    let arrive e =
      if not (Hashtbl.mem found e.into) then begin
        Hashtbl.add found e.into ();
        go e.into
      end
    in
    List.iter arrive edges.(i)
  in
  go from;
  found

let components edges =
  let reach = Array.init (Array.length edges) (reached edges) in
  let of_state i =
    let is_in j = Hashtbl.mem reach.(i) j && Hashtbl.mem reach.(j) i in
    List.filter is_in (List.init (Array.length edges) Fun.id)
  in
  List.sort_uniq compare (List.filter (fun c -> c <> []) (List.init (Array.length edges) of_state))

(* Whether some run within the component, from [i], comes to a state in which it need not take this step any more. *)
let is_settled all edges members i (owed : edge) =
  let seen = Hashtbl.create 16 in
  let is_over e = e.step = owed.step || (owed.inside && e.closes && e.part = owed.part) in
  let rec go i =
    let is_possible = List.exists (fun e -> e.step = owed.step) all.(i) in
    (not is_possible)
    || (not (Hashtbl.mem seen i))
       && begin
         Hashtbl.add seen i ();
         let goes_on e = List.mem e.into members && (is_over e || go e.into) in
         List.exists goes_on edges.(i)
       end
  in
  go i

let is_fair all edges members =
  List.for_all (fun i -> List.for_all (is_settled all edges members i) all.(i)) members

(* The parts of the graph within which strongly fair runs may stay: of a component, a part without the states in which a
   step is possible that is owed, and that the component does not take. *)
let rec strongly_fair all edges =
  let names es = List.filter_map (fun e -> e.owed_strongly) es in
  let of_component members =
    let is_in e = List.mem e.into members in
    let inside = Array.mapi (fun i es -> if List.mem i members then List.filter is_in es else []) edges in
    let taken = names (List.concat (Array.to_list inside)) in
    let misses i = List.exists (fun name -> not (List.mem name taken)) (names all.(i)) in
    let without i es = if misses i then [] else List.filter (fun e -> not (misses e.into)) es in
    if List.exists misses members then strongly_fair all (Array.mapi without inside) else [ (inside, fun _ -> true) ]
  in
  List.concat_map of_component (components edges)

let all_edges world (g : Reference.t) =
  Array.mapi (fun i edges -> if executes g i then List.map (edge world g i) edges else []) g.edges

(* [divided edges] is the graphs, each with its demand on a component, one of which has to have a fair one. *)
let judged ?(divided = fun edges -> [ (edges, fun _ -> true) ]) (g : Reference.t) all =
  let kept p = Array.map (List.filter (fun e -> executes g e.into && p e)) all in
  let has_fair p =
    let has (edges, is_met) =
      List.exists (fun members -> is_met members && is_fair all edges members) (components edges) in
    List.exists has (divided (kept p))
  in
  if components (kept (fun e -> not e.is_event)) <> [] then Goes_on
  else if has_fair (fun e -> not e.endless) then Goes_on
  else if has_fair (fun _ -> true) then By_design
  else Ends
