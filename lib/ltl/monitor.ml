module Sets = Map.Make (struct
    type t = int list

    let compare = List.compare Int.compare
  end)

type t = {
  states : int;
  initial : int list;
  successors : int -> int list;
  admits : int -> int -> bool;
  acceptance_sets : int;
  is_in : int -> int -> bool;
  is_open : int -> bool;
  components : int array;
  mutable numbers : int Sets.t;
  mutable members : int list array;  (* by set *)
  mutable next : int array array;  (* by set, then letter; [unknown] if not computed yet *)
  mutable count : int;
  stay : (int * int, bool) Hashtbl.t;
}

let unknown = -2
let start = 0

(* By state, the number of the component that it is in, or -1 if a run cannot be accepted there. By two searches,
   depth first: forwards, and then backwards from the last finished state. *)
let components states successors acceptance_sets is_in =
  let before = Array.make states [] and left = ref [] in
  let seen = Array.make states false in
  let rec forwards q =
    if not seen.(q) then begin
      seen.(q) <- true;
      List.iter (fun q' -> before.(q') <- q :: before.(q'); forwards q') (successors q);
      left := q :: !left
    end
  in
  List.iter forwards (List.init states Fun.id);
  let components = Array.make states unknown in
  let rec backwards members q =
    if components.(q) <> unknown then members
    else begin
      components.(q) <- -1;
      List.fold_left backwards (q :: members) before.(q)
    end
  in
  let name q =
    let members = backwards [] q in
    let is_met k = List.exists (fun q' -> is_in q' k) members in
    if List.for_all is_met (List.init acceptance_sets Fun.id) then List.iter (fun q' -> components.(q') <- q) members
  in
  List.iter name !left;
  components

let create ~holds a =
  let states = Automaton.states a and successors = Automaton.successors a in
  let acceptance_sets = Automaton.acceptance_sets a and is_in = Automaton.is_in a in
  {
    states;
    initial = Automaton.initial a;
    successors;
    admits = (fun q letter -> Automaton.admits a q (holds letter));
    acceptance_sets;
    is_in;
    is_open = Automaton.is_open a;
    components = components states successors acceptance_sets is_in;
    numbers = Sets.empty;
    members = [| [] |];
    next = [| [||] |];
    count = 1;
    stay = Hashtbl.create 16;
  }

let automaton_states m = m.states
let members m s = m.members.(s)
let count m = m.count
let acceptance_sets m = m.acceptance_sets
let is_in m = m.is_in
let component m q = m.components.(q)
let after m q letter = List.filter (fun q' -> m.admits q' letter) (m.successors q)

let number m ~give set =
  match Sets.find_opt set m.numbers with
  | Some s -> s
  | None ->
    give ();
    let s = m.count in
    if s = Array.length m.members then begin
      m.members <- Array.append m.members (Array.make s []);
      m.next <- Array.append m.next (Array.make s [||])
    end;
    m.members.(s) <- set;
    m.numbers <- Sets.add set s m.numbers;
    m.count <- s + 1;
    s

let find m ~give s letter =
  let set =
    if s = start then List.filter (fun q -> m.admits q letter) m.initial
    else List.concat_map (fun q -> after m q letter) m.members.(s)
  in
  match List.sort_uniq Int.compare set with
  | [] -> -1
  | set -> number m ~give (match List.find_opt m.is_open set with Some q -> [ q ] | None -> set)

let next m ~give s letter =
  let row = m.next.(s) in
  if letter < Array.length row && row.(letter) <> unknown then row.(letter)
  else begin
    let found = find m ~give s letter in
    let row =
      if letter < Array.length row then row
      else Array.append row (Array.make (max (letter + 1) (Array.length row) - Array.length row + 8) unknown)
    in
    row.(letter) <- found;
    m.next.(s) <- row;
    found
  end

let is_certain m s = match m.members.(s) with [ q ] -> m.is_open q | _ -> false

let stays m s letter =
  match Hashtbl.find_opt m.stay (s, letter) with
  | Some known -> known
  | None ->
    let successors q = List.map (fun q' -> (q', ())) (after m q letter) in
    let graph : unit Cycles.graph = { successors; sets = m.acceptance_sets; is_in = m.is_in } in
    let accepted = Cycles.find graph m.members.(s) <> None in
    Hashtbl.add m.stay (s, letter) accepted;
    accepted
