open Dolphin_semantics
open Dolphin_environment
open Dolphin_explore
module Parts = Dolphin_conformance.Parts
module Nodes = Dolphin_conformance.Nodes
module Limits = Dolphin_checker.Limits
module Field = Dolphin_json.Field

type settings = {
  answers : string list;
  faults : Faults.t;
  reduction : Reduction.t;
  invariants : string list;
}

type t = {
  program : Program_file.t;
  world : World.t;
  options : Search.options;
  space : Space.t;
  portable : Space.portable;
  greeting : string;
}

type successor = { text : string; is_end : bool; broken : Property.t option }
type expansion = { transitions : int; targets : int list; deadlock : bool; invariants : bool list }

type batch = {
  successors : successor list;
  expansions : expansion list;
  places : (string * string) list;
  goes_round : bool;
  unreached : string list;
  trouble : string option;
}

let ( let* ) = Result.bind
let bad why = Error (Error.Bad_input why)

(* {1 Parts as texts} *)

let wrong why = raise (Portable.Wrong why)

let part (p : _ Parts.t) : _ Portable.part =
  { write = p.write; read = (fun text -> match p.read text with Ok x -> x | Error why -> wrong why) }

let of_memory e =
  let { Environment.failed; losses; lost; late; asked; called; sent } = Environment.memory e in
  let times name counted = `List (List.map (fun (x, n) -> `List [ name x; `Int n ]) counted) in
  let named name = `String name in
  Yojson.Safe.to_string
    (`List
       [ `Int failed; `Int losses; Field.texts lost; Field.texts late; times named asked; times named called;
         times (fun i -> `Int i) sent ])

let memory text =
  let amiss () = wrong "what the environment remembers is not written as dolphin writes it" in
  let list read = function `List items -> List.map read items | _ -> amiss () in
  let name = function `String name -> name | _ -> amiss () and whole = function `Int n -> n | _ -> amiss () in
  let times key = list (function `List [ x; `Int n ] -> (key x, n) | _ -> amiss ()) in
  match Yojson.Safe.from_string text with
  | `List [ failed; losses; lost; late; asked; called; sent ] ->
    Environment.of_memory
      { failed = whole failed; losses = whole losses; lost = list name lost; late = list name late;
        asked = times name asked; called = times name called; sent = times whole sent }
  | _ -> amiss ()
  | exception Yojson.Json_error _ -> amiss ()

(* What the environment remembers, on a line of its own, and [p]. *)
let with_memory (p : _ Portable.part) : _ Portable.part =
  let write (x, e) = of_memory e ^ "\n" ^ p.write x in
  let read text =
    match String.index_opt text '\n' with
    | None -> wrong "what the environment remembers is missing"
    | Some i ->
      let e = memory (String.sub text 0 i) in
      (p.read (String.sub text (i + 1) (String.length text - i - 1)), e)
  in
  { write; read }

let codec program : Portable.codec =
  let nodes = Nodes.of_program program in
  { machine = part (Parts.machine nodes); residual = part (Parts.residual nodes);
    shared = with_memory (part (Parts.shared nodes program));
    configuration = with_memory (part (Parts.configuration nodes program)) }

(* {1 Beginning} *)

let protocol = 1

let greeting_of ~version (settings : settings) program fleet =
  let options =
    [ ("answers", Field.texts settings.answers);
      ("faults", `String (Fmt.str "%a" Faults.pp settings.faults));
      ("reduction", `String (if Reduction.by_order settings.reduction then "por" else "none"));
      ("invariants", Field.texts settings.invariants) ]
  in
  Yojson.Safe.to_string
    (`Assoc
       ([ ("dolphin", `String "successors"); ("protocol", `Int protocol) ]
        @ Provenance.members ~version program fleet
        @ [ ("options", `Assoc options) ]))

let make ~greeting options (program : Program_file.t) world =
  let options = Search.without_symmetry options program.program in
  let space = Search.space options program.program world in
  let _ : int array -> int array -> unit = Space.widen space ~reserved:0 in
  { program; world; options; space; portable = Space.portable (codec program.program) space; greeting }

let create ~version (settings : settings) (program : Program_file.t) (fleet : Fleet_file.t) =
  let core = program.program in
  let* invariants = Exploration.invariants core settings.invariants in
  let environment =
    Scenario_world.environment ~answers:settings.answers ~faults:settings.faults core fleet.scenario in
  let options = { Search.default with environment; reduction = settings.reduction; invariants } in
  let greeting = greeting_of ~version settings program fleet in
  Ok (make ~greeting options program (Scenario_world.world fleet.scenario))

let greeting t = t.greeting
let before = ""

(* {1 States} *)

(* Fields grow as things are met. *)
let rec widened ?(forget = ignore) t f =
  match f () with
  | x -> x
  | exception Space.Outgrown ->
    let _ : int array -> int array -> unit = Space.widen t.space ~reserved:0 in
    forget ();
    widened ~forget t f

module Keys = Hashtbl.Make (struct
    type t = int array

    let equal (a : int array) b = a = b
    let hash key = Array.fold_left (fun h word -> ((h * 65599) + word) lxor (h lsr 23)) 17 key land max_int
  end)

