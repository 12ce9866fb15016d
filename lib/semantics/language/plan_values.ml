open Dolphin_plans
open Dolphin_results
open Core
module Position = Dolphin_geo.Position

type 'a reader = setting -> string -> value -> ('a, Fault.t) result

let ( let* ) = Result.bind

(* {1 Faults} *)

let fault s format = Format.kasprintf (fun message -> Error (Fault.make s.setting_site message)) format
let wrong s what x = Error (Fault.make s.setting_site (Operators.instead_of what x))
let listed = String.concat ", "

let instead x xs ~otherwise =
  match Dolphin_syntax.Diagnostic.suggest x xs with
  | Some likely -> Printf.sprintf "did you mean %s?" likely
  | None -> otherwise ^ " " ^ listed xs

(* {1 Reading values} *)

let string s what = function
  | String "" -> fault s "%s is empty" what
  | String text -> Ok text
  | x -> wrong s (Printf.sprintf "a string as %s" what) x

let boolean s what = function
  | Boolean b -> Ok b
  | x -> wrong s (Printf.sprintf "true or false as %s" what) x

let number s what x =
  match Value.to_number x with
  | Some n when Float.is_finite n -> Ok n
  | Some n -> fault s "%s is a finite number, not %g" what n
  | None -> wrong s (Printf.sprintf "a number as %s" what) x

let within from upto unit s what x =
  let* n = number s what x in
  if from <= n && n <= upto then Ok n else fault s "%s is from %.15g to %.15g%s, not %.15g" what from upto unit n

let positive upto unit s what x =
  let* n = number s what x in
  if 0. < n && n <= upto then Ok n
  else fault s "%s is greater than 0 and at most %.15g%s, not %.15g" what upto unit n

