open Dolphin_results
open Dolphin_json.Field

type json = Yojson.Safe.t
type window = { earliest : int; latest : int option }
type task = { name : string; vehicle : string; moments : (string * window) list }
type times = { ends : (string * window) list; tasks : task list; endless : bool; missed : int list }
type ended = Vehicle of string | Timer of int
type finding = { at : int; ended : ended; too : string }

(* {1 Members} *)

let window json =
  let* both = list any json in
  match both with
  | [ earliest; latest ] ->
    let* earliest = whole earliest in
    let* latest = nullable whole latest in
    Ok { earliest; latest }
  | _ -> Error "a window is a list of two numbers of milliseconds, or null for the second"

let of_window w : json = `List [ `Int w.earliest; of_option (fun n -> `Int n) w.latest ]
let sorted xs = List.sort Stdlib.compare xs
let windows found = Result.map sorted (Results.map_values window found)
let of_windows = List.map (fun (name, w) -> (name, of_window w))
let moment_names = [ "starts"; "ends"; "fails" ]

let task json =
  let* found = members json in
  let* name = get text "task" found in
  let* vehicle = get text "vehicle" found in
  let others = List.filter (fun (key, _) -> key <> "task" && key <> "vehicle") found in
  match List.find_opt (fun (key, _) -> not (List.mem key moment_names)) others with
  | Some (key, _) -> Error (Printf.sprintf "unknown moment %S; known are %s" key (String.concat ", " moment_names))
  | None -> Result.map (fun moments -> { name; vehicle; moments }) (windows others)

let times found =
  let* ends = optional (fun json -> Result.bind (members json) windows) ~default:[] "ends" found in
  let* tasks = optional (list task) ~default:[] "tasks" found in
  let* endless = optional truth ~default:false "endless" found in
  let* missed = optional (list whole) ~default:[] "missed" found in
  Ok { ends; tasks; endless; missed = sorted missed }

let of_task t : json =
  `Assoc ([ ("task", `String t.name); ("vehicle", `String t.vehicle) ] @ of_windows t.moments)

let of_times t =
  [ ("ends", `Assoc (of_windows t.ends)); ("tasks", `List (List.map of_task t.tasks)); ("endless", `Bool t.endless);
    ("missed", `List (List.map (fun line -> `Int line) t.missed)) ]

let finding json =
  let* found = members json in
  let* at = get whole "at" found in
  let* too = get text "too" found in
  let* ended =
    match List.assoc_opt "vehicle" found, List.assoc_opt "timer" found with
    | Some v, None -> Result.map (fun v -> Vehicle v) (text v)
    | None, Some i -> Result.map (fun i -> Timer i) (whole i)
    | Some _, Some _ | None, None -> Error "a finding is of a vehicle or of a timer"
  in
  Ok { at; ended; too }

let findings json = Result.map sorted (list finding json)

let of_finding f : json =
  let ended = match f.ended with Vehicle v -> ("vehicle", `String v) | Timer i -> ("timer", `Int i) in
  `Assoc [ ("at", `Int f.at); ended; ("too", `String f.too) ]

let of_findings fs : json = `List (List.map of_finding fs)

let dated json =
  let* found = members json in
  let* at = get whole "at" found in
  let* event = get any "event" found in
  Ok (at, event)

(* {1 Differences} *)

let show_window w =
  match w.latest with
  | Some latest -> Printf.sprintf "%d to %d" w.earliest latest
  | None -> Printf.sprintf "%d or later" w.earliest

let show_windows = function
  | [] -> "never"
  | ws -> String.concat ", " (List.map (fun (name, w) -> Printf.sprintf "%s %s" name (show_window w)) ws)

let unlike what show expected seen =
  if expected = seen then None
  else Some (Printf.sprintf "%s: expected %s, seen %s" what (show expected) (show seen))

let difference expected seen =
  let of_task e =
    let same s = s.name = e.name && s.vehicle = e.vehicle in
    let moments = match List.find_opt same seen.tasks with Some s -> s.moments | None -> [] in
    unlike (Printf.sprintf "%s on %s" e.name e.vehicle) show_windows e.moments moments
  in
  let lines = function [] -> "none" | ns -> "line " ^ String.concat ", " (List.map string_of_int ns) in
  let all =
    [ unlike "the ends of runs" show_windows expected.ends seen.ends;
      unlike "whether some run never ends" string_of_bool expected.endless seen.endless;
      unlike "what is missed" lines expected.missed seen.missed ]
    @ List.map of_task expected.tasks
  in
  match List.filter_map Fun.id all with [] -> None | found -> Some (String.concat "; " found)

let show_finding f =
  let what = match f.ended with Vehicle v -> v | Timer i -> Printf.sprintf "timer %d" i in
  Printf.sprintf "%s too %s at %d" what f.too f.at

let show_findings = function [] -> "nothing" | fs -> String.concat "; " (List.map show_finding fs)
