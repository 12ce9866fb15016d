open Dolphin_ltl

module Make (S : System.S) = struct
  (* A depth-first search by bitstate hashing. *)
  type deep = {
    bits : Bitstate.t;
    trail : Trail.t;
    runs : (int, int list) Hashtbl.t;  (* to states that are kept *)
    mutable cycle : (int list * int) option;  (* a run whose last state leads to the one at that place *)
  }

  (* Of a search that goes on in several processes. *)
  type shared = {
    team : Team.t;
    mutable expanded : int;  (* by processes that have ended, and by this one *)
    mutable findings : S.findings option;  (* in a worker that can find no more *)
  }

  type t = {
    system : S.t;
    limits : Limits.t;
    phase : string;
    monitor : Monitor.t option;
    mutable reserved : int;  (* bits of first words: for the number of the monitor's set *)
    mutable states : States.t;
    mutable key : int array;  (* the state being expanded *)
    mutable from : int;  (* the monitor's set in it *)
    mutable next : int;  (* to be expanded *)
    mutable depth : int;  (* of [next] *)
    mutable level_end : int;  (* the first state that is deeper *)
    mutable transitions : int;
    mutable work : int;  (* visits and expansions *)
    mutable allocated : float;  (* words by the last look around *)
    mutable deadlock : int;  (* the first such state, or -1; the fields below too *)
    mutable violation : int;
    mutable violation_depth : int;
    broken : (S.property, int) Hashtbl.t;
    mutable stopped : Limits.bound option;
    mutable sample : Sample.t option;
    mutable deep : deep option;
    mutable guard : Limits.guard;
    mutable spill : string option;  (* the store for states when memory runs short *)
    mutable workers : int;
    fork_from : int;  (* states *)
    mutable shared : shared option;
    fresh : int -> int -> unit;
    mutable watcher : Watcher.t option;  (* in a search of all states *)
    give : unit -> unit;  (* before the monitor gives a number *)
    visitor : S.via System.visitor;
  }

  let system t = t.system
  let stopped t = t.stopped
  let count t = States.count t.states
  let iter t f = States.iter t.states f
  let visited deep = Bitstate.states deep.bits
  let others t = match t.shared with Some { team; _ } when not (Team.is_worker team) -> Team.told team | _ -> (0, 0)
  let transitions t = t.transitions + snd (others t)
  let expanded t =
    match t.sample, t.deep, t.shared with
    | Some sample, _, _ -> Sample.visited sample
    | None, Some deep, _ -> visited deep
    | None, None, Some { expanded; _ } -> expanded + fst (others t)
    | None, None, None -> t.next

  let sample t = Option.map (Sample.summary ~seen:(count t)) t.sample
  let bitstate t = Option.map (fun deep -> Bitstate.summary deep.bits) t.deep
  let depth t = max 0 t.depth
  let bytes_of_bits t = Option.fold ~none:0 ~some:(fun deep -> Bitstate.bytes deep.bits) t.deep
  let heap () = 8 * (Gc.quick_stat ()).heap_words
  let heaps_of_others t = match t.shared with Some { team; _ } -> Team.heaps_of_others team | None -> 0
  let memory t = States.bytes t.states + bytes_of_bits t + heap () + heaps_of_others t
  let found i = if i < 0 then None else Some i
  let deadlock t = found t.deadlock
  let broken t property = Hashtbl.find_opt t.broken property
  let is_violated t = t.violation >= 0
  let is_settled t = is_violated t && t.violation_depth <= t.depth

  (* {1 Arriving in states} *)

  let mask t = (1 lsl t.reserved) - 1

  (* A state of the level that is expanded, in which runs may rest, is less deep than those that are arrived in. *)
  let note_violation t i ~depth =
    if t.violation < 0 || depth < t.violation_depth then begin
      t.violation <- i;
      t.violation_depth <- depth
    end

  let arrived t i word =
    Option.iter (fun sample -> Sample.see sample i ~from:t.next) t.sample;
    (match t.monitor with
     | Some monitor when Monitor.is_certain monitor (word land mask t) ->
       note_violation t i ~depth:(t.depth + 1)
     | Some _ | None -> ());
    match S.broken t.system word with
    | Some property when not (Hashtbl.mem t.broken property) -> Hashtbl.add t.broken property i
    | Some _ | None -> ()

  let rest t =
    (match t.monitor with
     | Some monitor when Monitor.stays monitor t.from (S.valuation t.system 0 t.key) ->
       note_violation t t.next ~depth:t.depth
     | Some _ | None -> ());
    if t.deadlock < 0 && not (S.is_end t.system t.key.(0)) then t.deadlock <- t.next

  (* [stride] is how many visits and expansions lie between two looks: to look at each would cost more than the state
     does. Twice as many states are foreseen. *)
  let stride = 4_096

  let rec look_around ?by t phase =
    Option.iter (fun { team; _ } -> Team.look team) t.shared;
    match t.shared with
    | Some { team; _ } when Team.is_worker team -> ()
    | Some _ | None -> look_at_limits ?by t phase

  and look_at_limits ?(by = 2 * stride) t phase =
    let growth = States.bytes_to_grow t.states ~by in
    let states =
      match t.deep with Some { bits; trail; _ } -> Bitstate.states bits + Trail.waiting trail | None -> count t
    in
    let measures = { Limits.states; expanded = expanded t; depth = t.depth; used = memory t; growth } in
    try Limits.look t.guard phase measures
    with Limits.Stop Memory when t.spill <> None ->
      spill t;
      look_around ~by t phase

  (* From now on states take all the memory that they may, and no more of it. *)
  and spill t =
    let to_disk directory =
      t.spill <- None;
      t.guard <- Limits.guard ~started:(Limits.started t.guard) t.limits;
      States.flush t.states ~fresh:t.fresh;
      t.states <- States.spill t.states ~directory ~tick:(fun () -> look_around t t.phase)
    in
    Option.iter to_disk t.spill

  (* The rest is for the parents of states on disk. *)
  let before_spilling (limits : Limits.t) =
    { limits with max_memory = Option.map (fun n -> n / 4 * 3) limits.max_memory }

  let ticker t phase =
    let ticks = ref 0 in
    fun () ->
      incr ticks;
      if !ticks land 0xFF = 0 then look_around t phase

  let follow_up t =
    Limits.follow_up ?stopped:t.stopped ~used:(fun () -> memory t) ~started:(Limits.started t.guard) t.limits

  (* Pushed states are added in batches: close to the bound, one by one. The initial state is always there. *)
  let batch = 256

  let count_states t =
    match t.limits.max_states with
    | Some most when count t > most - batch ->
      if not (States.is_on_disk t.states) then States.flush t.states ~fresh:t.fresh;
      if count t > max most 1 then raise (Limits.Stop States)
    | Some _ | None -> ()

  (* A single expansion may visit many states, and make much that is new. *)
  let most_allocated = 262_144.

  let worked t =
    t.work <- t.work + 1;
    if t.work land 0x3F = 0 then begin
      let minor, promoted, major = Gc.counters () in
      let allocated = minor +. major -. promoted in
      if t.work land (stride - 1) = 0 || allocated -. t.allocated > most_allocated then begin
        t.allocated <- allocated;
        look_around t t.phase
      end
    end

  let push t key =
    worked t;
    States.push t.states key ~parent:(if t.sample = None then t.next else 0) ~fresh:t.fresh;
    count_states t

  (* [put valuation] is for [key] with the monitor's set, if a violation is still possible. *)
  let under t monitor key action put =
    let valuation = S.valuation t.system action key in
    let set = Monitor.next monitor ~give:t.give t.from valuation in
    if set >= 0 then begin
      if set > mask t then raise S.Outgrown;
      key.(0) <- key.(0) lor set;
      put valuation;
      key.(0) <- key.(0) lxor set
    end

  let arrive t key action =
    match t.monitor with
    | None -> push t key
    | Some monitor -> under t monitor key action (fun _ -> push t key)

  let flush t = States.flush t.states ~fresh:t.fresh

  (* {1 Expanding} *)

  let large = 1 lsl 22

  (* The function that the result is makes of a vector in the old encoding one in the new. *)
  let widened t =
    let before = mask t in
    let rec bits_for n bits = if 1 lsl bits >= n then bits else bits_for n (bits + 1) in
    t.reserved <- Option.fold ~none:0 ~some:(fun monitor -> bits_for (Monitor.count monitor) 1) t.monitor;
    let rewritten = S.widen t.system ~reserved:t.reserved in
    let with_set old fresh =
      rewritten old fresh;
      fresh.(0) <- fresh.(0) lor (old.(0) land before)
    in
    let words = S.words t.system in
    let bytes = States.bytes t.states in
    t.states <- States.rewrite t.states ~words (if before = 0 then rewritten else with_set);
    (* A search that spills has no memory for its earlier states. *)
    if States.is_on_disk t.states && bytes >= large then Gc.full_major ();
    t.key <- Array.make words 0;
    fun old ->
      let fresh = Array.make words 0 in
      rewritten old fresh;
      fresh

  let widen t =
    let (_ : int array -> int array) = widened t in
    ()

  let fetch t i =
    States.load t.states i t.key;
    let first = t.key.(0) in
    t.from <- first land mask t;
    t.key.(0) <- first land lnot (mask t)

  (* Whether the states can be rewritten within memory. *)
  let rec weigh_rewriting t =
    let bytes = States.bytes_to_rewrite t.states ~words:(States.words t.states + 1) in
    try Limits.weigh t.guard ~used:(memory t) bytes
    with Limits.Stop Memory when t.spill <> None ->
      spill t;
      weigh_rewriting t

  let outgrow t =
    flush t;
    (* Once this has begun it must not fail. *)
    weigh_rewriting t;
    widen t

  let rec expanding t =
    match fetch t t.next; S.expand t.system t.key t.visitor with
    | taken -> taken
    | exception S.Outgrown ->
      outgrow t;
      expanding t

  let expand t i =
    t.next <- i;
    let taken = expanding t in
    t.transitions <- t.transitions + taken;
    t.next <- i + 1;
    taken

  let create
      ?(compress = false) ?spill ?(workers = 1) ?(fork_from = 100_000) ?monitor ?(phase = "exploring") ?started limits
      system
    =
    if compress && spill <> None then invalid_arg "Breadth_first.create: compressed states on disk";
    let states = States.create ~compress ~words:1 in
    let guard = Limits.guard ?started (if spill = None then limits else before_spilling limits) in
    let rec t =
      { system; limits; phase; monitor; reserved = 0; states; key = [| 0 |]; from = Monitor.start; next = 0; depth = -1;
        level_end = 0; transitions = 0; work = 0; allocated = 0.; deadlock = -1; violation = -1; violation_depth = -1;
        broken = Hashtbl.create 8; stopped = None; sample = None; deep = None; guard; spill; workers; fork_from;
        shared = None;
        fresh = (fun i word -> arrived t i word);
        watcher = None;
        give = (fun () -> Numbering.give (S.numbering system));
        visitor = { visit; tick = (fun () -> look_around ~by:256 t t.phase); rest = (fun () -> rest t) } }
    and visit key action _ = arrive t key action in
    let rec begin_with () =
      match widen t; S.initial system t.visitor with
      | () -> flush t
      | exception S.Outgrown -> begin_with ()
      | exception Limits.Stop bound -> t.stopped <- Some bound
    in
    begin_with ();
    t

  let close t =
    Option.iter (fun { team; _ } -> Team.close team) t.shared;
    States.close t.states

  let more t =
    t.next < count t
    || begin
      flush t;
      t.next < count t
    end

  let deeper t =
    flush t;
    t.depth <- t.depth + 1;
    t.level_end <- count t;
    if t.limits.max_depth = Some t.depth then raise (Limits.Stop Depth)

  let path_to t i =
    let parent = match t.sample with Some sample -> Sample.from sample | None -> States.parent t.states in
    let rec back i states = if i = 0 then 0 :: states else back (parent i) (i :: states) in
    back i []
  let see t i = Option.iter (fun (watcher : Watcher.t) -> watcher.see i) t.watcher
  let check_states t = if Limits.exceeds t.limits.max_states (count t) then raise (Limits.Stop States)
end
