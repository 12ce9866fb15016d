open Dolphin_semantics
open Dolphin_environment
open Dolphin_app
module I = Interpreter
module Property = Dolphin_explore.Property

type verdict = Certified of int option | Refuted of { state : int; why : string }

(* {1 The outside} *)

type outside = {
  options : Environment.options;
  program : Core.program;
  world : World.t;
  vehicles : Core.vehicle list;
  answers : (string, Core.closure) Hashtbl.t;  (* the code of the texts that answered so far *)
}

let outside options program world =
  { options; program; world; vehicles = List.map (fun (v : World.vehicle_state) -> v.id) (World.vehicles world);
    answers = Hashtbl.create 10 }

let plain x c = Terms.to_configuration ~vehicles:x.vehicles c

let code_at ?undecided x (c : I.configuration) =
  let machine =
    match c.control_of with Script m | Wait (m, _) | Exec (m, _) -> Some m | End _ -> None in
  Interpretation.code ?undecided x.program ~vehicles:x.vehicles ~machine ~answer:(Hashtbl.find_opt x.answers)

(* The vehicles that a pick binds are those that are there, in this order. *)
let world_of x (t : Transition.t) =
  let world = World.suppose t.assumed x.world in
  match t.label with Bind vs -> World.only vs world | _ -> world

