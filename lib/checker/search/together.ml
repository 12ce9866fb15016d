module Make (S : System.S) = struct
  open Search_state.Make (S)

  let shared_states t =
    match States.shared t.states with
    | Some states -> states
    | None -> invalid_arg "Together.shared_states"

  (* The findings of a worker that the leader lacks. *)
  type report = {
    found : S.findings;
    by_worker : int * int;  (* expanded states, transitions *)
    resting : int;
    violating : int;
    breaking : (S.property * int) list;
    watched : string;
  }

  let earlier t i j =
    match List.compare_lengths (path_to t i) (path_to t j) with 0 -> Int.compare i j | order -> order

  let first_of t i j = if i < 0 then j else if j < 0 || earlier t i j <= 0 then i else j

  let report t { expanded; findings; _ } =
    let found = match findings with Some findings -> findings | None -> S.findings t.system in
    let breaking = Hashtbl.fold (fun property i found -> (property, i) :: found) t.broken [] in
    let by_worker = (expanded, t.transitions) in
    let watched = Option.fold t.watcher ~none:"" ~some:(fun (watcher : Watcher.t) -> watcher.told ()) in
    Marshal.to_string { found; by_worker; resting = t.deadlock; violating = t.violation; breaking; watched } []

  let add_report t shared text =
    let report : report = Marshal.from_string text 0 in
    let { found; by_worker = (expanded, transitions); resting; violating; breaking; watched } = report in
    S.add_findings t.system found;
    shared.expanded <- shared.expanded + expanded;
    t.transitions <- t.transitions + transitions;
    t.deadlock <- first_of t t.deadlock resting;
    t.violation <- first_of t t.violation violating;
    let add (property, i) =
      let known = Option.value (Hashtbl.find_opt t.broken property) ~default:(-1) in
      Hashtbl.replace t.broken property (first_of t known i)
    in
    List.iter add breaking;
    Option.iter (fun (watcher : Watcher.t) -> watcher.hear ~first:(first_of t) watched) t.watcher

  (* [key] is with the monitor's set. *)
  let numbering t tick key =
    let set = key.(0) land mask t in
    t.from <- set;
    key.(0) <- key.(0) lxor set;
    let visit key action _ = Option.iter (fun monitor -> under t monitor key action ignore) t.monitor in
    ignore (S.expand t.system key { visit; tick; rest = ignore } : int);
    S.check_fit t.system

  let catch_up t { team; _ } = Team.catch_up team ~words:(States.words t.states) (numbering t ignore)

  (* Findings made during a vain learning step may use numbers that no other process knows. *)
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
      t.key.(0) <- t.key.(0) lxor t.from;
      learn t shared t.key;
      expand_shared t shared i

  let expand_block t ({ team; _ } as shared) (block : Team.block) =
    let states = shared_states t in
    let rec next () =
      if block.first < block.upto then begin
        worked t;
        let i = Shared_states.number states block.segment block.first in
        see t i;
        expand_shared t shared i;
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
      if is_settled t then Team.give_up team;
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

  (* In this process alone, since it may meet any case. It may have given numbers in vain, that do not fit. *)
  let expand_left t shared (block : Team.block) =
    (match S.check_fit t.system with () -> () | exception S.Outgrown -> outgrow t);
    for p = block.first to block.upto - 1 do
      worked t;
      let i = Shared_states.number (shared_states t) block.segment p in
      see t i;
      ignore (expand t i : int);
      shared.expanded <- shared.expanded + 1;
      check_states t
    done

  let rec expand_all t ({ team; _ } as shared) =
    let reports, stop = Team.lead team ~work:(work t shared) ~report:(fun () -> report t shared) in
    Shared_states.when_full (shared_states t) Shared_states.grow_alone;
    catch_up t shared;
    shared.findings <- None;
    List.iter (add_report t shared) reports;
    match stop, Team.left team with
    | Some (e, trace), _ -> Printexc.raise_with_backtrace e trace
    | None, left ->
      if left <> [] && not (is_violated t) then begin
        List.iter (expand_left t shared) left;
        flush t;
        expand_all t shared
      end

  let is_possible t =
    t.workers > 1 && t.spill = None && States.is_shareable t.states && count t >= t.fork_from

  (* States from [next] on are a level. *)
  let start t =
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
end
