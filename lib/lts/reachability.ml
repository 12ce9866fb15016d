type step = { label : string; target : int }
type run = { start : int; steps : step list }

let trace run = List.rev (List.rev_map (fun step -> step.label) run.steps)
let finish run = List.fold_left (fun _ step -> step.target) run.start run.steps

(* The result of breadth-first search: the states in the order found, and for each the state and the label that it
   was found by. *)
type search = { order : int array; mutable found : int; came_from : int array; came_by : int array }

let unseen = -2
let root = -1

(* [search g p] is the states found, and the first of them for which [p] holds, where the search stops. *)
let search ~from g p =
  let states = Graph.states g in
  let search =
    { order = Array.make states 0; found = 0; came_from = Array.make states unseen; came_by = Array.make states 0 }
  in
  let goal = ref None in
  let find ~came_from ~came_by s =
    if !goal = None && search.came_from.(s) = unseen then begin
      search.came_from.(s) <- came_from;
      search.came_by.(s) <- came_by;
      search.order.(search.found) <- s;
      search.found <- search.found + 1;
      if p s then goal := Some s
    end
  in
  find ~came_from:root ~came_by:0 from;
  let next = ref 0 in
  while !goal = None && !next < search.found do
    let s = search.order.(!next) in
    incr next;
    Graph.iter_from g s (fun l -> find ~came_from:s ~came_by:l)
  done;
  (search, !goal)

let explore g = fst (search ~from:(Graph.initial g) g (fun _ -> false))
let reachable g = Array.map (fun s -> s <> unseen) (explore g).came_from

let trim g =
  let { order; found; _ } = explore g in
  let number = Array.make (Graph.states g) 0 in
  for i = 0 to found - 1 do
    number.(order.(i)) <- i
  done;
  let b = Graph.Builder.create () in
  let renamed = Array.init (Graph.labels g) (fun l -> Graph.Builder.label b (Graph.label g l)) in
  for i = 0 to found - 1 do
    Graph.iter_from g order.(i) (fun l s' -> Graph.Builder.add_numbered b i renamed.(l) number.(s'))
  done;
  let text = Option.map (fun text i -> text order.(i)) (Graph.text g) in
  Graph.Builder.finish ~states:found ?text b

let shortest ?from g p =
  let start = Option.value from ~default:(Graph.initial g) in
  let search, goal = search ~from:start g p in
  let rec back s steps =
    let previous = search.came_from.(s) in
    if previous = root then steps
    else back previous ({ label = Graph.label g search.came_by.(s); target = s } :: steps)
  in
  Option.map (fun goal -> { start; steps = back goal [] }) goal