(* A batch that is being answered. Most states are reached several times, and written once. *)
type answer = {
  keys : int Keys.t;
  numbers : (string, int) Hashtbl.t;
  mutable reached : successor list;  (* latest first *)
  follows : (string * string, unit) Hashtbl.t;
  mutable in_order : (string * string) list;
  mutable trouble : string option;
}

let number t answer key =
  let text = Space.to_string t.portable key in
  match Hashtbl.find_opt answer.numbers text with
  | Some i -> i
  | None ->
    let i = Hashtbl.length answer.numbers in
    Hashtbl.add answer.numbers text i;
    answer.reached <-
      { text; is_end = Space.is_end t.space key.(0); broken = Space.broken t.space key.(0) } :: answer.reached;
    i

let follows answer place place' =
  if not (Hashtbl.mem answer.follows (place, place')) then begin
    Hashtbl.add answer.follows (place, place') ();
    answer.in_order <- (place, place') :: answer.in_order
  end

let visit t answer key =
  match Keys.find_opt answer.keys key with
  | Some i -> i
  | None ->
    let i = number t answer key in
    Keys.add answer.keys (Array.copy key) i;
    i

let judged t answer c =
  let breaks condition =
    match Condition.eval t.program.program t.world condition c with
    | Condition.Holds | Not_yet -> false
    | Fails -> true
    | Broken why ->
      if answer.trouble = None then answer.trouble <- Some why;
      false
  in
  List.map breaks t.options.invariants

let nothing_follows t answer c = { transitions = 0; targets = []; deadlock = false; invariants = judged t answer c }

let initial t answer =
  let targets = ref [] in
  let visit key _ _ = targets := visit t answer key :: !targets in
  Space.initial t.space { visit; tick = ignore; rest = ignore };
  { transitions = 1; targets = !targets; deadlock = false; invariants = List.map (fun _ -> false) t.options.invariants }

(* The state [key]; what its expansion visits is noted once it is whole. *)
let state t answer key =
  let invariants = if t.options.invariants = [] then [] else judged t answer (fst (Space.state t.space key)) in
  let executes = Space.executes t.space key.(0) and targets = ref [] and deadlock = ref false in
  let place = lazy (Space.place t.portable (Array.copy key)) in
  if not executes then ignore (Lazy.force place);
  let visit key' _ _ =
    if not (executes && Space.executes t.space key'.(0)) then
      follows answer (Lazy.force place) (Space.place t.portable key');
    targets := visit t answer key' :: !targets
  in
  let rest () = if not (Space.is_end t.space key.(0)) then deadlock := true in
  let transitions = Space.expand t.space key { visit; tick = ignore; rest } in
  { transitions; targets = List.rev !targets; deadlock = !deadlock; invariants }

let expand_state t answer text =
  widened t ~forget:(fun () -> Keys.reset answer.keys) (fun () ->
      if String.equal text before then initial t answer
      else
        match Space.of_string t.portable text with
        | State key -> state t answer key
        | End (c, _) -> nothing_follows t answer c)

let at_piece t (piece : Coverage.piece) =
  let place = Option.value (Program_file.at t.program piece.site) ~default:"?" in
  Printf.sprintf "%s: %s" place piece.what

(* What may go wrong with a text that is no state, and with one that is. *)
let guarded ~named f =
  match f () with
  | x -> Ok x
  | exception Portable.Wrong why -> bad (Printf.sprintf "%s is no state of this program: %s" (named ()) why)
  | exception (Invalid_argument _ | Not_found | Failure _) ->
    bad (Printf.sprintf "%s is no state of this program: its parts do not belong together" (named ()))
  | exception Parts.Too_large -> Error (Error.Inconclusive "a state is too large to be written down")
  | exception Limits.Stop bound -> Error (Error.Inconclusive (Fmt.str "%a" Limits.pp_bound bound))

let expand t states =
  let answer =
    { keys = Keys.create 256; numbers = Hashtbl.create 256; reached = []; follows = Hashtbl.create 8; in_order = [];
      trouble = None }
  in
  let rec each i expansions = function
    | [] -> Ok (List.rev expansions)
    | text :: rest ->
      let named () = Printf.sprintf "state %d of the batch" (i + 1) in
      let* expansion = guarded ~named (fun () -> expand_state t answer text) in
      each (i + 1) (expansion :: expansions) rest
  in
  let* expansions = each 0 [] states in
  Ok
    { successors = List.rev answer.reached; expansions; places = List.rev answer.in_order;
      goes_round = Space.goes_round t.space;
      unreached = List.map (at_piece t) (Coverage.unreached (Space.coverage t.space) t.program.program);
      trouble = answer.trouble }

(* {1 Runs} *)

let configuration t text =
  widened t (fun () ->
      match Space.of_string t.portable text with
      | State key -> Space.state t.space key
      | End (c, outside) -> (c, outside))

let run t states =
  let follow i (c, outside) text =
    let named () = Printf.sprintf "state %d of the run" (i + 1) in
    let* next = guarded ~named (fun () -> configuration t text) in
    let leads ((t : Transition.t), e) = Configuration.equal t.next (fst next) && Environment.compare e (snd next) = 0 in
    let* choice =
      guarded ~named (fun () ->
          Environment.find leads (Environment.choices t.options.environment t.program.program t.world outside c)) in
    match choice with
    | Some (transition, e) -> Ok (transition, (transition.next, e))
    | None -> bad (Printf.sprintf "no transition leads to %s" (named ()))
  in
  let rec go i state found = function
    | [] -> Ok (List.rev found)
    | text :: rest ->
      let* transition, state = follow i state text in
      go (i + 1) state (transition :: found) rest
  in
  go 0 (Configuration.initial t.program.program, Environment.initial) [] states

(* {1 On channels} *)

let most_states = 1_000_000
let longest = 64 * 1024 * 1024

exception Refused of string

let refuse why = raise (Refused why)

let read_number ?first input =
  let buffer = Bytes.create 4 in
  (match first with
   | Some c ->
     Bytes.set buffer 0 c;
     really_input input buffer 1 3
   | None -> really_input input buffer 0 4);
  Int32.to_int (Bytes.get_int32_le buffer 0) land 0xFFFFFFFF

let read_state input =
  let length = read_number input in
  if length > longest then refuse (Printf.sprintf "a state of %d bytes is longer than any" length);
  really_input_string input length

(* [None] at the end of the input. *)
let read_batch input =
  match input_char input with
  | exception End_of_file -> None
  | first -> (
      match
        let count = read_number ~first input in
        if count > most_states then refuse (Printf.sprintf "a batch of %d states is larger than any" count);
        let rec states n found = if n = 0 then List.rev found else states (n - 1) (read_state input :: found) in
        states count []
      with
      | states -> Some states
      | exception End_of_file -> refuse "the input ends within a batch")

let shortened text = if String.length text <= 300 then text else String.sub text 0 300 ^ "..."

(* Whether anything follows. *)
let read_greeting t input =
  match input_line input with
  | exception End_of_file -> false
  | line when String.equal line t.greeting -> true
  | line ->
    refuse
      (Printf.sprintf "the states are not of this program, fleet, version and options: the input begins with %s, this \
                       is %s" (shortened line) t.greeting)

let add_number buffer n = Buffer.add_int32_le buffer (Int32.of_int n)

let add_text buffer text =
  add_number buffer (String.length text);
  Buffer.add_string buffer text

let number_of_property : Property.t option -> int = function
  | None -> 0
  | Some No_error -> 1
  | Some Assertions -> 2
  | Some Vehicles -> 3
  | Some No_halt -> 4
  | Some No_leftover -> 5
  | Some (No_deadlock | Termination | All_reached | Invariant _ | Formula _ | Apart _) -> 0

let add_all buffer add items =
  add_number buffer (List.length items);
  List.iter add items

let write_batch buffer b =
  Buffer.add_char buffer '\000';
  let successor s =
    Buffer.add_uint8 buffer (number_of_property s.broken + if s.is_end then 128 else 0);
    add_text buffer s.text
  in
  add_all buffer successor b.successors;
  let expansion e =
    Buffer.add_uint8 buffer (Bool.to_int e.deadlock);
    add_number buffer e.transitions;
    List.iter (fun is_broken -> Buffer.add_uint8 buffer (Bool.to_int is_broken)) e.invariants;
    add_all buffer (add_number buffer) e.targets
  in
  add_all buffer expansion b.expansions;
  add_all buffer (fun (place, place') -> Buffer.add_string buffer place; Buffer.add_string buffer place') b.places;
  Buffer.add_uint8 buffer (Bool.to_int b.goes_round);
  add_text buffer (String.concat "\n" b.unreached);
  add_text buffer (Option.value b.trouble ~default:"")

(* What a batch cannot be answered for, in its place. *)
let write_inconclusive buffer why =
  Buffer.add_char buffer '\001';
  add_text buffer why

let refused f = match f () with x -> x | exception Refused why -> bad why

let serve t input output =
  let buffer = Buffer.create 65536 in
  let rec batches () =
    match read_batch input with
    | None -> Ok ()
    | Some states -> (
        Buffer.clear buffer;
        match expand t states with
        | Error (Error.Inconclusive why) -> write_inconclusive buffer why; reply ()
        | Error e -> Error e
        | Ok batch -> write_batch buffer batch; reply ())
  and reply () =
    Buffer.output_buffer output buffer;
    flush output;
    batches ()
  in
  output_string output (t.greeting ^ "\n");
  flush output;
  refused (fun () -> if read_greeting t input then batches () else Ok ())

let read_run t input =
  refused @@ fun () ->
  if not (read_greeting t input) then bad "the input is empty: there is no run in it"
  else
    match read_batch input with
    | Some states -> run t states
    | None -> bad "the input has no batch of states: there is no run in it"

let print_run t input =
  let* steps = read_run t input in
  Ok (Run_columns.print t.program ~steps ~cycle:[])
