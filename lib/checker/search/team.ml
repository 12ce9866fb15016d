open Bigarray

exception Over

type other = { pid : int; from : in_channel; mutable ended : bool }

type t = {
  states : unit -> Shared_states.t;
  numbering : Numbering.t;
  size : int;
  control : Shared_memory.words;
  log : Shared_memory.words;
  wait_look : unit -> unit;
  leader : int;
  mutable me : int;
  mutable met : int;  (* how often *)
  mutable known : int;  (* how much of the log *)
  mutable others : other list;
}

(* {1 Shared words}

   Those that several processes write to often are on lines of their own in the caches. *)

let line = 16
let meetings = 0
let command = 1
let arrived = line
let ending = 2 * line
let lock = 3 * line
let logged = 4 * line
let depth_now = 5 * line
let block_size = (5 * line) + 1
let cursor w = (6 + (3 * w)) * line
let limit w = (7 + (3 * w)) * line
let reason_of w = limit w + 1
let left_segment w = limit w + 2
let left_first w = limit w + 3
let left_upto w = limit w + 4
let expanded_by w = (8 + (3 * w)) * line
let transitions_by w = expanded_by w + 1
let heap_of w = expanded_by w + 2

(* Values of [command]. *)
let go_on = 0
let grow = 1
let finish = 2

(* Values of [ending]. *)
let not_ending = 0
let left_to_leader = 1
let stopping = 2

(* Values of [reason_of]. *)
let is_done = 0
let is_full = 1
let has_filled = 2

type reason = Done | Full
type block = { segment : int; mutable first : int; upto : int }

(* When it is full the workers end, and it begins again. *)
let log_words = 1 lsl 22

let create states numbering ~workers ~look =
  let control = Shared_memory.map int ((9 + (3 * workers)) * line) in
  { states; numbering; size = workers; control; log = Shared_memory.map int log_words; wait_look = look;
    leader = Unix.getpid (); me = 0; met = 0; known = 0; others = [] }

let close t =
  Shared_memory.unmap t.control;
  Shared_memory.unmap t.log

let get t i = Shared_memory.read t.control i
let set t i x = Shared_memory.write t.control i x
let is_worker t = t.me > 0
let sum t f =
  let rec from w n = if w = t.size then n else from (w + 1) (n + f w) in
  from 0 0

let exists t f =
  let rec from w = w < t.size && (f w || from (w + 1)) in
  from 0

(* {1 Looking around} *)

let ended status = Limits.Stop (Unsettled ("a worker process ended early, " ^ Dolphin_processes.Workers.how status))

let look_at_others t =
  let look other =
    match if other.ended then (0, Unix.WEXITED 0) else Unix.waitpid [ WNOHANG ] other.pid with
    | 0, _ -> ()
    | _, status ->
      other.ended <- true;
      raise (ended status)
    | exception Unix.Unix_error (EINTR, _, _) -> ()
  in
  List.iter look t.others

let look t =
  if is_worker t then begin
    if Unix.getppid () <> t.leader then Unix._exit 1;
    if get t ending = stopping then raise Over
  end
  else look_at_others t

let rec pause seconds =
  match Unix.sleepf seconds with () -> () | exception Unix.Unix_error (EINTR, _, _) -> pause seconds

(* Most waits are short. *)
let wait t is_over =
  let rec from n =
    if not (is_over ()) then begin
      if n > 1_000 then begin
        look t;
        if not (is_worker t) then t.wait_look ();
        pause 50e-6
      end;
      from (n + 1)
    end
  in
  from 0

(* {1 Levels} *)

let depth t = get t depth_now

(* Blocks are small where a level is: all are to have some. *)
let set_level t =
  let n = sum t (fun w -> max 0 (get t (limit w) - get t (cursor w))) in
  set t block_size (max 1 (min 64 (n / (8 * t.size))))

let begin_levels t ~depth ~from =
  set t depth_now depth;
  set t (cursor 0) from;
  set t (limit 0) (Shared_states.filled (t.states ()) 0);
  set_level t

