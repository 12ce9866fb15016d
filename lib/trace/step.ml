open Dolphin_semantics
open Dolphin_json.Codec
module Location = Dolphin_syntax.Location
module String_set = Set.Make (String)

type place = { file : string option; line : int; column : int }

type t = {
  rules : string list;
  label : string;
  at : place option;
  choice : int;
  allocated : (string * string option) list;
  bound : string list;
  released : string list;
  posted : string list;
  consumed : string list;
  requests : Request.t list;
}

(* {1 From transitions} *)

let site_of_control : Configuration.control -> Core.site option = function
  | Script m | Waiting (m, _) | Executing (m, _) -> Some (Machine.site m)
  | Ended (Failed fault) when fault.site <> Fault.unknown_site -> Some fault.site
  | Ended (Completed | Halted _ | Failed _ | Interrupted) -> None

(* The place of a task is that where it is made; of other steps of an executing task, that of its execution. *)
let site (before : Configuration.t) (t : Transition.t) =
  let of_task v (c : Configuration.t) =
    Option.map (fun (p : Core.platform_task) -> p.task_site) (Vehicle_map.find_opt v c.shared.allocation)
  in
  let of_label =
    match t.label with
    | Start (v, _) -> of_task v t.next
    | Done (v, _) | Fail (v, _, _) -> of_task v before
    | _ -> None
  in
  match of_label, site_of_control t.next.control with
  | Some site, _ | None, Some site -> Some site
  | None, None -> site_of_control before.control

let place_of (program : Core.program) at =
  let file = Location.file at in
  let file = if file = program.source_name then None else Some (Dolphin_syntax.Include.from program.source_name file) in
  { file; line = Location.line at; column = Location.column at }

let place program before t =
  let located site = Fault.location program (Fault.make site "") in
  match Option.bind (site before t) located with
  | Some at when Location.line at > 0 -> Some (place_of program at)
  | Some _ | None -> None

let changed (p : Core.platform_task option) (p' : Core.platform_task option) =
  match p, p' with
  | Some p, Some p' when p == p' -> None
  | None, None -> None
  | (Some _ | None), p' -> Some (Option.map (fun (p : Core.platform_task) -> p.name) p')

