type t = {
  max_states : int option;
  max_depth : int option;
  max_memory : int option;
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
    memory_left = (fun () -> None);
    timeout = None;
    clock = Sys.time;
    interrupted = (fun () -> false);
    progress = ignore;
  }

type bound = States | Depth | Memory | No_memory | Time | Interruption | Sampled | Unsettled of string

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
     | Unsettled why -> why)

let exceeds bound n = match bound with Some most -> n > most | None -> false

type guard = {
  limits : t;
  started : float;
  mutable reported : float;
  mutable weighed : float;  (* when memory was looked at *)
}

let guard ?started limits =
  let started = match started with Some started -> started | None -> limits.clock () in
  { limits; started; reported = started; weighed = Float.neg_infinity }

type measures = { states : int; expanded : int; depth : int; used : int; growth : int }

(* A system that has given all its memory kills without a word. So a part of what could be had is left alone: for
   others, and for what grows between two looks. *)
let weigh_own g ~used growth = if exceeds g.limits.max_memory (used + growth) then raise (Stop Memory)

let weigh g ~used growth =
  weigh_own g ~used growth;
  match g.limits.memory_left () with
  | Some left when growth > left - ((used + left) / 10) -> raise (Stop No_memory)
  | Some _ | None -> ()

(* To ask what is left costs some reads of files. *)
let weigh_sometimes g now { used; growth; _ } =
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
