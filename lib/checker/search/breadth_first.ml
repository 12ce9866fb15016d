open Dolphin_ltl

type 'run verdict = Holds | Violated of 'run | Inconclusive of Limits.bound
type lasso = { stem : int list; around : int list }
type violation = Whatever_follows of int list | Around of { stem : int list; cycle : (int * int) list }

module Make (S : System.S) = struct
  include Search_state.Make (S)
  module Together = Together.Make (S)
  module Random_walks = Random_walks.Make (S)
  module Depth_first = Depth_first.Make (S)

  let rec expand_all t ~is_plain look enough =
    if t.next >= t.level_end then flush t;
    if (not (is_settled t || (is_violated t && t.next >= t.level_end) || enough ())) && more t then begin
      if t.next >= t.level_end then begin
        deeper t;
        if is_plain && Together.is_possible t then Together.start t
      end;
      match t.shared with
      | Some shared -> Together.expand_all t shared
      | None ->
        worked t;
        see t t.next;
        look t.next;
        ignore (expand t t.next : int);
        check_states t;
        expand_all t ~is_plain look enough
    end

  (* Without memory nothing can be added, not even waiting states; and writing to the disk takes long. *)
  let run_by expand_all t =
    let give_up bound =
      States.forget_waiting t.states;
      t.stopped <- Some bound
    in
    let settle stopped =
      t.stopped <- stopped;
      if stopped = None || not (States.is_on_disk t.states) then flush t else States.forget_waiting t.states
    in
    let settled expand_all =
      match expand_all () with () -> settle None | exception Limits.Stop bound -> settle (Some bound)
    in
    match if t.stopped = None then settled expand_all with
    | () -> ()
    | exception Limits.Stop bound -> give_up bound
    | exception Out_of_memory -> give_up No_memory
    | exception States.Disk_failed why -> give_up (Unsettled why)

  let run ?watcher ?look ?enough t =
    t.watcher <- watcher;
    let is_plain = Option.is_none look && Option.is_none enough in
    let look = Option.value look ~default:ignore and enough = Option.value enough ~default:(fun () -> false) in
    let all () =
      look_around t t.phase;
      expand_all t ~is_plain look enough
    in
    run_by all t

  let run_walks ?(look = ignore) ?(enough = fun () -> false) t ~walks ~seed =
    if t.monitor <> None then invalid_arg "Breadth_first.run_walks: a monitor";
    let sample = Sample.create ~seed in
    t.sample <- Some sample;
    Sample.see sample 0 ~from:0;
    run_by (fun () -> Random_walks.run t sample ~walks ~look ~enough) t

  let run_bitstate ?(look = ignore) ?(enough = fun () -> false) t ~bytes =
    if t.monitor <> None then invalid_arg "Breadth_first.run_bitstate: a monitor";
    run_by (fun () -> Depth_first.run t ~bytes ~look ~enough) t

  (* {1 States} *)

  let here = Depth_first.here
  let keep = Depth_first.keep

  let load t i =
    if i = here then Array.copy t.key
    else begin
      let key = Array.make (States.words t.states) 0 in
      States.load t.states i key;
      key.(0) <- key.(0) land lnot (mask t);
      key
    end

  let first_word t i =
    let key = Array.make (States.words t.states) 0 in
    States.load t.states i key;
    key.(0)

  let set t i = first_word t i land mask t

  let path t i = match t.deep with Some deep -> Hashtbl.find deep.runs i | None -> path_to t i

  type arrival = { into : int; action : int; valuation : int; via : S.via }

  (* Looking at a state again may also enlarge a system's numberings. *)
  let rec arrivals_with tick t i =
    let found = ref [] in
    let put key action via valuation =
      found := { into = States.find t.states key; action; valuation; via } :: !found in
    let visit key action via =
      match t.monitor with
      | None -> put key action via 0
      | Some monitor -> under t monitor key action (put key action via)
    in
    fetch t i;
    match S.expand t.system t.key { visit; tick; rest = ignore } with
    | (_ : int) -> List.rev !found
    | exception S.Outgrown ->
      widen t;
      arrivals_with tick t i

  let arrivals t i = arrivals_with ignore t i

  let rec visiting t i expand =
    let arrived = ref (fun _ _ -> ()) in
    let arrive key valuation = !arrived (States.find t.states key) valuation in
    let visit key action _ =
      match t.monitor with None -> arrive key 0 | Some monitor -> under t monitor key action (arrive key) in
    fetch t i;
    match expand t.key arrived { System.visit; tick = ignore; rest = ignore } with
    | found -> found
    | exception S.Outgrown ->
      widen t;
      visiting t i expand

  (* {1 Verdicts} *)

  let unless_stopped t verdict =
    match t.stopped with
    | Some bound -> Inconclusive bound
    | None -> (
        try verdict () with
        | Limits.Stop bound -> Inconclusive bound
        | Out_of_memory -> Inconclusive No_memory
        | States.Disk_failed why -> Inconclusive (Unsettled why))

  let reached t = function
    | Some i -> Violated (path t i)
    | None -> unless_stopped t (fun () -> Holds)

  let no_deadlock t = reached t (deadlock t)
  let never t property = reached t (broken t property)

  let cycle t exact : lasso option =
    let phase = "looking for cycles" in
    let tick () = look_around t phase in
    let successors i = List.map (fun arrival -> (arrival.into, ())) (arrivals_with tick t i) in
    let graph : unit Cycles.graph = { successors; sets = 0; is_in = (fun _ _ -> false) } in
    let around i =
      match Cycles.way graph ~within:(fun _ -> true) ~goal:(Int.equal i) (successors i) with
      | Some way -> i :: List.map fst way
      | None -> invalid_arg "Breadth_first.cycle: a state that is on no cycle"
    in
    let lasso component =
      let first = Cycles.first component in
      let start = if exact first then first else List.find exact (around first) in
      { stem = path t start; around = around start }
    in
    Option.map lasso (Cycles.find ~tick:(ticker t phase) graph [ 0 ])

  (* Each cycle goes through a state that is exact. *)
  let cycle_of_path deep exact : lasso option =
    let rec part from upto = function
      | x :: xs when upto >= 0 -> (if from <= 0 then [ x ] else []) @ part (from - 1) (upto - 1) xs
      | _ -> []
    in
    let of_run (run, place) =
      let last = List.length run - 1 in
      let rec start i = if i > last then None else if exact (List.nth run i) then Some i else start (i + 1) in
      let lasso i = { stem = part 0 i run; around = part i last run @ part place i run } in
      Option.map lasso (start place)
    in
    Option.bind deep.cycle of_run

  let termination t ~exact =
    let search () = match cycle t exact with Some lasso -> Violated lasso | None -> Holds in
    match Option.bind t.deep (fun deep -> cycle_of_path deep exact) with
    | Some lasso -> Violated lasso
    | None -> unless_stopped t (fun () -> if S.may_cycle t.system then search () else Holds)

  (* {1 Formulas}

     Nodes are pairs of a state and a state of the automaton in its set. A cycle goes through an anchor, and its states
     of the automaton are in one component. *)

  let product t monitor : int Cycles.graph =
    let q = Monitor.automaton_states monitor and component = Monitor.component monitor in
    let tick () = look_around t "checking formulas" in
    let successors node =
      let from = node mod q in
      let after { into; valuation; _ } =
        let continued q' = if component q' = component from then Some ((into * q) + q', valuation) else None in
        List.filter_map continued (Monitor.after monitor from valuation)
      in
      List.concat_map after (arrivals_with tick t (node / q))
    in
    let is_in node set = Monitor.is_in monitor (node mod q) set in
    { successors; sets = Monitor.acceptance_sets monitor; is_in }

  let anchors t monitor =
    let q = Monitor.automaton_states monitor in
    let of_state i =
      let first = first_word t i in
      let node q' = if Monitor.component monitor q' < 0 then None else Some ((i * q) + q') in
      if S.is_anchor t.system first then List.filter_map node (Monitor.members monitor (first land mask t)) else []
    in
    let found = ref [] in
    iter t (fun i -> found := of_state i :: !found);
    List.concat (List.rev !found)

  let accepting_cycle t monitor =
    let graph = product t monitor and q = Monitor.automaton_states monitor in
    let lasso component =
      let start = Cycles.first component in
      let cycle = List.map (fun (node, valuation) -> (node / q, valuation)) (Cycles.around graph component start) in
      Around { stem = path t (start / q); cycle }
    in
    Option.map lasso (Cycles.find ~tick:(ticker t "checking formulas") graph (anchors t monitor))

  let formula t =
    match t.monitor, found t.violation with
    | None, _ -> invalid_arg "Breadth_first.formula: no monitor"
    | Some _, Some i -> Violated (Whatever_follows (path t i))
    | Some monitor, None ->
      let search () =
        match if S.may_cycle t.system then accepting_cycle t monitor else None with
        | Some violation -> Violated violation
        | None -> Holds
      in
      unless_stopped t search
end
