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

(* A way in which formulas can hold at a position: the literals that hold there, what must hold from the next position
   on, and which acceptance sets it is in. All in order, so that equal ways are equal values. *)
type 'p way = { now : (bool * 'p) list; later : 'p normal list; inside : bool list }

let add f fs = if List.mem f fs then fs else f :: fs
let sort fs = List.sort_uniq Stdlib.compare fs
let subset fs gs = List.for_all (fun f -> List.mem f gs) fs

(* [untils] are the formulas of the acceptance sets, each with what it is to reach. *)
let ways untils formulas =
  let found = ref [] in
  let finished old later =
    let now = sort (List.filter_map (function Literal (positive, p) -> Some (positive, p) | _ -> None) old) in
    let inside = List.map (fun (until, goal) -> (not (List.mem until old)) || List.mem goal old) untils in
    found := { now; later = sort later; inside } :: !found
  in
  (* [fresh] is still to be expanded, [old] holds. *)
  let rec expand fresh old later =
    match fresh with
    | [] -> finished old later
    | f :: fresh when List.mem f old -> expand fresh old later
    | f :: fresh -> (
        let holding = f :: old in
        match f with
        | False -> ()
        | Literal (positive, p) -> if not (List.mem (Literal (not positive, p)) old) then expand fresh holding later
        | True -> expand fresh holding later
        | And (g, h) -> expand (g :: h :: fresh) holding later
        | Next g -> expand fresh holding (add g later)
        | Or (g, h) ->
          if List.mem g old || List.mem h old then expand fresh holding later
          else begin
            expand (g :: fresh) holding later;
            expand (h :: fresh) holding later
          end
        | Until (g, h) ->
          expand (h :: fresh) holding later;
          if not (List.mem h old) then expand (g :: fresh) holding (add f later)
        | Release (g, h) ->
          expand (g :: h :: fresh) holding later;
          if not (List.mem g old && List.mem h old) then expand (h :: fresh) holding (add f later))
  in
  expand formulas [] [];
  (* Of two ways of which one asks for no more than the other and is in all of its sets, that one will do. *)
  let covers a b =
    subset a.now b.now && subset a.later b.later && List.for_all2 (fun a b -> a || not b) a.inside b.inside
  in
  let keep kept way =
    if List.exists (fun other -> covers other way) kept then kept
    else way :: List.filter (fun other -> not (covers way other)) kept
  in
  List.fold_left keep [] !found

let rec untils f =
  match f with
  | True | False | Literal _ -> []
  | Next f -> untils f
  | And (f, g) | Or (f, g) | Release (f, g) -> untils f @ untils g
  | Until (g, h) -> (f, h) :: (untils g @ untils h)

(* States are ways; what follows one is a function of what it leaves for later. *)
let of_formula f =
  let f = normal true f in
  let untils = sort (untils f) in
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
      let states = List.map number (ways untils later) in
      Hashtbl.add after later states;
      states
  in
  let initial = following [ f ] in
  let rec go successors =
    match Queue.take_opt todo with
    | None -> Array.of_list (List.rev successors)
    | Some way ->
      let next = following way.later in
      go (next :: successors)
  in
  let successors = go [] in
  let states = Array.of_list (List.rev !known) in
  {
    literals = Array.map (fun way -> way.now) states;
    initial;
    successors;
    sets = Array.map (fun way -> Array.of_list way.inside) states;
    is_open = Array.map (fun way -> way.later = []) states;
  }

let states a = Array.length a.literals
let initial a = a.initial
let successors a q = a.successors.(q)
let admits a q letter = List.for_all (fun (positive, p) -> letter p = positive) a.literals.(q)
let is_open a q = a.is_open.(q)
let acceptance_sets a = if states a = 0 then 0 else Array.length a.sets.(0)
let is_in a q i = a.sets.(q).(i)
