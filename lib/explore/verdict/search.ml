open Dolphin_semantics
open Dolphin_environment

type options = {
  environment : Environment.options;
  reduction : Reduction.t;
  compress : bool;
  search_again : int;
  max_states : int option;
  max_depth : int option;
  max_memory : int option;
  memory_left : unit -> int option;
  timeout : float option;
  clock : unit -> float;
  invariants : Condition.t list;
  formulas : Temporal.t list;
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

let default =
  {
    environment = Environment.default;
    reduction = Whole;
    compress = false;
    search_again = 100_000;
    max_states = None;
    max_depth = None;
    max_memory = None;
    memory_left = (fun () -> None);
    timeout = None;
    clock = Sys.time;
    invariants = [];
    formulas = [];
    interrupted = (fun () -> false);
    progress = ignore;
  }

type run = { steps : Transition.t list; cycle : Transition.t list; shortest : bool }
type bound =
  | States
  | Depth
  | Memory
  | No_memory
  | Time
  | Interruption
  | Broken_condition of string
  | Unsettled of string

type verdict =
  | Holds
  | Violated of run
  | Unreached of Coverage.piece list
  | Inconclusive of bound

type outcome = {
  states : int;
  transitions : int;
  expanded : int;
  depth : int;
  formula_states : int;
  bytes : int;
  seconds : float;
  stopped : bound option;
  reduction : Reduction.t;
  vehicle_symmetry : bool;
  verdicts : (Property.t * verdict) list;
}

(* A search under way. *)
type t = {
  options : options;
  space : Space.t;
  invariants : Invariant.t list;
  phase : string;
  started : float;
  mutable reported : float;
  mutable weighed : float;  (* when memory was looked at *)
  mutable next : int;  (* to be expanded *)
  mutable depth : int;  (* of [next] *)
  mutable level_end : int;  (* the first state that is deeper *)
}

exception Stop of bound

let unsettled program (fault : Fault.t) =
  match Fault.location program fault with
  | Some at -> Unsettled (Format.asprintf "%a: %s" Dolphin_syntax.Location.pp at fault.message)
  | None -> Unsettled fault.message

(* {1 Bounds and progress} *)

let memory t = Space.bytes t.space + (8 * (Gc.quick_stat ()).heap_words)
let exceeds bound n = match bound with Some most -> n > most | None -> false

(* [weigh t growth] is for [growth] bytes more. A system that has given all its memory kills without a word. So a part
   of
   what could be had is left alone: for others, and for what grows between two looks. *)
let weigh t growth =
  if t.options.max_memory <> None && exceeds t.options.max_memory (memory t + growth) then raise (Stop Memory);
  match t.options.memory_left () with
  | Some left when growth > left - ((memory t + left) / 10) -> raise (Stop No_memory)
  | Some _ | None -> ()

(* States that may be added between two looks around, at most, and twice as many are foreseen. *)
let stride = 4_096

(* To ask what is left costs some reads of files. *)
let weigh_sometimes t now =
  let growth = Space.bytes_to_grow t.space ~by:(2 * stride) in
  if t.options.max_memory <> None || growth >= 1 lsl 20 || now -. t.weighed >= 0.1 then begin
    t.weighed <- now;
    weigh t growth
  end

(* Doing this for every state would cost more than the state. *)
let look_around t phase =
  let options = t.options in
  let now = options.clock () in
  let elapsed = now -. t.started in
  if options.interrupted () then raise (Stop Interruption);
  if (match options.timeout with Some most -> elapsed > most | None -> false) then raise (Stop Time);
  weigh_sometimes t now;
  if now -. t.reported >= 1. then begin
    t.reported <- now;
    let states = Space.count t.space in
    options.progress
      {
        phase;
        states;
        rate = float_of_int states /. Float.max elapsed 1e-3;
        frontier = states - t.next;
        depth = t.depth;
        memory = memory t;
        elapsed;
      }
  end

(* To be called at each state. *)
let looking t phase =
  let ticks = ref 0 in
  fun () ->
    incr ticks;
    if !ticks land 0xFF = 0 then look_around t phase

let expand_all enough t =
  let space = t.space in
  let next_look = ref 0 in
  let more () =
    t.next < Space.count space
    || begin
      Space.flush space;
      t.next < Space.count space
    end
  in
  while (not (enough ())) && more () do
    if t.next >= t.level_end then begin
      Space.flush space;
      t.depth <- t.depth + 1;
      t.level_end <- Space.count space;
      if t.options.max_depth = Some t.depth then raise (Stop Depth)
    end;
    if t.next + Space.count space >= !next_look then begin
      next_look := t.next + Space.count space + stride;
      look_around t t.phase
    end;
    List.iter (fun invariant -> Invariant.check invariant space t.next) t.invariants;
    Space.expand space t.next;
    t.next <- t.next + 1;
    if exceeds t.options.max_states (Space.count space) then raise (Stop States)
  done

(* What stopped it, if anything. Once there is no memory nothing can be added, not even what waits. *)
let explore ?(enough = fun () -> false) program t =
  let no_memory () = Space.forget_waiting t.space; Some No_memory in
  let settled stopped = match Space.flush t.space with () -> stopped | exception Out_of_memory -> no_memory () in
  match expand_all enough t with
  | () -> settled None
  | exception Stop bound -> settled (Some bound)
  | exception Environment.Unclear fault -> settled (Some (unsettled program fault))
  | exception Out_of_memory -> no_memory ()

(* {1 Verdicts} *)

let verdicts t program stopped =
  let shortest = not (Reduction.by_order t.options.reduction) in
  let run_to i = { steps = Replay.through t.space (Replay.shortest t.space i); cycle = []; shortest } in
  let unless_stopped otherwise = match stopped with Some bound -> Inconclusive bound | None -> otherwise () in
  let termination () =
    match Cycle.find ~tick:(looking t "looking for cycles") t.space with
    | None -> Holds
    | Some { stem; around } ->
      let steps, cycle = Replay.around t.space ~stem around in
      let is_as_short = List.compare_lengths stem steps > 0 && List.compare_lengths around cycle > 0 in
      Violated { steps; cycle; shortest = shortest && is_as_short }
    | exception Stop bound -> Inconclusive bound
    | exception Out_of_memory -> Inconclusive No_memory
  in
  let invariant i =
    match Invariant.broken i with
    | Some state -> Violated (run_to state)
    | None -> (
        match Invariant.trouble i with
        | Some why -> Inconclusive (Broken_condition why)
        | None -> unless_stopped (fun () -> Holds))
  in
  let verdict property =
    match (property : Property.t) with
    | No_deadlock | No_error | Assertions | Vehicles | No_halt | No_leftover -> (
        match Space.broken t.space property with
        | Some i -> Violated (run_to i)
        | None -> unless_stopped (fun () -> Holds))
    | Termination -> unless_stopped termination
    | All_reached ->
      unless_stopped (fun () ->
          match Coverage.unreached (Space.coverage t.space) program with [] -> Holds | pieces -> Unreached pieces)
    | Invariant _ | Formula _ -> invalid_arg "Search.verdicts"
  in
  let given i = (Property.Invariant (Condition.to_string (Invariant.condition i)), invariant i) in
  List.map (fun property -> (property, verdict property)) Property.all @ List.map given t.invariants

let start ?watch ?(phase = "exploring") (options : options) ~symmetry program world started =
  let reserve = ref ignore in
  let space =
    Space.create ~reduction:options.reduction ~symmetry ~asked:options.invariants ~compress:options.compress
      ~reserve:(fun bytes -> !reserve bytes)
      ?watch
      options.environment program world
  in
  let invariants = List.map (Invariant.create program world) options.invariants in
  let t =
    { options; space; invariants; phase; started; reported = started; weighed = Float.neg_infinity; next = 0;
      depth = -1; level_end = 0 }
  in
  reserve := weigh t;
  t

(* What a reduced search finds broken, the first of all states may show by a shortest run. *)
let with_shortest_runs options ~symmetry program world started verdicts =
  let is_sought = function
    | (Property.Termination | Invariant _ | Formula _), _ | _, (Holds | Unreached _ | Inconclusive _) -> false
    | _, Violated { shortest; _ } -> not shortest
  in
  match List.map fst (List.filter is_sought verdicts) with
  | [] -> verdicts
  | sought ->
    let most = Option.fold ~none:options.search_again ~some:(min options.search_again) options.max_states in
    let options = { options with reduction = Whole; invariants = []; max_states = Some most } in
    let t = start options ~symmetry:(Symmetry.without_tasks symmetry) program world started in
    let is_found property = Space.broken t.space property <> None in
    ignore (explore ~enough:(fun () -> List.for_all is_found sought) program t);
    let shorter (property, verdict) =
      match if List.mem property sought then Space.broken t.space property else None with
      | Some i ->
        let steps = Replay.through t.space (Replay.shortest t.space i) in
        (property, Violated { steps; cycle = []; shortest = true })
      | None -> (property, verdict)
    in
    List.map shorter verdicts

(* {1 Formulas} *)

(* The verdict on a formula: states are explored anew under its watch, until a violation shows. *)
let formula started (options : options) program world f =
  let watch = Product.create program world f in
  let options = { options with reduction = Whole; invariants = [] } in
  let judge t =
    let tick = looking t "checking formulas" in
    match explore ~enough:(fun () -> Space.shown t.space <> None) program t with
    | Some bound when Space.shown t.space = None -> Inconclusive bound
    | None | Some _ -> (
        match Counterexample.find ~tick options.environment program world t.space watch with
        | None -> Holds
        | Some { steps; cycle } -> Violated { steps; cycle; shortest = false }
        | exception Stop bound -> Inconclusive bound
        | exception Out_of_memory -> Inconclusive No_memory)
  in
  match
    let t = start ~watch ~phase:"exploring for formulas" options ~symmetry:Symmetry.none program world started in
    let verdict = judge t in
    (verdict, Space.count t.space, memory t)
  with
  | found -> found
  | exception Valuation.Broken why -> (Inconclusive (Broken_condition why), 0, 0)
  | exception Environment.Unclear fault -> (Inconclusive (unsettled program fault), 0, 0)

(* {1 Outcomes} *)

(* Begun anew with less where a state breaks the symmetry. *)
let rec run_from started (options : options) ~symmetry program world =
  match
    let t = start options ~symmetry program world started in
    outcome t ~symmetry program world (explore program t)
  with
  | outcome -> outcome
  | exception Symmetry.Broken symmetry -> run_from started options ~symmetry program world

and outcome t ~symmetry program world stopped =
  let space = t.space and options = t.options and started = t.started in
  let without_symmetry = Reduction.without_symmetry options.reduction in
  let verdicts = with_shortest_runs options ~symmetry program world started (verdicts t program stopped) in
  let found =
    {
      states = Space.count space;
      transitions = Space.transitions space;
      expanded = t.next;
      depth = t.depth;
      formula_states = 0;
      bytes = memory t;
      seconds = options.clock () -. started;
      stopped;
      reduction = (if Space.used_task_symmetry space then options.reduction else without_symmetry);
      vehicle_symmetry = Space.used_vehicle_symmetry space;
      verdicts;
    }
  in
  with_formulas started options program world found

(* No other states are needed any more: there is to be room for those of the formulas. *)
and with_formulas started (options : options) program world found =
  let add found f =
    Gc.full_major ();
    let verdict, states, bytes = formula started options program world f in
    { found with
      verdicts = found.verdicts @ [ (Property.Formula (Temporal.to_string f), verdict) ];
      formula_states = found.formula_states + states;
      bytes = max found.bytes bytes;
      seconds = options.clock () -. started }
  in
  List.fold_left add found options.formulas

let run (options : options) program world =
  let symmetry =
    if Reduction.by_symmetry options.reduction then
      Symmetry.find options.environment program ~asked:options.invariants world
    else Symmetry.none
  in
  (* What is asked of every state cannot be judged by some of those of a task. *)
  let options, symmetry =
    if options.invariants = [] then (options, symmetry)
    else ({ options with reduction = Whole }, Symmetry.without_tasks symmetry)
  in
  run_from (options.clock ()) options ~symmetry program world

(* {1 Text} *)

let reductions o = Reduction.names o.reduction @ if o.vehicle_symmetry then [ "symmetry of vehicles" ] else []

let pp_bound ppf bound =
  Format.pp_print_string ppf
    (match bound with
     | States -> "the bound on states was met"
     | Depth -> "the bound on depth was met"
     | Memory -> "the bound on memory was met"
     | No_memory -> "the machine has no more memory for it"
     | Time -> "the time was up"
     | Interruption -> "it was interrupted"
     | Broken_condition why -> "the condition cannot be told: " ^ why
     | Unsettled why -> why)

let pp_verdict (program : Core.program) ppf (property, verdict) =
  let print format = Format.fprintf ppf format in
  let steps n = if n = 1 then "1 step" else Printf.sprintf "%d steps" n in
  print "%a: " Property.pp property;
  match verdict with
  | Holds -> print "holds"
  | Violated { steps = run; cycle = [] } when property = Assertions -> (
      print "violated after %s: " (steps (List.length run));
      match (List.nth run (List.length run - 1)).next.control with
      | Ended (Failed fault) ->
        Option.iter (print "%a: " Dolphin_syntax.Location.pp) (Fault.location program fault);
        print "%s" fault.message
      | Ended (Completed | Halted _ | Interrupted) | Script _ | Waiting _ | Executing _ ->
        print "%s" (Property.question property))
  | Violated { steps = run; cycle = [] } ->
    print "violated after %s: %s" (steps (List.length run)) (Property.question property)
  | Violated { steps = run; cycle } ->
    print "violated: after %s, %s that can repeat for ever" (steps (List.length run)) (steps (List.length cycle))
  | Unreached pieces ->
    let piece ppf (p : Coverage.piece) =
      match Fault.location program (Fault.make p.site "") with
      | Some at -> Format.fprintf ppf "%s at %a" p.what Dolphin_syntax.Location.pp at
      | None -> Format.pp_print_string ppf p.what
    in
    print "violated: no run reaches %a" (Fmt.list ~sep:(Fmt.any ", ") piece) pieces
  | Inconclusive bound -> print "inconclusive, %a" pp_bound bound