(* The longest of lengths is IMC's of radii. *)
let longest = 100_000.
let length s = within 0. longest " m" s
let radius s = within 1. longest " m" s

(* Units and arithmetic leave traces: 2.3.minutes is not quite 138 seconds. *)
let whole upto unit s what x =
  let* n = number s what x in
  let rounded = Float.round n in
  if 0. <= rounded && rounded <= upto && Float.abs (n -. rounded) < 1e-6 then Ok (Float.abs rounded)
  else fault s "%s is a whole number from 0 to %.15g%s, not %.15g" what upto unit n

let seconds s = whole 65535. " seconds" s

let percent s what x =
  let* n = number s what x in
  if n > 0. && n <= 1. then
    fault s "%s counts percent from 0 to 100, and %.15g is hardly meant: write 50 for half, not 50.percent" what n
  else within 0. 100. " percent" s what x

let bearing s what x =
  let* degrees = within (-360.) 360. " degrees" s what x in
  let degrees = if degrees < 0. then degrees +. 360. else degrees in
  Ok (if degrees = 360. then 0. else degrees)

let coordinates s latitude longitude =
  match latitude with
  | Position _ ->
    let others = if s.setting = "locate" then "" else "; other arguments have names, such as altitude: 50" in
    fault s "%s takes one position, or latitude and longitude in degrees%s" s.setting others
  | _ ->
    let* latitude = number s "latitude" latitude in
    let* longitude = number s "longitude" longitude in
    Position.make ~latitude ~longitude ~height:0.
    |> Result.map_error (fun e -> Fault.make s.setting_site (Format.asprintf "%a" Position.pp_error e))

let position s what = function
  | Position p -> Ok p
  | List xs when Vector.length xs = 2 -> coordinates s (Vector.get xs 0) (Vector.get xs 1)
  | x -> wrong s (Printf.sprintf "a position %s" what) x

(* {1 Quantities with a unit: speeds and z} *)

let speed_units : (string * Plan.speed_unit) list =
  [ ("Speed.Units.METERS_PS", Metres_per_second);
    ("Speed.Units.RPM", Revolutions_per_minute);
    ("Speed.Units.PERCENTAGE", Percent) ]

let z_units : (string * Plan.z_unit) list =
  [ ("Z.Units.DEPTH", Depth); ("Z.Units.ALTITUDE", Altitude); ("Z.Units.HEIGHT", Height);
    ("Z.Units.NONE", Unspecified) ]

let units = List.map fst speed_units @ List.map fst z_units

(* The first of the units is the example; no table of them is empty. *)
let example known = fst (List.hd known)

(* A unit may go by its last names, and as a string in any case: 'rpm'. *)
let unit_of known s what x =
  let names text =
    let text = String.lowercase_ascii text in
    fun (name, _) ->
      let name = String.lowercase_ascii name in
      name = text || String.ends_with ~suffix:("." ^ text) name
  in
  match x with
  | Symbol text | String text -> (
      match List.find_opt (names text) known with
      | Some (_, unit) -> Ok unit
      | None ->
        fault s "'%s' is not a unit of %s: %s" text what (instead text (List.map fst known) ~otherwise:"units are"))
  | x -> wrong s (Printf.sprintf "a unit of %s, as in %s" what (example known)) x

(* [quantity known default s what xs] is the number and the unit that [xs] are, spread out or as a list. *)
let quantity known default s what xs =
  match (match xs with [ List ys ] -> Vector.to_list ys | xs -> xs) with
  | [ n ] ->
    let* n = number s what n in
    Ok (n, default)
  | [ n; unit ] ->
    let* unit = unit_of known s what unit in
    let* n = number s what n in
    Ok (n, unit)
  | [] | _ :: _ -> fault s "%s is a number and a unit, as in %s 1, %s" what what (example known)

let fastest = 100.

let speed default s xs =
  let* n, unit = quantity speed_units default s "speed" xs in
  let* n =
    match unit with
    | Metres_per_second when n > fastest ->
      fault s "speed is at most %g m/s, not %.15g: if the unit is another, name it, as in speed %.15g, %s" fastest n n
        "Speed.Units.RPM"
    | Metres_per_second -> positive fastest " m/s" s "speed" (Number n)
    | Revolutions_per_minute -> positive 100_000. " RPM" s "speed" (Number n)
    | Percent ->
      let* n = percent s "speed" (Number n) in
      positive 100. " percent" s "speed" (Number n)
  in
  Ok (n, unit)

let z default s xs =
  let* n, (unit : Plan.z_unit) = quantity z_units default s "z" xs in
  let* n =
    match unit with
    | Depth -> length s "depth" (Number n)
    | Altitude -> length s "altitude" (Number n)
    | Height | Unspecified -> within (-.longest) longest " m" s "z" (Number n)
  in
  Ok (n, unit)

(* {1 Payload} *)

(* DUNE's entities and their parameters are written so: High-Frequency Channels. *)
let capitalised text =
  String.split_on_char ' ' text
  |> List.filter (fun word -> word <> "")
  |> List.map String.capitalize_ascii
  |> String.concat " "

let parameter s device (name, x) =
  match x with
  | Boolean _ | Integer _ | Number _ | String _ -> Ok (capitalised name, Value.to_string (Value.canonical x))
  | x -> wrong s (Printf.sprintf "a number, a string or true or false as %s of %s" name device) x

let device s what = function
  | String _ as name ->
    let* name = string s what name in
    Ok { Plan.name = capitalised name; parameters = [ ("Active", "true") ] }
  | Map entries -> (
      match List.assoc_opt "name" entries with
      | None -> fault s "%s lacks its name, as in [name:'Camera']" what
      | Some name ->
        let* name = string s ("name in " ^ what) name in
        let* parameters = Results.map (parameter s name) (List.remove_assoc "name" entries) in
        let active, others = List.partition (fun (k, _) -> k = "Active") parameters in
        let active = if active = [] then [ ("Active", "true") ] else active in
        Ok { Plan.name = capitalised name; parameters = active @ others })
  | x -> wrong s (Printf.sprintf "devices as %s, as in [[name:'Camera', Frequency:50]]" what) x

let devices s what = function
  | List xs -> Results.map (device s what) (Vector.to_list xs)
  | x ->
    let* payload = device s what x in
    Ok [ payload ]

(* {1 Vehicles} *)

let vehicle_names s =
  let rec name = function
    | String _ as x ->
      let* name = string s "a vehicle's name" x in
      Ok [ name ]
    | Vehicles vs -> Ok vs
    | List xs -> all (Vector.to_list xs)
    | x -> wrong s "names of vehicles, as in vehicles 'lauv-noptilus-1', 'lauv-noptilus-2'" x
  and all xs = Results.concat_map name xs in
  let once names name = if List.mem name names then names else name :: names in
  let* names = all s.positional in
  if names = [] then fault s "vehicles lacks the names of vehicles" else Ok (List.rev (List.fold_left once [] names))
