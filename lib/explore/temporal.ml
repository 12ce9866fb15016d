open Dolphin_semantics
module Formula = Dolphin_ltl.Formula

type t = { text : string; formula : Proposition.t Formula.t }

let to_string f = f.text

exception Unknown of string

let of_string program text =
  match Formula.of_string text with
  | Error why -> Error why
  | Ok formula -> (
      let proposition text =
        match Proposition.of_string program text with
        | Ok p -> p
        | Error why -> raise (Unknown why)
      in
      match Formula.map proposition formula with
      | formula -> Ok { text; formula }
      | exception Unknown why -> Error why)

(* {1 The state graph} *)

type state = { configuration : Configuration.t; outside : Environment.t }

module States = Interner.Make (struct
    type t = state

    let equal a b =
      Environment.compare a.outside b.outside = 0 && Configuration.equal a.configuration b.configuration

    let hash s = (Configuration.hash s.configuration + Environment.hash s.outside) land max_int
  end)

(* Letters are numbers: which propositions hold. They are interned, for many transitions have the same. *)
module Letters = Interner.Make (struct
    type t = bool list

    let equal = ( = )
    let hash = Hashtbl.hash
  end)

type graph = {
  options : Environment.options;
  program : Core.program;
  world : World.t;
  propositions : Proposition.t list;  (* of all formulas, in order *)
  states : States.t;
  letters : Letters.t;
  first : int;  (* the letter of the start *)
  edges : (int * int) list array;  (* by state: targets and letters *)
}

exception Broken of string

let propositions_of fs = List.concat_map (fun f -> Formula.propositions f.formula) fs

let explore ?(tick = ignore) options program world fs =
  let propositions = propositions_of fs in
  let states = States.create () and letters = Letters.create () in
  let in_state c =
    let ask p = match Proposition.holds_in program world p c with Ok b -> b | Error why -> raise (Broken why) in
    List.map ask propositions
  in
  let letter valuation = Letters.number letters valuation in
  (* What holds in states, by their number; latest known first. *)
  let valuations = Hashtbl.create 1_000 in
  let valuation i =
    match Hashtbl.find_opt valuations i with
    | Some v -> v
    | None ->
      let v = in_state (States.value states i).configuration in
      Hashtbl.add valuations i v;
      v
  in
  let arrive transition i =
    let holds p in_state = if Proposition.needs_action p then Proposition.holds_after p transition else in_state in
    letter (List.map2 holds propositions (valuation i))
  in
  let start = { configuration = Configuration.initial program; outside = Environment.initial } in
  let first = letter (valuation (States.number states start)) in
  let edges = ref (Array.make 1_000 []) in
  let rec go i =
    if i < States.count states then begin
      tick i;
      let s = States.value states i in
      let edge ((t : Transition.t), outside) =
        let target = States.number states { configuration = t.next; outside } in
        (target, arrive t target)
      in
      let choices = Environment.choices options program world s.outside s.configuration in
      if i >= Array.length !edges then edges := Array.append !edges (Array.make (Array.length !edges) []);
      let stays = if Environment.goes_on choices then [] else [ (i, letter (valuation i)) ] in
      !edges.(i) <- stays @ List.map edge choices;
      go (i + 1)
    end
  in
  go 0;
  { options; program; world; propositions; states; letters; first; edges = !edges }

(* {1 To check} *)

type run = { steps : Transition.t list; cycle : Transition.t list }

let letter_of g t target =
  let c = (States.value g.states target).configuration in
  let holds p =
    if Proposition.needs_action p then Proposition.holds_after p t
    else Result.value (Proposition.holds_in g.program g.world p c) ~default:false
  in
  Letters.find g.letters (List.map holds g.propositions)

(* The transitions along the states of a path; none where a run stays in its last state. *)
let transitions g from path =
  let step from (target, letter) =
    let s = States.value g.states from and s' = States.value g.states target in
    let leads ((t : Transition.t), e) =
      Environment.compare e s'.outside = 0
      && Configuration.equal t.next s'.configuration
      && letter_of g t target = Some letter
    in
    let choices = Environment.choices g.options g.program g.world s.outside s.configuration in
    Option.map fst (List.find_opt leads choices)
  in
  let rec go from = function
    | [] -> []
    | (target, letter) :: rest -> Option.to_list (step from (target, letter)) @ go target rest
  in
  go from path

(* A formula whose propositions are places in the letters. *)
let numbered g f =
  let rec place i p = function
    | q :: _ when q == p -> i
    | _ :: rest -> place (i + 1) p rest
    | [] -> invalid_arg "Temporal.violation: another formula's graph"
  in
  Formula.map (fun p -> place 0 p g.propositions) f.formula

let violation ?tick g f =
  let values = Array.init (Letters.count g.letters) (fun i -> Array.of_list (Letters.value g.letters i)) in
  let holds letter place = values.(letter).(place) in
  let graph : int Dolphin_ltl.Search.graph = { start = (0, g.first); successors = (fun i -> g.edges.(i)) } in
  match Dolphin_ltl.Search.satisfying ?tick ~holds graph (Not (numbered g f)) with
  | None -> None
  | Some { stem; cycle } ->
    let rec last = function [ (i, _) ] -> i | _ :: rest -> last rest | [] -> 0 in
    Some { steps = transitions g 0 (List.tl stem); cycle = transitions g (last stem) cycle }