let is_level_last t = not (exists t (fun w -> Shared_states.filled (t.states ()) w > get t (limit w)))

let next_level t =
  set t depth_now (depth t + 1);
  for w = 0 to t.size - 1 do
    set t (cursor w) (get t (limit w));
    set t (limit w) (Shared_states.filled (t.states ()) w)
  done;
  set_level t

let take t =
  let size = get t block_size in
  let rec from n =
    if n = t.size then None
    else
      let w = (t.me + n) mod t.size in
      let limit = get t (limit w) in
      if get t (cursor w) >= limit then from (n + 1)
      else
        let first = Shared_memory.add t.control (cursor w) size in
        if first >= limit then from (n + 1) else Some { segment = w; first; upto = min limit (first + size) }
  in
  if get t ending <> not_ending then None else from 0

let give_up t = ignore (Shared_memory.swap t.control ending not_ending left_to_leader : bool)

let leave t block =
  set t (left_segment t.me) block.segment;
  set t (left_first t.me) block.first;
  set t (left_upto t.me) block.upto;
  give_up t

let left t =
  let of_worker w =
    if get t (left_first w) < get t (left_upto w) then
      Some { segment = get t (left_segment w); first = get t (left_first w); upto = get t (left_upto w) }
    else None
  in
  List.filter_map of_worker (List.init t.size Fun.id)

(* {1 Meeting} *)

let tell_all t said =
  set t arrived 0;
  set t command said;
  t.met <- t.met + 1;
  set t meetings t.met

let meet_others t reason =
  set t (reason_of t.me) reason;
  ignore (Shared_memory.add t.control arrived 1 : int);
  let before = t.met in
  wait t (fun () -> get t meetings <> before);
  t.met <- get t meetings;
  get t command

let decide t ~deepen reason =
  set t (reason_of 0) reason;
  wait t (fun () -> get t arrived = t.size - 1);
  let some reason = exists t (fun w -> get t (reason_of w) = reason) in
  let said =
    if some is_full then begin
      Shared_states.begin_growing (t.states ());
      grow
    end
    else if some has_filled then go_on
    else if get t ending <> not_ending || is_level_last t then finish
    else begin
      deepen ();
      next_level t;
      go_on
    end
  in
  tell_all t said;
  said

let rec meeting t ~deepen reason =
  let said = if is_worker t then meet_others t reason else decide t ~deepen reason in
  if said = grow then begin
    Shared_states.fill_part (t.states ());
    meeting t ~deepen has_filled
  end
  else said = go_on

let meet t ~deepen reason = meeting t ~deepen (match reason with Done -> is_done | Full -> is_full)

(* {1 Learning} *)

let catch_up t ~words f =
  let known = get t logged in
  if t.known < known then
    Numbering.opened t.numbering (fun () ->
        for n = t.known to known - 1 do
          f (Array.init words (fun w -> Array1.get t.log ((n * words) + w)))
        done);
  t.known <- max t.known known

let locked t f =
  wait t (fun () -> Shared_memory.swap t.control lock 0 1);
  Fun.protect ~finally:(fun () -> set t lock 0) f

let tell_key t ~words key =
  if (t.known + 1) * words > log_words then raise Over;
  for w = 0 to words - 1 do
    Array1.set t.log ((t.known * words) + w) key.(w)
  done;
  t.known <- t.known + 1;
  set t logged t.known

let learn t ~words f key =
  locked t (fun () ->
      if get t ending <> not_ending then raise Over;
      catch_up t ~words f;
      let key = Array.sub key 0 words in
      match Numbering.opened t.numbering (fun () -> f (Array.copy key)); tell_key t ~words key with
      | () -> ()
      | exception e ->
        give_up t;
        raise e)

(* {1 Processes} *)

let tell t ~expanded ~transitions ~heap =
  set t (heap_of t.me) heap;
  set t (expanded_by t.me) expanded;
  set t (transitions_by t.me) transitions

