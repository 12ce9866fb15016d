open Dolphin_ltl

type 'run verdict = Holds | Violated of 'run | Inconclusive of Limits.bound
type lasso = { stem : int list; around : int list }
type violation = Whatever_follows of int list | Around of { stem : int list; cycle : (int * int) list }

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
    mutable deadlock : int;  (* the first state that is one, or -1; likewise *)
    mutable violation : int;
    broken : (S.property, int) Hashtbl.t;
    mutable stopped : Limits.bound option;
    mutable sample : Sample.t option;
    mutable deep : deep option;
    mutable guard : Limits.guard;
    mutable spill : string option;  (* where states will go when there is too little memory *)
    mutable workers : int;
    fork_from : int;  (* states *)
    mutable shared : shared option;
    fresh : int -> int -> unit;
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

  (* {1 Arriving in states} *)

  let mask t = (1 lsl t.reserved) - 1
  let note_violation t i = if t.violation < 0 then t.violation <- i

  let arrived t i word =
    Option.iter (fun sample -> Sample.see sample i ~from:t.next) t.sample;
    (match t.monitor with
     | Some monitor when Monitor.is_certain monitor (word land mask t) -> note_violation t i
     | Some _ | None -> ());
    match S.broken t.system word with
    | Some property when not (Hashtbl.mem t.broken property) -> Hashtbl.add t.broken property i
    | Some _ | None -> ()

  let rest t =
    (match t.monitor with
     | Some monitor when Monitor.stays monitor t.from (S.valuation t.system 0 t.key) -> note_violation t t.next
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

  (* What is left is for the parents of states on disk. *)
  let before_spilling (limits : Limits.t) =
    { limits with max_memory = Option.map (fun n -> n / 4 * 3) limits.max_memory }

  let ticker t phase =
    let ticks = ref 0 in
    fun () ->
      incr ticks;
      if !ticks land 0xFF = 0 then look_around t phase

  (* What is pushed is added in batches: close to the bound, one by one. The initial state is always there. *)
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
    let set = Monitor.next monitor t.from valuation in
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
    (* Whoever spills has no memory for what was before. *)
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

  (* Whether there is room to write the states anew. *)
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
        level_end = 0; transitions = 0; work = 0; allocated = 0.; deadlock = -1; violation = -1;
        broken = Hashtbl.create 8; stopped = None; sample = None; deep = None; guard; spill; workers; fork_from;
        shared = None;
        fresh = (fun i word -> arrived t i word);
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

  (* {1 Several processes} *)

  let shared_states t =
    match States.shared t.states with
    | Some states -> states
    | None -> invalid_arg "Breadth_first.shared_states"

  (* What a worker has found, and the leader has not. *)
  type report = {
    found : S.findings;
    by_worker : int * int;  (* expanded states, transitions *)
    resting : int;
    breaking : (S.property * int) list;
  }

  let path_to t i =
    let parent = match t.sample with Some sample -> Sample.from sample | None -> States.parent t.states in
    let rec back i states = if i = 0 then 0 :: states else back (parent i) (i :: states) in
    back i []

  let earlier t i j =
    match List.compare_lengths (path_to t i) (path_to t j) with 0 -> Int.compare i j | order -> order

  let first_of t i j = if i < 0 then j else if j < 0 || earlier t i j <= 0 then i else j

  let report t { expanded; findings; _ } =
    let found = match findings with Some findings -> findings | None -> S.findings t.system in
    let breaking = Hashtbl.fold (fun property i found -> (property, i) :: found) t.broken [] in
    Marshal.to_string { found; by_worker = (expanded, t.transitions); resting = t.deadlock; breaking } []

  let add_report t shared text =
    let { found; by_worker = (expanded, transitions); resting; breaking } : report = Marshal.from_string text 0 in
    S.add_findings t.system found;
    shared.expanded <- shared.expanded + expanded;
    t.transitions <- t.transitions + transitions;
    t.deadlock <- first_of t t.deadlock resting;
    let add (property, i) =
      let known = Option.value (Hashtbl.find_opt t.broken property) ~default:(-1) in
      Hashtbl.replace t.broken property (first_of t known i)
    in
    List.iter add breaking

  let numbering t tick key =
    ignore (S.expand t.system key { visit = (fun _ _ _ -> ()); tick; rest = ignore } : int);
    S.check_fit t.system

  let catch_up t { team; _ } = Team.catch_up team ~words:(States.words t.states) (numbering t ignore)

  (* What is found while something is learnt in vain may be told by numbers that no other process knows. *)
  let learn t ({ team; _ } as shared) key =
    let findings = S.findings t.system in
    try Team.learn team ~words:(States.words t.states) (numbering t t.visitor.tick) key
    with e ->
      shared.findings <- Some findings;
      raise e

  let rec expand_shared t shared i =
    t.next <- i;
    fetch t i;
    match S.expand t.system t.key t.visitor with
    | taken ->
      t.transitions <- t.transitions + taken;
      shared.expanded <- shared.expanded + 1
    | exception Numbering.Closed ->
      fetch t i;
      learn t shared t.key;
      expand_shared t shared i

  let expand_block t ({ team; _ } as shared) (block : Team.block) =
    let states = shared_states t in
    let rec next () =
      if block.first < block.upto then begin
        worked t;
        expand_shared t shared (Shared_states.number states block.segment block.first);
        if (not (Team.is_worker team)) && Limits.exceeds t.limits.max_states (count t) then raise (Limits.Stop States);
        block.first <- block.first + 1;
        next ()
      end
    in
    match next () with
    | () -> true
    | exception (Limits.Stop _ as stop) when not (Team.is_worker team) -> raise stop
    | exception _ ->
      Team.leave team block;
      false

  let tell t { team; expanded; _ } =
    if Team.is_worker team then Team.tell team ~expanded ~transitions:t.transitions ~heap:(heap ())

  let deepen t team () =
    if t.limits.max_depth = Some (Team.depth team + 1) then begin
      t.depth <- Team.depth team + 1;
      raise (Limits.Stop Depth)
    end

  let meet t { team; _ } reason = Team.meet team ~deepen:(deepen t team) reason

  let work t ({ team; _ } as shared) () =
    if Team.is_worker team then begin
      t.transitions <- 0;
      shared.expanded <- 0
    end;
    let grow _ = if not (meet t shared Full) then raise Team.Over in
    Shared_states.when_full (shared_states t) grow;
    let rec go () =
      t.depth <- Team.depth team;
      match Team.take team with
      | Some block -> if expand_block t shared block then go () else rest ()
      | None -> rest ()
    and rest () =
      flush t;
      tell t shared;
      if meet t shared Done then begin
        catch_up t shared;
        go ()
      end
    in
    go ()

  let check_states t = if Limits.exceeds t.limits.max_states (count t) then raise (Limits.Stop States)

  (* In this process alone, where anything may come up. It may have given numbers in vain, that do not fit. *)
  let expand_left t shared (block : Team.block) =
    (match S.check_fit t.system with () -> () | exception S.Outgrown -> outgrow t);
    for p = block.first to block.upto - 1 do
      worked t;
      ignore (expand t (Shared_states.number (shared_states t) block.segment p) : int);
      shared.expanded <- shared.expanded + 1;
      check_states t
    done

  let rec expand_together t ({ team; _ } as shared) =
    let reports, stop = Team.lead team ~work:(work t shared) ~report:(fun () -> report t shared) in
    Shared_states.when_full (shared_states t) Shared_states.grow_alone;
    catch_up t shared;
    shared.findings <- None;
    List.iter (add_report t shared) reports;
    match stop, Team.left team with
    | Some (e, trace), _ -> Printexc.raise_with_backtrace e trace
    | None, [] -> ()
    | None, left ->
      List.iter (expand_left t shared) left;
      flush t;
      expand_together t shared

  let is_shareable t =
    t.workers > 1 && t.monitor = None && t.spill = None && States.is_shareable t.states && count t >= t.fork_from

  (* States from [next] on are a level. *)
  let share t =
    let look () =
      look_at_limits t t.phase;
      check_states t
    in
    match
      let states = States.share t.states ~workers:t.workers in
      match Team.create (fun () -> shared_states t) (S.numbering t.system) ~workers:t.workers ~look with
      | team -> (states, team)
      | exception Out_of_memory ->
        States.close states;
        raise Out_of_memory
    with
    | states, team ->
      t.states <- states;
      Team.begin_levels team ~depth:t.depth ~from:t.next;
      t.shared <- Some { team; expanded = t.next; findings = None };
      (* Not all that is shared is in this process's memory. *)
      let memory_taken () = Option.map (max (memory t)) (t.limits.memory_taken ()) in
      t.guard <- Limits.guard ~started:(Limits.started t.guard) { t.limits with memory_taken }
    | exception Out_of_memory -> t.workers <- 1

  let rec expand_all t ~is_plain look enough =
    if (not (is_violated t || enough ())) && more t then begin
      if t.next >= t.level_end then begin
        deeper t;
        if is_plain && is_shareable t then share t
      end;
      match t.shared with
      | Some shared -> expand_together t shared
      | None ->
        worked t;
        look t.next;
        ignore (expand t t.next : int);
        check_states t;
        expand_all t ~is_plain look enough
    end

  (* {1 Random walks} *)

  (* Any of the transitions is as likely as another; each state that one leads to is seen. The result is where it goes
     on, or -1. *)
  let rec random_step t sample i =
    t.next <- i;
    fetch t i;
    let chosen = Array.make (States.words t.states) 0 and n = ref 0 in
    let visit key action _ =
      arrive t key action;
      incr n;
      if Sample.draw sample !n = 0 then Array.blit key 0 chosen 0 (Array.length chosen)
    in
    match S.expand t.system t.key { t.visitor with visit } with
    | taken ->
      flush t;
      if Sample.is_new sample i then t.transitions <- t.transitions + taken;
      if !n = 0 then -1 else States.find t.states chosen
    | exception S.Outgrown ->
      flush t;
      Limits.weigh t.guard ~used:(memory t) (States.bytes_to_rewrite t.states ~words:(States.words t.states + 1));
      widen t;
      random_step t sample i

  let default_length = 10_000

  let walk t sample look enough =
    let most = Option.value t.limits.max_depth ~default:default_length in
    let rec go i depth =
      t.depth <- max t.depth depth;
      worked t;
      if Sample.is_new sample i then look i;
      let next = random_step t sample i in
      Sample.visit sample i;
      if Limits.exceeds t.limits.max_states (count t) then raise (Limits.Stop States);
      if next >= 0 && depth < most && not (enough ()) then go next (depth + 1)
    in
    Sample.begin_walk sample;
    go 0 0

  let is_all_visited t sample = Sample.visited sample = count t

  let walk_all t sample walks look enough =
    look_around t t.phase;
    t.depth <- 0;
    let rec from n =
      if n < walks && not (enough () || is_all_visited t sample) then begin
        walk t sample look enough;
        from (n + 1)
      end
    in
    from 0;
    if not (is_all_visited t sample) then raise (Limits.Stop Sampled)

  (* {1 Bitstate hashing}

     A state is marked when its turn comes, and then expanded: so the search is depth first, and comes back to the path
     on each cycle. Only runs that are shown are kept. *)

  let here = -1

  (* The numbers of [states], a run. *)
  let numbers_of t states =
    let number key =
      if States.find t.states key < 0 then begin
        States.push t.states key ~parent:0 ~fresh:(fun _ _ -> ());
        States.flush t.states ~fresh:(fun _ _ -> ())
      end;
      States.find t.states key
    in
    List.map number states

  (* The number of the last of [states], a run. *)
  let keep_run t deep states =
    let numbers = numbers_of t states in
    let last = List.nth numbers (List.length numbers - 1) in
    if not (Hashtbl.mem deep.runs last) then Hashtbl.add deep.runs last numbers;
    last

  let keep t i =
    match t.deep with Some deep when i = here -> keep_run t deep (Trail.path deep.trail) | Some _ | None -> i

  let hash t deep key =
    Bitstate.begin_state deep.bits;
    S.numbers t.system key (Bitstate.add deep.bits);
    Bitstate.hash deep.bits

  let look_for_cycle t deep key hash =
    if deep.cycle = None then
      match Trail.depth_on_path deep.trail ~hash key with
      | Some place -> deep.cycle <- Some (numbers_of t (Trail.path deep.trail), place)
      | None -> ()

  let visit_deep t deep depth key =
    worked t;
    (match S.broken t.system key.(0) with
     | Some property when not (Hashtbl.mem t.broken property) ->
       Hashtbl.add t.broken property (keep_run t deep (Trail.path deep.trail @ [ Array.copy key ]))
     | Some _ | None -> ());
    let hash = hash t deep key in
    if Bitstate.is_marked deep.bits then look_for_cycle t deep key hash
    else if t.limits.max_depth <> Some depth then
      Trail.push deep.trail { state = Array.copy key; depth = depth + 1; hash }

  let rec expanding_deep t deep depth =
    let waiting = Trail.waiting deep.trail in
    let rest () =
      if t.deadlock < 0 && not (S.is_end t.system t.key.(0)) then t.deadlock <- keep t here in
    let visit key _ _ = visit_deep t deep depth key in
    match S.expand t.system (Array.copy t.key) { t.visitor with visit; rest } with
    | taken -> t.transitions <- t.transitions + taken
    | exception S.Outgrown ->
      Trail.drop_to deep.trail waiting;
      Limits.weigh t.guard ~used:(memory t) (States.bytes_to_rewrite t.states ~words:(States.words t.states + 1));
      let present = t.key in
      let renewed = widened t in
      Trail.rewrite deep.trail renewed;
      t.key <- renewed present;
      expanding_deep t deep depth

  let expand_deep t deep (entry : Trail.entry) look =
    ignore (hash t deep entry.state);
    if not (Bitstate.is_marked deep.bits) then begin
      Bitstate.mark deep.bits;
      t.depth <- max t.depth entry.depth;
      Trail.enter deep.trail entry;
      t.key <- Array.copy entry.state;
      look here;
      expanding_deep t deep entry.depth;
      if Limits.exceeds t.limits.max_states (visited deep) then raise (Limits.Stop States)
    end

  let deepen t bytes look enough =
    look_around t t.phase;
    Limits.weigh t.guard ~used:(memory t) bytes;
    Gc.full_major ();
    let runs = Hashtbl.create 8 in
    let deep = { bits = Bitstate.create ~bytes; trail = Trail.create (); runs; cycle = None } in
    t.deep <- Some deep;
    Hashtbl.add runs 0 [ 0 ];
    let initial = Array.make (States.words t.states) 0 in
    States.load t.states 0 initial;
    Trail.push deep.trail { state = initial; depth = 0; hash = hash t deep initial };
    let rec go () =
      match if enough () then None else Trail.pop deep.trail with
      | Some entry ->
        worked t;
        expand_deep t deep entry look;
        go ()
      | None -> ()
    in
    go ();
    raise (Limits.Stop Hashed)

  (* Once there is no memory nothing can be added, not even what waits; and what waits for the disk takes long. *)
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

  let run ?look ?enough t =
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
    run_by (fun () -> walk_all t sample walks look enough) t

  let run_bitstate ?(look = ignore) ?(enough = fun () -> false) t ~bytes =
    if t.monitor <> None then invalid_arg "Breadth_first.run_bitstate: a monitor";
    run_by (fun () -> deepen t bytes look enough) t

  (* {1 States} *)

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

  type arrival = { into : int; valuation : int; via : S.via }

  (* What a system numbers may grow by looking at a state again, too. *)
  let rec arrivals_with tick t i =
    let found = ref [] in
    let put key via valuation = found := { into = States.find t.states key; valuation; via } :: !found in
    let visit key action via =
      match t.monitor with None -> put key via 0 | Some monitor -> under t monitor key action (put key via)
    in
    fetch t i;
    match S.expand t.system t.key { visit; tick; rest = ignore } with
    | (_ : int) -> List.rev !found
    | exception S.Outgrown ->
      widen t;
      arrivals_with tick t i

  let arrivals t i = arrivals_with ignore t i

  let rec visiting t i expand =
    let arrived = ref ignore in
    let visit key _ _ = !arrived (States.find t.states key) in
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