(* Most transitions are a start or an end that stops no other vehicle. *)
let allocation_changes (before : Configuration.t) (t : Transition.t) =
  let a = before.shared.allocation and a' = t.next.shared.allocation in
  let stops = List.exists (function Effect.Stop _ -> true | _ -> false) t.effects in
  match t.label with
  | _ when a == a' -> []
  | (Start (v, _) | Done (v, _)) when not stops ->
    let change = changed (Vehicle_map.find_opt v a) (Vehicle_map.find_opt v a') in
    List.map (fun change -> (v, change)) (Option.to_list change)
  | _ -> Vehicle_map.bindings (Vehicle_map.merge (fun _ -> changed) a a')

(* [without vs vs'] is [vs] less [vs'], in order. *)
let without vs vs' =
  if vs == vs' then []
  else
    let set = String_set.of_list vs' in
    List.filter (fun v -> not (String_set.mem v set)) vs

(* [less xs ys] is [xs] without one occurrence of each of [ys]. *)
let less xs ys =
  match ys with
  | [] -> xs
  | ys ->
    let left = Hashtbl.create 8 in
    let count x = Option.value (Hashtbl.find_opt left x) ~default:0 in
    List.iter (fun y -> Hashtbl.replace left y (count y + 1)) ys;
    let stays x =
      let n = count x in
      if n > 0 then Hashtbl.replace left x (n - 1);
      n = 0
    in
    List.filter stays xs

let show_pair pair = Format.asprintf "%a" Value.pp_tuple pair

(* The pairs posted and consumed on balance. Labels have all that code did with N, except that of error handlers. *)
let tuple_changes (before : Configuration.t) (t : Transition.t) =
  let balance posted consumed =
    let posted = List.map show_pair posted and consumed = List.map show_pair consumed in
    (less posted consumed, less consumed posted)
  in
  if before.shared.tuples == t.next.shared.tuples then ([], [])
  else
    let of_deeds deeds =
      let posted = List.concat_map (function Code.Posted pairs -> pairs | _ -> []) deeds in
      let consumed = List.concat_map (function Code.Consumed pairs -> pairs | _ -> []) deeds in
      balance posted consumed
    in
    let is_handling = function
      | Rule.Watch_ignore | Watch_propagate | Watch_halt | Watch_retry | Watch_instead -> true
      | _ -> false
    in
    let is_handled = List.exists is_handling t.rules in
    match t.label with
    | Did deed when not is_handled -> of_deeds [ deed ]
    | (Check deeds | Act deeds | Cut deeds) when not is_handled -> of_deeds deeds
    | Input (k, x) -> ([ show_pair (k, Tuples.kept k x t.next.shared.tuples) ], [])
    | _ ->
      let all = List.concat_map (fun (k, xs) -> List.map (fun x -> (k, x)) xs) in
      let gone, come = Tuples.changed ~before:before.shared.tuples ~after:t.next.shared.tuples in
      balance (all come) (all gone)

let of_transition program (before : Configuration.t) (t : Transition.t) =
  let posted, consumed = tuple_changes before t in
  { rules = List.map Rule.name t.rules;
    label = Format.asprintf "%a" Label.pp t.label;
    at = place program before t;
    choice = 0;
    allocated = allocation_changes before t;
    bound = without t.next.shared.bound before.shared.bound;
    released = without before.shared.bound t.next.shared.bound;
    posted;
    consumed;
    requests = List.map Request.of_effect t.effects }

(* {1 JSON} *)

let text_of_place { file; line; column } =
  String.concat ":" (Option.to_list file @ [ string_of_int line; string_of_int column ])

let place_of_text text =
  let wrong = Error (Printf.sprintf "%S, not a line and a column" text) in
  match List.rev (String.split_on_char ':' text) with
  | column :: line :: file -> (
      let file = if file = [] then None else Some (String.concat ":" (List.rev file)) in
      match int_of_string_opt line, int_of_string_opt column with
      | Some line, Some column -> Ok { file; line; column }
      | (Some _ | None), _ -> wrong)
  | [ _ ] | [] -> wrong

let at =
  let pattern = "^(.*:)?[1-9][0-9]*:[1-9][0-9]*$" in
  limited [ ("pattern", `String pattern) ] (conv place_of_text text_of_place text)

let rule = limited [ ("pattern", `String "^[A-Z][A-Z0-9]*(-[A-Z0-9]+)*$") ] text

(* The additions to B or N, and the removals. *)
let difference ~come ~gone =
  let one name get = default [] name Request.some_texts get in
  limited
    [ ("additionalProperties", `Bool false); ("minProperties", `Int 1) ]
    (record
       (let+ come = one come fst
        and+ gone = one gone snd in
        (come, gone)))

let fields =
  let+ rules = field "rule" (limited [ ("minItems", `Int 1) ] (list rule)) (fun s -> s.rules)
  and+ label = field "label" (limited [ ("minLength", `Int 1) ] text) (fun s -> s.label)
  and+ at = optional "at" at (fun s -> s.at) ~doc:"file, line and column; without a file: of the program"
  and+ choice = default 0 "choice" count (fun s -> s.choice)
  and+ allocated = default [] "A" (map (nullable text)) (fun s -> s.allocated)
  and+ bound, released =
    default ([], []) "B" (difference ~come:"bound" ~gone:"released") (fun s -> (s.bound, s.released))
  and+ posted, consumed =
    default ([], []) "N" (difference ~come:"posted" ~gone:"consumed") (fun s -> (s.posted, s.consumed))
  and+ requests = default [] "effects" (limited [ ("minItems", `Int 1) ] (list Request.codec)) (fun s -> s.requests) in
  { rules; label; at; choice; allocated; bound; released; posted; consumed; requests }

let members = Dolphin_json.Codec.members fields

(* {1 Comparison} *)

(* The path may lead to different files, for example through links. *)
let same_place at at' =
  let in_file { line; column; file = _ } = (line, column) in
  Option.map in_file at = Option.map in_file at'

let same ~places s s' =
  String.equal s.label s'.label
  && ((not places) || same_place s.at s'.at)
  && { s with at = s'.at; choice = s'.choice } = s'

let difference ~places expected found =
  let json name s = Option.map Dolphin_json.Canonical.to_string (List.assoc_opt name (members s)) in
  let differs name =
    let e = json name expected and f = json name found in
    if e = f || (name = "at" && same_place expected.at found.at) then None
    else
      let show = Option.value ~default:"nothing" in
      Some (Printf.sprintf "\"%s\" should be %s, not %s" name (show e) (show f))
  in
  List.find_map differs ([ "label"; "rule" ] @ (if places then [ "at" ] else []) @ [ "A"; "B"; "N"; "effects" ])
