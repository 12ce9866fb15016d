type t = {
  max_states : int option;
  max_depth : int option;
  max_memory : int option;
  memory_taken : unit -> int option;
  memory_left : unit -> int option;
  timeout : float option;
  clock : unit -> float;
  interrupted : unit -> bool;
  progress : progress -> unit;
}

and progress = {
  phase : string;
  states : int;
  rate : float;
  frontier : int;
  depth : int;
  memory : int;
  elapsed : float;
}

let none =
  {
    max_states = None;
    max_depth = None;
    max_memory = None;
    memory_taken = (fun () -> None);
    memory_left = (fun () -> None);
    timeout = None;
    clock = Sys.time;
    interrupted = (fun () -> false);
    progress = ignore;
  }

type bound = States | Depth | Memory | No_memory | Time | Interruption | Sampled | Hashed | Unsettled of string

exception Stop of bound

let pp_bound ppf bound =
  Format.pp_print_string ppf
    (match bound with
     | States -> "the bound on states was met"
     | Depth -> "the bound on depth was met"
     | Memory -> "the bound on memory was met"
     | No_memory -> "the machine has no more memory for it"
     | Time -> "the time was up"
     | Interruption -> "it was interrupted"
     | Sampled -> "only random walks were followed"
     | Hashed -> "a hash may have left out states"
     | Unsettled why -> why)

let exceeds bound n = match bound with Some most -> n > most | None -> false

type guard = {
  limits : t;
  started : float;
  mutable reported : float;
  mutable weighed : float;  (* when it was asked what memory is left *)
  mutable asked : float;  (* when it was asked what memory is taken *)
  mutable unseen : int;  (* bytes that were taken then beyond those in use *)
}

let guard ?started limits =
  let started = match started with Some started -> started | None -> limits.clock () in
  { limits; started; reported = started; weighed = Float.neg_infinity;
    asked = Float.neg_infinity; unseen = 0 }

let started g = g.started

type measures = { states : int; expanded : int; depth : int; used : int; growth : int }

(* The size of the process differs from its use of memory: code and free parts of the heap are beyond that, and
   memory that it has not written to yet is less. *)
let ask_taken g ~used =
  match g.limits.memory_taken () with Some taken -> g.unseen <- taken - used | None -> ()

let weigh_own g ~used growth =
  (* A part is for growth between two looks. *)
  let bound = Option.map (fun most -> most - (most / 32)) g.limits.max_memory in
  let is_beyond () = exceeds bound (used + g.unseen + growth) in
  if is_beyond () then begin
    ask_taken g ~used;
    if is_beyond () then raise (Stop Memory)
  end

(* Unwritten memory may be written to in a moment. *)
let ask_sometimes g now ~used =
  if g.limits.max_memory <> None && now -. g.asked >= 0.01 then begin
    g.asked <- now;
    ask_taken g ~used
  end

(* A system that has given all its memory kills without a word. So a part of the available memory is left alone: for
   others, and for growth between two looks. *)
let weigh g ~used growth =
  weigh_own g ~used growth;
  match g.limits.memory_left () with
  | Some left when growth > left - ((used + left) / 10) -> raise (Stop No_memory)
  | Some _ | None -> ()

(* To ask what is left costs some reads of files. *)
let weigh_sometimes g now { used; growth; _ } =
  ask_sometimes g now ~used;
  weigh_own g ~used growth;
  if growth >= 1 lsl 20 || now -. g.weighed >= 0.1 then begin
    g.weighed <- now;
    weigh g ~used growth
  end

let report g phase elapsed { states; expanded; depth; used; _ } =
  let rate = float_of_int states /. Float.max elapsed 1e-3 in
  g.limits.progress { phase; states; rate; frontier = states - expanded; depth; memory = used; elapsed }

let look g phase measures =
  let now = g.limits.clock () in
  let elapsed = now -. g.started in
  if g.limits.interrupted () then raise (Stop Interruption);
  if (match g.limits.timeout with Some most -> elapsed > most | None -> false) then raise (Stop Time);
  weigh_sometimes g now measures;
  if now -. g.reported >= 1. then begin
    g.reported <- now;
    report g phase elapsed measures
  end

(* {1 After a search} *)

let least_time = 1.

let follow_up ?stopped ?(used = fun () -> 8 * (Gc.quick_stat ()).heap_words) ~started limits =
  let began = limits.clock () and first = used () in
  let is_interrupted = stopped = Some Interruption || limits.interrupted () in
  let until most = Float.max (started +. most) (began +. Float.max least_time (most /. 10.)) -. began in
  let limits =
    { limits with
      timeout = if is_interrupted then Some least_time else Option.map until limits.timeout;
      interrupted = if is_interrupted then (fun () -> false) else limits.interrupted;
      max_memory = Option.map (fun most -> max most (first + (most / 8))) limits.max_memory;
      memory_left = if stopped = Some No_memory then (fun () -> None) else limits.memory_left;
      progress = ignore }
  in
  let g = guard ~started:began limits in
  fun () -> look g "" { states = 0; expanded = 0; depth = 0; used = used (); growth = 0 }
