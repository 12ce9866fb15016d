open Dolphin_plans
open Dolphin_results
open Core
open Plan_values

let ( let* ) = Result.bind

(* {1 Arguments} *)

(* The kinds of an argument. *)
type kind =
  | Distance                                    (* to the north, the east or up: of either sign *)
  | Height                                      (* above home, of either sign *)
  | Climb                                       (* above home, more than 0 *)
  | Metres                                      (* more than 0 *)
  | Radius                                      (* negative: counter-clockwise; 0: the vehicle's own *)
  | Speed
  | Seconds                                     (* more than 0 *)
  | Duration                                    (* 0: without end *)
  | Degrees
  | Turns
  | Count                                       (* a whole number, 1 at least *)
  | Times                                       (* a whole number; -1: always *)
  | Truth
  | Text
  | Place
  | Area

type parameter = { name : string; kind : kind; is_required : bool }

(* [only_named] have no place of their own in the order of arguments. *)
type item = { positional : parameter list; only_named : parameter list }

let needs name kind = { name; kind; is_required = true }
let takes name kind = { name; kind; is_required = false }
let item ?(named = []) positional = { positional; only_named = named }

(* The common arguments of many items. *)
let way = [ takes "altitude" Height; takes "speed" Speed ]
let offset = [ takes "north" Distance; takes "east" Distance; takes "up" Distance ]
let circling = [ takes "duration" Duration; takes "turns" Turns; takes "radius" Radius ]

let items =
  [ ("arm", item [ needs "arm" Truth ]);
    ("stored", item [ needs "stored" Text ]);
    ("home", item [ takes "position" Place ]);
    ("speed", item [ needs "speed" Speed ]);
    ("altitude", item [ needs "altitude" Height ]);
    ("takeOff", item [ needs "altitude" Climb ]);
    ("takeOffWithYaw", item [ needs "altitude" Climb; needs "yaw" Degrees ]);
    ("goPos", item [ needs "position" Place ] ~named:(offset @ way));
    ("move", item offset ~named:(takes "position" Place :: way));
    ("moveFromHome", item offset ~named:way);
    ("moveAndLoiter", item offset ~named:((takes "position" Place :: circling) @ way));
    ("returnHome", item [] ~named:way);
    ("returnHomeAndLoiter", item [ takes "duration" Duration ] ~named:(List.tl circling @ way));
    ("returnHomeAndLand", item [] ~named:way);
    ("landingPoint", item [ takes "position" Place ] ~named:(List.tl (List.rev offset)));
    ("loiterPos", item [ takes "position" Place ] ~named:(offset @ circling @ way));
    ("loiterTurns", item [ needs "turns" Turns; takes "position" Place ] ~named:(takes "radius" Radius :: way));
    ("loiterTime", item [ needs "duration" Seconds; takes "position" Place ] ~named:(takes "radius" Radius :: way));
    ("delay", item [ needs "duration" Seconds ]);
    ("capturePhoto", item []);
    ("captureSeveralPhotos", item [ needs "count" Count; takes "interval" Seconds ]);
    ("captureUntilStop", item [ takes "interval" Seconds ]);
    ("stopCapturing", item []);
    ("jumpToItem", item [ needs "item" Count; takes "times" Times ]);
    ("surveyArea", item [ needs "area" Area; takes "spacing" Metres ] ~named:(takes "bearing" Degrees :: way)) ]

let names parameters = List.map (fun p -> p.name) parameters
let parameters item = item.positional @ item.only_named

(* {1 Reading values} *)

let largest = 1_000_000.

let whole_from least s what x : (float, Fault.t) result =
  let* n = within least largest "" s what x in
  if Float.is_integer n then Ok n else fault s "%s is a whole number, not %.15g" what n

let corners s what = function
  | Core.Area (Circle { centre; radius }) -> Ok (Dolphin_geo.Survey.around centre ~radius)
  | Area (Shape shape) -> (
      match Dolphin_geo.Area.rings shape with
      | [ corners ] -> Ok corners
      | _ -> fault s "%s has no holes and is of one piece" what)
  | List xs when Vector.length xs >= 3 -> Results.map (position s ("as a corner of " ^ what)) (Vector.to_list xs)
  | List xs -> fault s "%s has three corners or more, not %d" what (Vector.length xs)
  | x -> wrong s (Printf.sprintf "an area or a list of positions as %s" what) x

let read kind s what x : (Mission_plan.argument, Fault.t) result =
  let number read = Result.map (fun n -> Mission_plan.Number n) (read s what x) in
  match kind with
  | Distance -> number (within (-.longest) longest " m")
  | Height -> number (within (-.longest) longest " m")
  | Climb | Metres -> number (positive longest " m")
  | Radius -> number (within (-.longest) longest " m")
  | Speed -> number (positive 100. " m/s")
  | Seconds -> number (positive largest " seconds")
  | Duration -> number (within 0. largest " seconds")
  | Degrees -> number (within (-360.) 360. " degrees")
  | Turns -> number (positive 1000. " turns")
  | Count -> number (whole_from 1.)
  | Times -> number (whole_from (-1.))
  | Truth -> Result.map (fun b -> Mission_plan.Truth b) (boolean s what x)
  | Text -> Result.map (fun text -> Mission_plan.Text text) (string s what x)
  | Place -> Result.map (fun p -> Mission_plan.Place p) (position s ("as " ^ what) x)
  | Area -> Result.map (fun ps -> Mission_plan.Places ps) (corners s what x)

(* {1 Which argument is which} *)

(* [place], of arguments whatever they are: [pair] makes a position of two. A place may stand before the metres that it
   is moved by, and latitude and longitude for a place that is alone. *)
let assign s item ~pair ~is_place positional named =
  let is p (q : parameter) = q.name = p in
  let lists_place = List.exists (is "position") item.only_named in
  let order, positional =
    match item.positional, positional with
    | [ { kind = Place; _ } ], [ a; b ] -> (item.positional, [ pair a b ])
    | order, first :: _ when lists_place && is_place first -> (takes "position" Place :: order, positional)
    | order, _ -> (order, positional)
  in
  let rec by_order parameters given =
    match parameters, given with
    | _, [] -> Ok []
    | p :: parameters, x :: given -> Result.map (fun rest -> (p, x) :: rest) (by_order parameters given)
    | [], _ :: _ when order = [] -> fault s "%s takes its arguments by name only" s.setting
    | [], _ :: _ ->
      fault s "%s takes %s, not %d arguments" s.setting (String.concat ", " (names order)) (List.length positional)
  in
  let by_name (name, x) =
    match List.find_opt (is name) (parameters item) with
    | Some p -> Ok (p, x)
    | None when parameters item = [] -> fault s "%s takes no arguments, such as '%s'" s.setting name
    | None ->
      fault s "%s has no argument '%s': %s" s.setting name
        (instead name (names (parameters item)) ~otherwise:"it takes")
  in
  let* first = if parameters item = [] && positional <> [] then fault s "%s takes no arguments" s.setting
    else by_order order positional in
  let* rest = Results.map by_name named in
  let rec check_once = function
    | [] -> Ok ()
    | (p, _) :: rest when List.mem_assoc p rest -> fault s "%s has its argument '%s' twice" s.setting p.name
    | _ :: rest -> check_once rest
  in
  let all = first @ rest in
  let* () = check_once all in
  match List.find_opt (fun p -> p.is_required && not (List.mem_assoc p all)) (parameters item) with
  | Some p -> fault s "%s lacks its %s" s.setting p.name
  | None -> Ok all

let what s p = if p.name = s.setting then p.name else Printf.sprintf "%s of %s" p.name s.setting

let check_together s arguments =
  if List.mem_assoc "turns" arguments && List.mem_assoc "duration" arguments then
    fault s "%s goes on for a number of turns or of seconds, not both: leave out turns or duration" s.setting
  else Ok ()

let both a b = List (Vector.of_list [ a; b ])

let is_position = function Position _ | List _ -> true | _ -> false

let read_item s item =
  let* all = assign s item ~pair:both ~is_place:is_position s.positional s.named in
  let* arguments =
    Results.map (fun (p, x) -> Result.map (fun x -> (p.name, x)) (read p.kind s (what s p) x)) all in
  let* () = check_together s arguments in
  Ok { Mission_plan.word = s.setting; arguments }

(* {1 Settings} *)

let name (s : setting) =
  match s.positional, s.named with
  | [ x ], [] -> string s "name" x
  | _, _ -> fault s "name takes one string"

let vehicles (s : setting) =
  if s.named <> [] then fault s "vehicles takes no named arguments" else vehicle_names s

let vocabulary =
  [ ("name", []); ("vehicles", []) ] @ List.map (fun (name, item) -> (name, names (parameters item))) items

let no_setting (s : setting) =
  fault s "a mission has no item '%s': %s" s.setting
    (instead s.setting (List.map fst vocabulary) ~otherwise:"it has")

(* Unknown values are passed over. *)
let check_literals s item arguments =
  let positional = List.filter_map (function None, x -> Some x | Some _, _ -> None) arguments in
  let named = List.filter_map (function Some k, x -> Some (k, x) | None, _ -> None) arguments in
  let pair a b = match a, b with Some a, Some b -> Some (both a b) | Some _, None | None, _ -> None in
  let is_place = function
    | Some x -> is_position x
    | None -> List.compare_lengths positional item.positional <> 0
  in
  let* all = assign s item ~pair ~is_place positional named in
  let check (p, x) =
    match x with Some x -> Result.map ignore (read p.kind s (what s p) x) | None -> Ok () in
  let* _ = Results.map check all in
  check_together s (List.map (fun (p, x) -> (p.name, x)) all)

let literal_fault setting arguments =
  let s = { setting; positional = []; named = []; setting_site = 0 } in
  match List.assoc_opt setting items with
  | None -> None
  | Some item -> (
      match check_literals s item arguments with
      | Ok () -> None
      | Error (fault : Fault.t) -> Some fault.message)

(* {1 Missions} *)

type draft = { called : string; by : string list; latest_first : (setting * Mission_plan.item) list }

let add draft s =
  match s.setting, List.assoc_opt s.setting items with
  (* The setting's name for the machine, as in all inline plans. *)
  | "planName", _ -> Result.map (fun called -> { draft with called }) (name s)
  | "vehicles", _ -> Result.map (fun by -> { draft with by }) (vehicles s)
  | _, Some item -> Result.map (fun i -> { draft with latest_first = (s, i) :: draft.latest_first }) (read_item s item)
  | _, None -> no_setting s

let check_jump count ((s : setting), (i : Mission_plan.item)) =
  match i.word, List.assoc_opt "item" i.arguments with
  | "jumpToItem", Some (Mission_plan.Number n) when n > float_of_int count ->
    fault s "jumpToItem %.15g: the mission has %d items (arm and altitude do not count)" n count
  | _, _ -> Ok ()

(* A survey of more is a mistake in its spacing. *)
let most_lines = 2000.

let check_survey ((s : setting), (i : Mission_plan.item)) =
  match List.assoc_opt "area" i.arguments with
  | Some (Mission_plan.Places corners) ->
    let number name ~default =
      match List.assoc_opt name i.arguments with Some (Mission_plan.Number n) -> n | Some _ | None -> default in
    let spacing = number "spacing" ~default:20. in
    let lines = Dolphin_geo.Survey.count corners ~spacing ~bearing:(number "bearing" ~default:0.) in
    if lines > most_lines then
      fault s "spacing of surveyArea is too small: %.15g m makes %.0f lines, more than %.0f" spacing lines most_lines
    else Ok ()
  | Some (Number _ | Truth _ | Text _ | Place _) | None -> Ok ()

let build ~name site settings =
  let* draft = Results.fold add { called = name; by = []; latest_first = [] } settings in
  let all = List.rev draft.latest_first in
  let items = List.map snd all in
  let numbered = List.filter Mission_plan.is_numbered items in
  let* () =
    if numbered = [] then
      Error (Fault.make site (Printf.sprintf "mission '%s' has no item, such as takeOff or goPos" draft.called))
    else Ok ()
  in
  let* _ = Results.map (check_jump (List.length numbered)) all in
  let* _ = Results.map check_survey all in
  Ok { Mission_plan.name = draft.called; vehicles = draft.by; items }
