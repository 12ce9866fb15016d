open Dolphin_semantics
open Dolphin_environment
open Dolphin_explore
module Parts = Dolphin_conformance.Parts
module Nodes = Dolphin_conformance.Nodes
module Limits = Dolphin_checker.Limits
module States = Dolphin_checker.States
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
  mutable reached : States.t;  (* by the batch that is being answered *)
}

type source = { text : string; is_end : bool }

type breach = Breaks of Property.t | Makes_false of int

type batch = {
  transitions : int;
  blocks : State_columns.t array;
  targets : int list array;
  broken : (breach * string) list;
  parts : string list;
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
  let { Environment.failed; losses; spent = _; lost; late; asked; called; sent } = Environment.memory e in
  let times name counted = `List (List.map (fun (x, n) -> `List [ name x; `Int n ]) counted) in
  let named name = `String name in
  Dolphin_json.Canonical.to_string
    (`List
       [ `Int failed; `Int losses; Field.texts lost; Field.texts late; times named asked; times named called;
         times (fun i -> `Int i) sent ])

let memory text =
  let amiss () = wrong "the environment's memory is not written as dolphin writes it" in
  let list read = function `List items -> List.map read items | _ -> amiss () in
  let name = function `String name -> name | _ -> amiss () and whole = function `Int n -> n | _ -> amiss () in
  let times key = list (function `List [ x; `Int n ] -> (key x, n) | _ -> amiss ()) in
  match Yojson.Safe.from_string text with
  | `List [ failed; losses; lost; late; asked; called; sent ] ->
    Environment.of_memory
      { failed = whole failed; losses = whole losses; spent = 0; lost = list name lost; late = list name late;
        asked = times name asked; called = times name called; sent = times whole sent }
  | _ -> amiss ()
  | exception Yojson.Json_error _ -> amiss ()

(* The memory of the environment, on a line of its own, and [p]. *)
let with_memory (p : _ Portable.part) : _ Portable.part =
  let write (x, e) = of_memory e ^ "\n" ^ p.write x in
  let read text =
    match String.index_opt text '\n' with
    | None -> wrong "the environment's memory is missing"
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

let protocol = 3

let greeting_of ~version (settings : settings) program fleet =
  let options =
    [ ("answers", Field.texts settings.answers);
      ("faults", `String (Fmt.str "%a" Faults.pp settings.faults));
      ("reduction", `String (if Reduction.by_order settings.reduction then "por" else "none"));
      ("invariants", Field.texts settings.invariants) ]
  in
  Dolphin_json.Canonical.to_string
    (`Assoc
       ([ ("dolphin", `String "successors"); ("protocol", `Int protocol) ]
        @ Provenance.members ~version program fleet
        @ [ ("options", `Assoc options) ]))

let nothing_reached space = States.create ~compress:false ~words:(Space.words space)

let make ~greeting options (program : Program_file.t) world =
  let options = Search.without_symmetry options program.program in
  let space = Search.space options program.program world in
  let _ : int array -> int array -> unit = Space.widen space ~reserved:0 in
  { program; world; options; space; portable = Space.portable (codec program.program) space; greeting;
    reached = nothing_reached space }

let create ~version (settings : settings) (program : Program_file.t) (fleet : Fleet_file.t) =
  let core = program.program in
  let* invariants = Exploration.invariants core settings.invariants in
  let environment =
    Scenario_world.environment ~answers:settings.answers ~faults:settings.faults core fleet.scenario in
  let options = { Search.default with environment; reduction = settings.reduction; invariants } in
  let greeting = greeting_of ~version settings program fleet in
  Ok (make ~greeting options program (Scenario_world.world fleet.scenario))

let greeting t = t.greeting
let before = { text = ""; is_end = false }

(* {1 What states are called} *)

let end_bit = 128