(* The steps on [event], by default the program's own, in [world], and the first question that was left open. *)
let steps ?event x c world =
  let question = ref None in
  let undecided q = if !question = None then question := Some q in
  match I.cderivations Terms.names (code_at ~undecided x c) world event c with
  | steps -> (steps, !question)
  | exception Interpretation.Undecided -> ([], !question)

(* A transition that is the same whatever an open value is assumes nothing: [world] with all such values. *)
let rec closed ?event x c (ts : Transition.t list) world =
  let is_there steps (t : Transition.t) =
    let next = lazy (plain x (Terms.configuration t.next)) in
    let is_it (I.To (l, c', _), _) =
      Label.equal (Terms.label l) t.label && Configuration.equal (plain x c') (Lazy.force next) in
    List.exists is_it steps
  in
  match steps ?event x c world with
  | steps, Some question when not (List.for_all (is_there steps) ts) ->
    List.concat_map (fun assumption -> closed ?event x c ts (World.suppose [ assumption ] world)) question
  | _, (Some _ | None) -> [ world ]

(* Choices that differ in the step only: all steps of one situation. *)
let alike (choice : Environment.choice) (choice' : Environment.choice) =
  let bound ({ transition = t; _ } : Environment.choice) = match t.label with Bind vs -> Some vs | _ -> None in
  choice.on = None && choice'.on = None
  && bound choice = bound choice'
  && Environment.compare choice.outside choice'.outside = 0
  && List.compare World.compare_assumption choice.transition.assumed choice'.transition.assumed = 0

let rec grouped : Environment.choice list -> Environment.choice list list = function
  | [] -> []
  | choice :: rest ->
    let same, others = List.partition (alike choice) rest in
    (choice :: same) :: grouped others

let situations x c e =
  let of_group (group : Environment.choice list) =
    let choice = List.hd group in
    let event =
      match choice.on with
      | Some (Answered { text; code } as event) -> Hashtbl.replace x.answers text code; Some (Terms.event event)
      | on -> Option.map Terms.event on
    in
    let ts = List.map (fun (choice : Environment.choice) -> choice.transition) group in
    let world = world_of x choice.transition in
    let worlds = if World.is_open world then closed ?event x c ts world else [ world ] in
    List.map (fun world -> ((world, event), choice.outside)) worlds
  in
  List.concat_map of_group (grouped (List.of_seq (Environment.choices_on x.options x.program x.world e (plain x c))))

(* {1 What is asked} *)

let first_wrong x asked (c : I.configuration) e moves =
  match c.control_of with
  | End _ -> None
  | Script _ | Wait _ | Exec _ ->
    let ts = List.map (fun (move, _) -> Terms.transition ~vehicles:x.vehicles move) moves in
    let is_asked property = List.mem property asked in
    let broken (t : Transition.t) = Property.broken_by_end x.program t.rules t.next in
    let is_stuck () = Environment.is_stuck x.options x.program e (List.to_seq (List.map (fun t -> (t, ())) ts)) in
    if is_asked Property.No_deadlock && is_stuck () then Some Property.No_deadlock
    else List.find_opt is_asked (List.filter_map broken ts)

(* {1 Hints} *)

(* The most transitions after each state, if no run is endless. *)
let ranks (edges : State_certificate.edge list array) =
  let n = Array.length edges in
  let before = Array.make n [] and left = Array.map List.length edges and ranks = Array.make n 0 in
  let note i (e : State_certificate.edge) = before.(e.target) <- i :: before.(e.target) in
  Array.iteri (fun i -> List.iter (note i)) edges;
  let rec go count = function
    | [] -> count
    | j :: rest ->
      let settle rest i =
        ranks.(i) <- max ranks.(i) (ranks.(j) + 1);
        left.(i) <- left.(i) - 1;
        if left.(i) = 0 then i :: rest else rest
      in
      go (count + 1) (List.fold_left settle rest before.(j))
  in
  let ends = List.filter (fun i -> left.(i) = 0) (List.init n Fun.id) in
  if go 0 ends = n then Some ranks else None

(* The states met so far, by place: of several transitions with one label, each leads to its own. *)
type met = (I.configuration * Environment.t) option array

let are_alike x (c, e) (c', e') = Environment.compare e e' = 0 && Configuration.equal (plain x c) (plain x c')

(* The edge of the certificate that a transition is. *)
let meant x (met : met) (edges : State_certificate.edge list) ((I.To (l, _, _), _), ((c, e) as s)) =
  let label = Format.asprintf "%a" Label.pp (Terms.label l) in
  let digest = lazy (State_certificate.digest x.program (plain x c, e)) in
  let is_possible (e : State_certificate.edge) =
    String.equal e.label label && Option.fold e.digest ~none:true ~some:(Int.equal (Lazy.force digest)) in
  let leads_to (e : State_certificate.edge) = Option.fold met.(e.target) ~none:false ~some:(are_alike x s) in
  match List.filter is_possible edges with
  | [] -> Error (Printf.sprintf "the rules have a transition %s, and the certificate does not" label)
  | [ e ] -> Ok e
  | first :: _ as several ->
    let is_new (e : State_certificate.edge) = met.(e.target) = None in
    let chosen =
      match List.find_opt leads_to several with Some e -> Some e | None -> List.find_opt is_new several in
    Ok (Option.value chosen ~default:first)

(* {1 Checking} *)

let is_graph edges =
  let n = Array.length edges in
  n > 0 && Array.for_all (List.for_all (fun (e : State_certificate.edge) -> 0 <= e.target && e.target < n)) edges

let compared options program world ~holds edges =
  let x = outside options program world in
  let n = Array.length edges in
  let state = ref (-1) and why = ref "" in
  let fine (c, e) moves =
    incr state;
    match first_wrong x holds c e moves with
    | None -> true
    | Some property -> why := Property.question property; false
  in
  let same s s' =
    let alike = are_alike x s s' in
    if not alike then why := "a transition leads to another state than the certificate has at its place";
    alike
  in
  (* Beyond the last state, so that it is rejected. *)
  let nowhere = n + 1 in
  let met = Array.make n None in
  let places i moves =
    let edges = edges.(i - 1) in
    let place found ((_, s) as move) =
      match meant x met edges move with
      | Ok e ->
        if met.(e.target) = None then met.(e.target) <- Some s;
        (e :: found, e.target + 1)
      | Error reason -> why := reason; (found, nowhere)
    in
    let found, places = List.fold_left_map place [] moves in
    let is_found (e : State_certificate.edge) = List.exists (fun e' -> e' = e) found in
    match List.find_opt (fun e -> not (is_found e)) edges with
    | None -> places
    | Some { label; _ } ->
      if !why = "" then why := Printf.sprintf "the certificate has a transition %s, and the rules do not" label;
      nowhere :: places
  in
  let ranks = ranks edges in
  let rank i = Option.fold ranks ~none:0 ~some:(fun ranks -> ranks.(i - 1)) in
  let first = (Terms.configuration (Configuration.initial program), Environment.initial) in
  let accepts () =
    I.program_accepts Terms.names (code_at x) (situations x) fine same first n places (Option.is_some ranks) rank n in
  match accepts () with
  | true -> Certified (Option.map (fun ranks -> ranks.(0)) ranks)
  | false ->
    let why = if !why = "" then "no transition leads to it" else !why in
    Refuted { state = max 0 !state; why }
  | exception Interpretation.Undecided ->
    Refuted { state = !state + 1; why = "the script depends on a value that the world leaves open" }

let check options program world ~holds edges =
  if is_graph edges then compared options program world ~holds edges
  else Refuted { state = 0; why = "a transition leads to no state of the certificate" }
