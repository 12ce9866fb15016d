(* Formulas with negation only before propositions. *)
type 'p normal =
  | True
  | False
  | Literal of bool * 'p
  | And of 'p normal * 'p normal
  | Or of 'p normal * 'p normal
  | Next of 'p normal
  | Until of 'p normal * 'p normal
  | Release of 'p normal * 'p normal

let conjunction f g =
  match f, g with
  | True, f | f, True -> f
  | False, _ | _, False -> False
  | f, g when f = g -> f
  | f, g -> And (f, g)

let disjunction f g =
  match f, g with
  | False, f | f, False -> f
  | True, _ | _, True -> True
  | f, g when f = g -> f
  | f, g -> Or (f, g)

let until f g =
  match f, g with
  | _, (True | False) | False, _ -> g
  | f, Until (f', _) when f = f' -> g
  | f, g -> if f = g then f else Until (f, g)

let release f g =
  match f, g with
  | _, (True | False) | True, _ -> g
  | f, Release (f', _) when f = f' -> g
  | f, g -> if f = g then f else Release (f, g)

let next f = match f with True | False -> f | f -> Next f

let rec normal positive (f : 'p Formula.t) : 'p normal =
  let yes = normal positive in
  let dual f g g' f' = if positive then f g g' else f' g g' in
  match f with
  | True -> if positive then True else False
  | False -> if positive then False else True
  | Proposition p -> Literal (positive, p)
  | Not f -> normal (not positive) f
  | And (f, g) -> dual conjunction (yes f) (yes g) disjunction
  | Or (f, g) -> dual disjunction (yes f) (yes g) conjunction
  | Implies (f, g) -> yes (Or (Not f, g))
  | Equivalent (f, g) -> yes (Or (And (f, g), And (Not f, Not g)))
  | Next f -> next (yes f)
  | Finally f -> yes (Until (True, f))
  | Globally f -> yes (Release (False, f))
  | Until (f, g) -> dual until (yes f) (yes g) release
  | Release (f, g) -> dual release (yes f) (yes g) until
  | Weak_until (f, g) -> yes (Release (g, Or (f, g)))

type 'p t = {
  literals : (bool * 'p) list array;
  initial : int list;
  successors : int list array;
  sets : bool array array;  (* by state, then by acceptance set *)
  is_open : bool array;
}

(* {1 Sets of formulas}

   Formulas are numbered, subformulas before what they are in; a set has a bit for each. *)

module Bits = struct
  type t = int array

  let per_word = 62
  let none n = Array.make ((n / per_word) + 1) 0
  let mem i (s : t) = s.(i / per_word) land (1 lsl (i mod per_word)) <> 0

  let add i (s : t) =
    let s = Array.copy s in
    s.(i / per_word) <- s.(i / per_word) lor (1 lsl (i mod per_word));
    s

  let subset (s : t) (s' : t) =
    let rec from w = w = Array.length s || (s.(w) land lnot s'.(w) = 0 && from (w + 1)) in
    from 0

  let is_empty (s : t) = Array.for_all (( = ) 0) s
  let elements n s = List.filter (fun i -> mem i s) (List.init n Fun.id)
end

type 'p node =
  | Yes
  | No
  | Atom of { positive : bool; p : 'p; opposite : int option }
  | Both of int * int
  | Either of int * int
  | After of int
  | Reach of int * int
  | Keep of int * int

(* Nodes by number; the last one is the whole formula. *)
let numbered f =
  let numbers = Hashtbl.create 64 and nodes = ref [] in
  let rec number f =
    match Hashtbl.find_opt numbers f with
    | Some i -> i
    | None ->
      let node =
        match f with
        | True -> Yes
        | False -> No
        | Literal (positive, p) -> Atom { positive; p; opposite = Hashtbl.find_opt numbers (Literal (not positive, p)) }
        | And (f, g) -> pair f g (fun f g -> Both (f, g))
        | Or (f, g) -> pair f g (fun f g -> Either (f, g))
        | Next f -> After (number f)
        | Until (f, g) -> pair f g (fun f g -> Reach (f, g))
        | Release (f, g) -> pair f g (fun f g -> Keep (f, g))
      in
      let i = Hashtbl.length numbers in
      Hashtbl.add numbers f i;
      nodes := node :: !nodes;
      i
  and pair f g make =
    let f = number f in
    make f (number g)
  in
  let whole = number f in
  let nodes = Array.of_list (List.rev !nodes) in
  let with_opposite i = function
    | Atom { opposite = Some j; _ } -> (
        match nodes.(j) with
        | Atom atom -> nodes.(j) <- Atom { atom with opposite = Some i }
        | Yes | No | Both _ | Either _ | After _ | Reach _ | Keep _ -> ())
    | Atom { opposite = None; _ } | Yes | No | Both _ | Either _ | After _ | Reach _ | Keep _ -> ()
  in
  Array.iteri with_opposite nodes;
  (nodes, whole)

(* {1 The tableau} *)

(* A way in which formulas can hold at a position: the literals that hold there, the obligations from the next
   position on, and the acceptance sets that it is not in. *)
type way = { now : Bits.t; later : Bits.t; outside : Bits.t }

(* Of two ways of which one asks for no more than the other and is in all of its sets, that one will do. *)
let covers a b = Bits.subset a.now b.now && Bits.subset a.later b.later && Bits.subset a.outside b.outside

(* [untils] are the formulas of the acceptance sets, each with its goal. *)
let ways nodes untils formulas =
  let none = Bits.none (Array.length nodes) in
  let found = ref [] in
  let finished old now later =
    let add (outside, k) (until, goal) =
      ((if Bits.mem until old && not (Bits.mem goal old) then Bits.add k outside else outside), k + 1) in
    let way = { now; later; outside = fst (List.fold_left add (none, 0) untils) } in
    if not (List.exists (fun other -> covers other way) !found) then
      found := way :: List.filter (fun other -> not (covers way other)) !found
  in
  (* [fresh] is still to be expanded, [old] holds. *)
  let rec expand fresh old now later =
    match fresh with
    | [] -> finished old now later
    | f :: fresh when Bits.mem f old -> expand fresh old now later
    | f :: fresh -> (
        let holding = Bits.add f old in
        match nodes.(f) with
        | No -> ()
        | Atom { opposite = Some g; _ } when Bits.mem g old -> ()
        | Atom _ -> expand fresh holding (Bits.add f now) later
        | Yes -> expand fresh holding now later
        | Both (g, h) -> expand (g :: h :: fresh) holding now later
        | After g -> expand fresh holding now (Bits.add g later)
        | Either (g, h) ->
          if Bits.mem g old || Bits.mem h old then expand fresh holding now later
          else begin
            expand (g :: fresh) holding now later;
            expand (h :: fresh) holding now later
          end
        | Reach (g, h) ->
          expand (h :: fresh) holding now later;
          if not (Bits.mem h old) then expand (g :: fresh) holding now (Bits.add f later)
        | Keep (g, h) ->
          expand (g :: h :: fresh) holding now later;
          if not (Bits.mem g old && Bits.mem h old) then expand (h :: fresh) holding now (Bits.add f later))
  in
  expand formulas none none none;
  !found

(* States are ways; the successors of one are a function of its obligations for later. *)
let of_formula f =
  let nodes, whole = numbered (normal true f) in
  let size = Array.length nodes in
  let until i = match nodes.(i) with Reach (_, goal) -> Some (i, goal) | _ -> None in
  let untils = List.filter_map until (List.init size Fun.id) in
  let numbers = Hashtbl.create 64 and known = ref [] and after = Hashtbl.create 64 in
  let todo = Queue.create () in
  let number way =
    match Hashtbl.find_opt numbers way with
    | Some i -> i
    | None ->
      let i = Hashtbl.length numbers in
      Hashtbl.add numbers way i;
      known := way :: !known;
      Queue.add way todo;
      i
  in
  let following later =
    match Hashtbl.find_opt after later with
    | Some states -> states
    | None ->
      let states = List.map number (ways nodes untils (Bits.elements size later)) in
      Hashtbl.add after later states;
      states
  in
  let initial = following (Bits.add whole (Bits.none size)) in
  let rec go successors =
    match Queue.take_opt todo with
    | None -> Array.of_list (List.rev successors)
    | Some way ->
      let next = following way.later in
      go (next :: successors)
  in
  let successors = go [] in
  let states = Array.of_list (List.rev !known) in
  let literal i = match nodes.(i) with Atom { positive; p; _ } -> Some (positive, p) | _ -> None in
  {
    literals = Array.map (fun way -> List.filter_map literal (Bits.elements size way.now)) states;
    initial;
    successors;
    sets = Array.map (fun way -> Array.of_list (List.mapi (fun k _ -> not (Bits.mem k way.outside)) untils)) states;
    is_open = Array.map (fun way -> Bits.is_empty way.later) states;
  }

let states a = Array.length a.literals
let initial a = a.initial
let successors a q = a.successors.(q)
let admits a q letter = List.for_all (fun (positive, p) -> letter p = positive) a.literals.(q)
let is_open a q = a.is_open.(q)
let acceptance_sets a = if states a = 0 then 0 else Array.length a.sets.(0)
let is_in a q i = a.sets.(q).(i)