let number_of_property : Property.t option -> int = function
  | None -> 0
  | Some No_error -> 1
  | Some Assertions -> 2
  | Some Vehicles -> 3
  | Some Allocation -> 4
  | Some No_halt -> 5
  | Some No_leftover -> 6
  | Some (No_deadlock | Termination | All_reached | Invariant _ | Formula _ | Apart _) -> 0

let kind ~is_end broken = number_of_property broken + if is_end then end_bit else 0
let is_end kind = kind land end_bit <> 0
let partition ~partitions digest = (Int32.to_int (String.get_int32_le digest 12) land 0xFFFFFFFF) mod partitions

(* {1 States} *)

let no_one _ _ = ()

(* Fields grow as things are met. *)
let rec widened t f =
  match f () with
  | x -> x
  | exception Space.Outgrown ->
    States.flush t.reached ~fresh:no_one;
    let renewed = Space.widen t.space ~reserved:0 in
    t.reached <- States.rewrite t.reached ~words:(Space.words t.space) renewed;
    widened t f

(* A batch that is being answered. *)
type answer = {
  parents : Bytes.t;  (* by place in the batch: the first 8 bytes of the state's digest *)
  until : int array;  (* how many states were reached once it was expanded *)
  mutable transitions : int;
  mutable broken : (breach * string) list;
  follows : (string * string, unit) Hashtbl.t;
  mutable in_order : (string * string) list;
  mutable trouble : string option;
}

let note answer digest breach =
  match List.assoc_opt breach answer.broken with
  | Some known when String.compare known digest <= 0 -> ()
  | Some _ | None -> answer.broken <- (breach, digest) :: List.remove_assoc breach answer.broken

let follows answer place place' =
  if not (Hashtbl.mem answer.follows (place, place')) then begin
    Hashtbl.add answer.follows (place, place') ();
    answer.in_order <- (place, place') :: answer.in_order
  end

let judge t answer digest c =
  let judge i condition =
    match Condition.eval t.program.program t.world condition c with
    | Condition.Holds | Not_yet -> ()
    | Fails -> note answer digest (Makes_false i)
    | Broken why -> if answer.trouble = None then answer.trouble <- Some why
  in
  List.iteri judge t.options.invariants

(* An expansion calls [visited] with each state that is reached. *)
let visit t visited key =
  States.push t.reached key ~parent:0 ~fresh:no_one;
  visited key

let initial t visited =
  let visit key _ _ = visit t visited key in
  Space.initial t.space { visit; tick = ignore; rest = ignore };
  1

let state t answer digest key visited =
  if t.options.invariants <> [] then judge t answer digest (fst (Space.state t.space key));
  let executes = Space.executes t.space key.(0) in
  let place = lazy (Space.place t.portable (Array.copy key)) in
  if not executes then ignore (Lazy.force place);
  let visit key' _ _ =
    if not (executes && Space.executes t.space key'.(0)) then
      follows answer (Lazy.force place) (Space.place t.portable key');
    visit t visited key'
  in
  let rest () = if not (Space.is_end t.space key.(0)) then note answer digest (Breaks Property.No_deadlock) in
  Space.expand t.space key { visit; tick = ignore; rest }

(* The numbers of the successors, if [wanted]. *)
let expand_state t answer ~wanted { text; is_end } digest =
  let expanded () =
    let keys = ref [] in
    let visited key = if wanted then keys := Array.copy key :: !keys in
    let taken =
      if String.equal text before.text then initial t visited
      else
        match Space.of_string t.portable text with
        | State key -> state t answer digest key visited
        | End (c, _) -> judge t answer digest c; 0
    in
    answer.transitions <- answer.transitions + taken;
    !keys
  in
  let keys = if is_end && t.options.invariants = [] then [] else widened t expanded in
  States.flush t.reached ~fresh:no_one;
  List.rev_map (States.find t.reached) keys

let expand_source t answer ~wanted i source =
  let digest = Digest.string source.text in
  Bytes.blit_string digest 0 answer.parents (8 * i) 8;
  let numbers = expand_state t answer ~wanted source digest in
  answer.until.(i) <- States.count t.reached;
  numbers

(* The states that were reached, by partition; and by number, the place of each in the blocks, one after the other. *)
let columns t answer partitions =
  let blocks = Array.init partitions (fun _ -> State_columns.create ()) in
  let count = States.count t.reached and key = Array.make (Space.words t.space) 0 in
  let partition_of = Array.make count 0 and within = Array.make count 0 and source = ref 0 in
  for i = 0 to count - 1 do
    while answer.until.(!source) <= i do incr source done;
    States.load t.reached i key;
    let text = Space.to_string t.portable key in
    let digest = Digest.string text and broken = Space.broken t.space key.(0) in
    Option.iter (fun property -> note answer digest (Breaks property)) broken;
    let partition = partition ~partitions digest in
    partition_of.(i) <- partition;
    within.(i) <- State_columns.count blocks.(partition);
    let parent = Bytes.sub_string answer.parents (8 * !source) 8 in
    State_columns.add blocks.(partition)
      { digest; parent; kind = kind ~is_end:(Space.is_end t.space key.(0)) broken; text }
  done;
  let first = Array.make partitions 0 in
  for p = 1 to partitions - 1 do first.(p) <- first.(p - 1) + State_columns.count blocks.(p - 1) done;
  (blocks, fun i -> first.(partition_of.(i)) + within.(i))

let at_piece t (piece : Coverage.piece) =
  let place = Option.value (Program_file.at t.program piece.site) ~default:"?" in
  Printf.sprintf "%s: %s" place piece.what

(* The possible errors of a text that is not a state, and of one that is. *)
let guarded ~named f =
  match f () with
  | x -> Ok x
  | exception Portable.Wrong why -> bad (Printf.sprintf "%s is not a state of this program: %s" (named ()) why)
  | exception (Invalid_argument _ | Not_found | Failure _) ->
    bad (Printf.sprintf "%s is not a state of this program: its parts do not belong together" (named ()))
  | exception Parts.Too_large -> Error (Error.Inconclusive "a state is too large to be written down")
  | exception Portable.Ambiguous -> Error (Error.Inconclusive "two parts of states have the same digest")
  | exception Limits.Stop bound -> Error (Error.Inconclusive (Fmt.str "%a" Limits.pp_bound bound))

let give t parts = guarded ~named:(fun () -> "a part") (fun () -> List.iter (Space.give t.portable) parts)

let expand ?(partitions = 1) ?(targets = false) t states =
  t.reached <- nothing_reached t.space;
  let answer =
    let count = List.length states in
    { parents = Bytes.create (8 * count); until = Array.make count 0; transitions = 0; broken = [];
      follows = Hashtbl.create 8; in_order = []; trouble = None }
  in
  let rec each i numbers = function
    | [] -> Ok (List.rev numbers)
    | source :: rest ->
      let named () = Printf.sprintf "state %d of the batch" (i + 1) in
      let* targets = guarded ~named (fun () -> expand_source t answer ~wanted:targets i source) in
      each (i + 1) (targets :: numbers) rest
  in
  let* numbers = each 0 [] states in
  let* blocks, place = guarded ~named:(fun () -> "what follows") (fun () -> columns t answer partitions) in
  Ok
    { transitions = answer.transitions; blocks;
      targets = (if targets then Array.of_list (List.map (List.map place) numbers) else [||]);
      broken = answer.broken; parts = Space.news t.portable; places = List.rev answer.in_order;
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
let most_partitions = 1_000_000
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

let read_text input =
  let length = read_number input in
  if length > longest then refuse (Printf.sprintf "a text of %d bytes is longer than any" length);
  really_input_string input length

let read_count input what most =
  let count = read_number input in
  if count > most then refuse (Printf.sprintf "a batch of %d %s is larger than any" count what);
  count

let rec times n read found = if n = 0 then List.rev found else times (n - 1) read (read () :: found)

type asked = { partitions : int; targets : bool; parts : string list; states : source list }

let read_states input =
  let count = read_count input "states" most_states in
  let lengths = really_input_string input (4 * count) in
  let kinds = really_input_string input count in
  let i = ref (-1) in
  let state () =
    incr i;
    let length = Int32.to_int (String.get_int32_le lengths (4 * !i)) land 0xFFFFFFFF in
    if length > longest then refuse (Printf.sprintf "a state of %d bytes is longer than any" length);
    { text = really_input_string input length; is_end = is_end (Char.code kinds.[!i]) }
  in
  times count state []

(* [None] at the end of the input. *)
let read_batch input =
  match input_char input with
  | exception End_of_file -> None
  | first -> (
      match
        let partitions = read_number ~first input in
        if partitions < 1 || partitions > most_partitions then
          refuse (Printf.sprintf "a batch for %d partitions: there are 1 to %d" partitions most_partitions);
        let targets = input_char input <> '\000' in
        let parts = times (read_count input "parts" most_states) (fun () -> read_text input) [] in
        { partitions; targets; parts; states = read_states input }
      with
      | asked -> Some asked
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

let add_all buffer add items =
  add_number buffer (List.length items);
  List.iter add items

(* As kinds number them; deadlocks and invariants, which have no kind, come after these. *)
let number_of_breach = function
  | Breaks No_deadlock -> 7
  | Breaks property -> number_of_property (Some property)
  | Makes_false i -> 8 + i

let add_batch buffer (b : batch) =
  Buffer.add_char buffer '\000';
  Buffer.add_int64_le buffer (Int64.of_int b.transitions);
  Buffer.add_uint8 buffer (Bool.to_int b.goes_round);
  let broken (breach, digest) = add_number buffer (number_of_breach breach); Buffer.add_string buffer digest in
  add_all buffer broken b.broken;
  add_all buffer (fun (place, place') -> Buffer.add_string buffer place; Buffer.add_string buffer place') b.places;
  add_text buffer (String.concat "\n" b.unreached);
  add_text buffer (Option.value b.trouble ~default:"");
  add_all buffer (add_text buffer) b.parts

let write_targets output targets =
  let buffer = Buffer.create 65536 in
  Array.iter (fun places -> add_number buffer (List.length places)) targets;
  Array.iter (List.iter (add_number buffer)) targets;
  Buffer.output_buffer output buffer

let write_batch output b =
  let buffer = Buffer.create 65536 in
  add_batch buffer b;
  Buffer.output_buffer output buffer;
  Array.iter (State_columns.write output) b.blocks;
  write_targets output b.targets

(* The reason why a batch has no answer, in its place. *)
let write_inconclusive output why =
  let buffer = Buffer.create 256 in
  Buffer.add_char buffer '\001';
  add_text buffer why;
  Buffer.output_buffer output buffer

let refused f = match f () with x -> x | exception Refused why -> bad why

let answered t { partitions; targets; parts; states } =
  let* () = give t parts in
  expand t ~partitions ~targets states

let serve t input output =
  let rec batches () =
    match read_batch input with
    | None -> Ok ()
    | Some asked -> (
        match answered t asked with
        | Error (Error.Inconclusive why) -> write_inconclusive output why; next ()
        | Error e -> Error e
        | Ok batch -> write_batch output batch; next ())
  and next () =
    flush output;
    batches ()
  in
  output_string output (t.greeting ^ "\n");
  flush output;
  refused (fun () -> if read_greeting t input then batches () else Ok ())

let read_run t input =
  refused @@ fun () ->
  if not (read_greeting t input) then bad "the input is empty: it has no run"
  else
    match read_batch input with
    | Some { parts; states; _ } ->
      let* () = give t parts in
      run t (List.map (fun s -> s.text) states)
    | None -> bad "the input has no batch of states, so no run"

let print_run t input =
  let* steps = read_run t input in
  Ok (Run_columns.print t.program ~steps ~cycle:[])
