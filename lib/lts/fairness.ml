type t = {
  graph : Graph.t;
  keep : int -> int -> int -> bool;
  component : int array;
  members : int array;  (* by component *)
  starts : int array;  (* where each component starts in [members], and the length *)
}

let unseen = -1

(* Tarjan's algorithm. [path] is the states from a root to where the search is, [next] the transition to look at next
   in each state; [open_] is the stack of states whose component is not known. *)
let components ?(keep = fun _ _ _ -> true) g =
  let n = Graph.states g in
  let seen_at = Array.make n unseen and low = Array.make n 0 and next = Array.make n 0 in
  let component = Array.make n unseen and members = Array.make n 0 in
  let path = Array.make n 0 and path_length = ref 0 and open_ = Array.make n 0 and open_length = ref 0 in
  let seen = ref 0 and found = ref 0 and starts = ref [] and closed = ref 0 in
  let enter s =
    seen_at.(s) <- !seen;
    low.(s) <- !seen;
    incr seen;
    next.(s) <- Graph.first g s;
    open_.(!open_length) <- s;
    incr open_length;
    path.(!path_length) <- s;
    incr path_length
  in
  let rec close s =
    decr open_length;
    let member = open_.(!open_length) in
    component.(member) <- !found;
    members.(!closed) <- member;
    incr closed;
    if member <> s then close s
  in
  let leave s =
    decr path_length;
    if !path_length > 0 then begin
      let above = path.(!path_length - 1) in
      low.(above) <- min low.(above) low.(s)
    end;
    if low.(s) = seen_at.(s) then begin
      starts := !closed :: !starts;
      close s;
      incr found
    end
  in
  let step s =
    let e = next.(s) in
    if e = Graph.first g (s + 1) then leave s
    else begin
      next.(s) <- e + 1;
      let s' = Graph.target g e in
      if keep s (Graph.label_of g e) s' then
        if seen_at.(s') = unseen then enter s'
        else if component.(s') = unseen then low.(s) <- min low.(s) seen_at.(s')
    end
  in
  Array.iteri
    (fun root reachable ->
       if reachable && seen_at.(root) = unseen then begin
         enter root;
         while !path_length > 0 do
           step path.(!path_length - 1)
         done
       end)
    (Reachability.reachable g);
  let starts = Array.of_list (List.rev (!closed :: !starts)) in
  { graph = g; keep; component; members; starts }

let count c = Array.length c.starts - 1
let component c s = if c.component.(s) = unseen then None else Some c.component.(s)
let size c i = c.starts.(i + 1) - c.starts.(i)

let iter_states c i f =
  for place = c.starts.(i) to c.starts.(i + 1) - 1 do
    f c.members.(place)
  done

let inside c i s l s' = c.component.(s) = i && c.component.(s') = i && c.keep s l s'

let iter_inside c i f =
  iter_states c i (fun s -> Graph.iter_from c.graph s (fun l s' -> if inside c i s l s' then f s l s'))

let exists_transition c i p =
  let rec go place =
    place < c.starts.(i + 1)
    &&
    let s = c.members.(place) in
    Graph.exists_from c.graph s (p s) || go (place + 1)
  in
  go c.starts.(i)

let cyclic c i = size c i > 1 || exists_transition c i (inside c i)
let closed c i = not (exists_transition c i (fun s l s' -> c.component.(s') <> i && c.keep s l s'))

type lasso = { prefix : Reachability.run; cycle : Reachability.run }

(* The labels and states on a shortest way from [s] to [s'] within component [i], the last first, before [steps]. *)
let way c i s s' steps =
  match Reachability.shortest ~from:s ~keep:(inside c i) c.graph (Int.equal s') with
  | Some run -> List.rev_append run.steps steps
  | None -> assert false (* the component is strongly connected *)

(* A shortest cycle: over each state after the first there is a shortest way back. *)
let shortest_cycle c i s =
  let back_to_s = ref None in
  let leads_back s' =
    Graph.exists_from c.graph s' (fun l target ->
        let back = target = s && inside c i s' l target in
        if back then back_to_s := Some l;
        back)
  in
  match (Reachability.shortest ~from:s ~keep:(inside c i) c.graph leads_back, !back_to_s) with
  | Some run, Some l ->
    List.rev ({ Reachability.label = Graph.label c.graph l; target = s } :: List.rev run.steps)
  | _ -> assert false (* the component is cyclic *)

let cycle_through c i ~through s =
  let here = ref s and steps = ref [] in
  iter_inside c i (fun from l target ->
      if through from l target then begin
        steps := { Reachability.label = Graph.label c.graph l; target } :: way c i !here from !steps;
        here := target
      end);
  if !steps = [] then shortest_cycle c i s else List.rev (way c i !here s !steps)

let lasso ?(through = fun _ _ _ -> false) c p =
  let good = Array.init (count c) (fun i -> p i && cyclic c i) in
  let into_good s = match component c s with Some i -> good.(i) | None -> false in
  Reachability.shortest c.graph into_good
  |> Option.map (fun prefix ->
      let start = Reachability.finish prefix in
      let steps = cycle_through c c.component.(start) ~through start in
      { prefix; cycle = { start; steps } })

let pp_lasso ppf { prefix; cycle } =
  List.iter (Fmt.pf ppf "%s@ ") (Reachability.trace prefix);
  Fmt.pf ppf "(%a) for ever" Fmt.(list ~sep:sp string) (Reachability.trace cycle)
