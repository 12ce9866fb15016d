type step = { action : string option; state : string }
type repetition = Once | Stays | Back_to of int
type counter_example = { violation : Tlc_message.violation; steps : step list; repetition : repetition }
type verdict = Holds | Violated of counter_example | Unfinished | Gave_up of string | Failed of string list

type t = {
  version : string option;
  generated : int;
  distinct : int;
  queue : int;
  depth : int option;
  verdict : verdict;
}

(* Lists have the last first. *)
type reader = {
  so_far : t;
  violation : Tlc_message.violation option;
  states : (int * step) list;
  repetition : repetition;
  assertion : string option;
  troubles : string list;
  printed : string list;
  holds : bool;
}

let start =
  { so_far =
      { version = None; generated = 0; distinct = 0; queue = 0; depth = None; verdict = Unfinished };
    violation = None;
    states = [];
    repetition = Once;
    assertion = None;
    troubles = [];
    printed = [];
    holds = false }

(* Lines outside of messages matter only if the output has no messages at all, and then only the last few. *)
let most_printed = 20

let keep line printed =
  let rec first n = function x :: rest when n > 0 -> x :: first (n - 1) rest | _ -> [] in
  line :: first (most_printed - 1) printed

let event r (e : Tlc_message.t) =
  let update so_far = { r with so_far } and so_far = r.so_far in
  match e with
  | Version text -> update { so_far with version = Some text }
  | Initial_states n -> update { so_far with generated = n; distinct = n; queue = n }
  | Progress { generated; distinct; queue; _ } | Totals { generated; distinct; queue } ->
    update { so_far with generated; distinct; queue }
  | Depth n -> update { so_far with depth = Some (n - 1) }
  | Violation v when r.violation = None -> { r with violation = Some v }
  | Behaviour when r.violation = None && r.assertion = None && r.troubles = [] -> { r with violation = Some Unnamed }
  | State { number; action; text } when r.violation <> None ->
    { r with states = (number, { action; state = text }) :: r.states }
  | Stutters -> { r with repetition = Stays }
  | Returns_to n -> { r with repetition = Back_to (n - 1) }
  | Holds -> { r with holds = true }
  | Printed line -> { r with printed = keep line r.printed }
  | Assertion why -> { r with assertion = Some why }
  | Trouble text -> { r with troubles = text :: r.troubles }
  | Violation _ | Behaviour | State _ | Begins _ | Checks_temporal _ | Worker _ | Warning _ | Other -> r

(* The first state is the initial one: no step leads there. *)
let steps r = List.filter_map (fun (number, step) -> if number > 1 then Some step else None) (List.rev r.states)

let verdict r =
  match r.violation, r.assertion with
  | Some violation, _ -> Violated { violation; steps = steps r; repetition = r.repetition }
  | None, Some why -> Gave_up why
  | None, None ->
    if r.troubles <> [] then Failed (List.rev r.troubles)
    else if r.holds then Holds
    else if r.so_far.version = None && r.printed <> [] then Failed (List.rev r.printed)
    else Unfinished

let finish r = { r.so_far with verdict = verdict r }

(* Class files give their version of Java by a number that is 44 higher. *)
let java_too_old lines =
  let version prefix line = Option.map (fun n -> n - 44) (Tlc_message.number_after prefix line) in
  let told line =
    match version "class file version " line, version "class file versions up to " line with
    | Some needed, Some found -> Some (needed, found)
    | None, _ | _, None -> None
  in
  List.find_map told lines
