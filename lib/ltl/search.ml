type 'letter graph = { start : int * 'letter; successors : int -> (int * 'letter) list }
type 'letter lasso = { stem : (int * 'letter) list; cycle : (int * 'letter) list }

(* The product: its states are numbered, each a state of the graph and one of the automaton. *)
type 'letter product = {
  starts : (int * 'letter) list;
  successors : int -> (int * 'letter) list;
  pair : int -> int * int;
}

let product ~tick ~holds (g : 'letter graph) a =
  let numbers = Hashtbl.create 1_000 and pairs = ref [||] in
  let number pair =
    match Hashtbl.find_opt numbers pair with
    | Some i -> i
    | None ->
      tick ();
      let i = Hashtbl.length numbers in
      Hashtbl.add numbers pair i;
      if i = Array.length !pairs then pairs := Array.append !pairs (Array.make (max 64 i) pair);
      !pairs.(i) <- pair;
      i
  in
  let arrivals states (s, letter) =
    List.filter_map (fun q -> if Automaton.admits a q (holds letter) then Some (number (s, q), letter) else None) states
  in
  let pair i = !pairs.(i) in
  let successors i =
    let s, q = pair i in
    List.concat_map (arrivals (Automaton.successors a q)) (g.successors s)
  in
  { starts = arrivals (Automaton.initial a) g.start; successors; pair }

(* {1 Components} *)

let ( .%() ) = Hashtbl.find

(* Tarjan's algorithm. [found component] is whether to stop at it, given its states. *)
let find_component successors starts found =
  let index = Hashtbl.create 1_000 and low = Hashtbl.create 1_000 and done_ = Hashtbl.create 1_000 in
  let path = Stack.create () and frames = Stack.create () in
  let result = ref None in
  let enter i =
    Hashtbl.replace index i (Hashtbl.length index);
    Hashtbl.replace low i index.%(i);
    Stack.push i path;
    Stack.push (i, ref (List.map fst (successors i))) frames
  in
  let lower i n = if n < low.%(i) then Hashtbl.replace low i n in
  let leave i =
    if low.%(i) = index.%(i) then begin
      let rec pop states =
        let j = Stack.pop path in
        Hashtbl.replace done_ j ();
        if j = i then j :: states else pop (j :: states)
      in
      let component = pop [] in
      if found component then result := Some component
    end
  in
  let step () =
    let i, rest = Stack.top frames in
    match !rest with
    | [] ->
      ignore (Stack.pop frames);
      leave i;
      Option.iter (fun (j, _) -> lower j low.%(i)) (Stack.top_opt frames)
    | j :: others ->
      rest := others;
      if not (Hashtbl.mem index j) then enter j
      else if not (Hashtbl.mem done_ j) then lower i index.%(j)
  in
  let explore i =
    if !result = None && not (Hashtbl.mem index i) then begin
      enter i;
      while !result = None && not (Stack.is_empty frames) do
        step ()
      done
    end
  in
  List.iter explore starts;
  !result

(* {1 Ways} *)

(* A shortest way, not empty, from one of [starts], which are arrivals themselves, or from the state [from], to a state
   with [goal], through states with [keep]. *)
let way successors ~keep ~goal first =
  let before = Hashtbl.create 100 and queue = Queue.create () in
  let arrive parent (i, letter) =
    if keep i && not (Hashtbl.mem before i) then begin
      Hashtbl.add before i (parent, letter);
      Queue.add i queue
    end
  in
  let rec back i rest =
    let parent, letter = before.%(i) in
    let rest = (i, letter) :: rest in
    match parent with None -> rest | Some parent -> back parent rest
  in
  let rec go () =
    match Queue.take_opt queue with
    | None -> None
    | Some i when goal i -> Some (back i [])
    | Some i ->
      List.iter (arrive (Some i)) (successors i);
      go ()
  in
  List.iter (arrive None) first;
  go ()

let satisfying ?(tick = ignore) ~holds g f =
  let a = Automaton.of_formula f in
  let { starts; successors; pair } = product ~tick ~holds g a in
  let state i = fst (pair i) and automaton i = snd (pair i) in
  let sets = List.init (Automaton.acceptance_sets a) Fun.id in
  let in_set set i = Automaton.is_in a (automaton i) set in
  let accepting component =
    let cyclic = match component with [ i ] -> List.mem_assoc i (successors i) | _ -> true in
    cyclic && List.for_all (fun set -> List.exists (in_set set) component) sets
  in
  match find_component successors (List.map fst starts) accepting with
  | None -> None
  | Some component ->
    let inside = Hashtbl.create 100 in
    List.iter (fun i -> Hashtbl.replace inside i ()) component;
    let keep = Hashtbl.mem inside in
    let stem = Option.get (way successors ~keep:(fun _ -> true) ~goal:keep starts) in
    let rec last = function [ (i, _) ] -> i | _ :: rest -> last rest | [] -> invalid_arg "Search.satisfying" in
    let entry = last stem in
    let go_on from goal = Option.get (way successors ~keep ~goal (successors from)) in
    (* The sets that the cycle has not met yet, the entry counting at the end. *)
    let rec around from missing cycle =
      match missing with
      | [] -> cycle
      | set :: missing ->
        let part = go_on from (in_set set) in
        let met i = List.exists (fun (j, _) -> in_set i j) part in
        around (last part) (List.filter (fun set -> not (met set)) missing) (cycle @ part)
    in
    let missing = List.filter (fun set -> not (in_set set entry)) sets in
    let cycle = around entry missing [] in
    let from = match cycle with [] -> entry | cycle -> last cycle in
    let cycle = if cycle <> [] && from = entry then cycle else cycle @ go_on from (fun i -> i = entry) in
    let place (i, letter) = (state i, letter) in
    Some { stem = List.map place stem; cycle = List.map place cycle }