let told t = (sum t (fun w -> get t (expanded_by w)), sum t (fun w -> get t (transitions_by w)))

let heaps_of_others t = sum t (fun w -> get t (heap_of w))

let forget_told t =
  for w = 0 to t.size - 1 do
    set t (expanded_by w) 0;
    set t (transitions_by w) 0;
    set t (heap_of w) 0
  done

let become t w =
  t.me <- w;
  List.iter (fun other -> close_in_noerr other.from) t.others;
  t.others <- [];
  Shared_states.become (t.states ()) w;
  Sys.set_signal Sys.sigint Signal_ignore;
  Sys.set_signal Sys.sigterm Signal_default

(* The leader's unwritten output is not written, and its exit actions do not run. *)
let live ~work ~report out =
  let status =
    match
      (try work () with Over -> ());
      let channel = Unix.out_channel_of_descr out in
      output_string channel (Marshal.to_string (report () : string) []);
      flush channel
    with
    | () -> 0
    | exception _ -> 3
  in
  Unix._exit status

let fork t ~work ~report w =
  let from, out = Unix.pipe ~cloexec:true () in
  match Unix.fork () with
  | 0 ->
    Unix.close from;
    become t w;
    live ~work ~report out
  | pid ->
    Unix.close out;
    t.others <- { pid; from = Unix.in_channel_of_descr from; ended = false } :: t.others
  | exception Unix.Unix_error (error, _, _) ->
    Unix.close from;
    Unix.close out;
    raise (Limits.Stop (Unsettled ("no worker process can be made: " ^ Unix.error_message error)))

let rec await pid =
  match Unix.waitpid [] pid with
  | _, status -> status
  | exception Unix.Unix_error (EINTR, _, _) -> await pid

let kill other =
  if not other.ended then begin
    other.ended <- true;
    (try Unix.kill other.pid Sys.sigkill with Unix.Unix_error _ -> ());
    ignore (await other.pid : Unix.process_status)
  end;
  close_in_noerr other.from

let kill_all t =
  List.iter kill t.others;
  t.others <- []

let rec has_said other ~until =
  match Unix.select [ Unix.descr_of_in_channel other.from ] [] [] (Float.max 0. (until -. Unix.gettimeofday ())) with
  | ready, _, _ -> ready <> []
  | exception Unix.Unix_error (EINTR, _, _) -> has_said other ~until

(* The reports of the others that arrive within the given number of seconds. *)
let hear t ~within =
  let until = Unix.gettimeofday () +. within in
  let report other =
    match if has_said other ~until then Some (Marshal.from_channel other.from : string) else None with
    | None -> None
    | Some report ->
      if not other.ended then ignore (await other.pid : Unix.process_status);
      other.ended <- true;
      Some report
    | exception (End_of_file | Failure _ | Sys_error _) -> None
  in
  let reports = List.map report t.others in
  kill_all t;
  forget_told t;
  reports

(* How long those that are at something may take to end it. *)
let patience = 0.5

let lead t ~work ~report =
  set t ending not_ending;
  set t logged 0;
  set t arrived 0;
  set t lock 0;
  t.known <- 0;
  for w = 0 to t.size - 1 do
    set t (left_first w) 0;
    set t (left_upto w) 0
  done;
  flush_all ();
  let work () = Numbering.closed t.numbering work in
  let all () =
    for w = 1 to t.size - 1 do fork t ~work ~report w done;
    work ()
  in
  let finished = match all () with () -> Ok () | exception e -> Error (e, Printexc.get_raw_backtrace ()) in
  match finished with
  | Ok () ->
    let reports = hear t ~within:60. in
    if List.mem None reports then raise (Limits.Stop (Unsettled "a worker process ended early"));
    (List.filter_map Fun.id reports, None)
  | Error (e, trace) ->
    set t ending stopping;
    tell_all t finish;
    let is_missing = List.exists (fun other -> other.ended) t.others in
    let reports = hear t ~within:(if is_missing then 0. else patience) in
    (List.filter_map Fun.id reports, Some (e, trace))
