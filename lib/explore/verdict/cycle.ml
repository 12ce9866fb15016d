open Dolphin_ltl

type lasso = { stem : int list; around : int list }

let find ~tick space =
  if not (Space.may_cycle space) then None
  else
    let successors i = List.map (fun j -> (j, ())) (Space.successors space i) in
    let graph : unit Cycles.graph = { successors; sets = 0; is_in = (fun _ _ -> false) } in
    let shortest_around i =
      match Cycles.way graph ~within:(fun _ -> true) ~goal:(Int.equal i) (successors i) with
      | Some way -> i :: List.map fst way
      | None -> invalid_arg "Cycle.find: a state that is on no cycle"
    in
    (* Where states stand for others, the run need not come back to the very one that it left; it does to those of the
       script, which stand for themselves. *)
    let is_exact i = match Space.view space i with Exact _ -> true | Up_to _ -> false in
    let exact i = if is_exact i then i else List.find is_exact (shortest_around i) in
    let lasso component =
      let start = exact (Cycles.first component) in
      { stem = Replay.shortest space start; around = shortest_around start }
    in
    Option.map lasso (Cycles.find ~tick graph [ 0 ])
