open Dolphin_results
open Core

type filter = Vehicle_filter.t = {
  id : string option;
  kind : string option;
  payload : string list;
  region : Dolphin_geo.Area.t option;
}

type count = Exactly of int | All
type pick = { filter : filter; count : count; timeout : float option; otherwise : bool }

let ( let* ) = Result.bind

let accepts filter (state : World.vehicle_state) =
  let holds option test = match option with None -> true | Some x -> test x in
  World.is_ready state
  && holds filter.id (String.equal state.id)
  && holds filter.kind (String.equal state.kind)
  && World.carries filter.payload state
  && holds filter.region (fun area -> Dolphin_geo.Area.contains area state.position)

let pp_filter ppf f =
  Option.iter (Format.fprintf ppf " with id '%s'") f.id;
  Option.iter (Format.fprintf ppf " of type '%s'") f.kind;
  if f.payload <> [] then Format.fprintf ppf " with payload %s" (String.concat ", " f.payload);
  Option.iter (Format.fprintf ppf " in region %a" Dolphin_geo.Area.pp) f.region

let pp_pick ppf pick =
  (match pick.count with
   | All -> Format.fprintf ppf "all vehicles"
   | Exactly 1 -> Format.fprintf ppf "1 vehicle"
   | Exactly n -> Format.fprintf ppf "%d vehicles" n);
  pp_filter ppf pick.filter

let compare_pick (a : pick) (b : pick) =
  Order.both (Vehicle_filter.compare a.filter b.filter) (fun () ->
      Stdlib.compare (a.count, a.timeout, a.otherwise) (b.count, b.timeout, b.otherwise))

let fault (s : setting) message = Error (Fault.make s.setting_site message)

let wrong s what =
  match s.positional with
  | [ x ] -> fault s (Operators.instead_of (Printf.sprintf "%s after '%s'" what s.setting) x)
  | [] | _ :: _ -> fault s (Printf.sprintf "'%s' takes %s" s.setting what)

let number s = match s.positional with [ x ] -> Value.to_number x | _ -> None

(* The original's programs escape ids as for a pattern: 'x8\\-02' is the vehicle x8-02. *)
let unescape id =
  let b = Buffer.create (String.length id) in
  let rec from i =
    if i < String.length id then
      if id.[i] = '\\' && i + 1 < String.length id then begin
        Buffer.add_char b id.[i + 1];
        from (i + 2)
      end
      else begin
        Buffer.add_char b id.[i];
        from (i + 1)
      end
  in
  from 0;
  Buffer.contents b

let add_to_pick pick s =
  let filter = pick.filter in
  match s.setting, s.positional with
  | "id", [ String id ] -> Ok { pick with filter = { filter with id = Some (unescape id) } }
  | "id", _ -> wrong s "a string"
  | "type", [ String kind ] -> Ok { pick with filter = { filter with kind = Some kind } }
  | "type", _ -> wrong s "a string, as in type 'UUV'"
  | "payload", (_ :: _ as names) ->
    let devices = function
      | String name -> Ok [ name ]
      | List xs when Vector.for_all (function String _ -> true | _ -> false) xs ->
        Ok (List.map Value.to_string (Vector.to_list xs))
      | x -> wrong { s with positional = [ x ] } "names of devices"
    in
    let* names = Results.concat_map devices names in
    Ok { pick with filter = { filter with payload = filter.payload @ names } }
  | "payload", [] -> wrong s "names of devices, as in payload 'DVL', 'Sidescan'"
  | "region", [ Area area ] -> Ok { pick with filter = { filter with region = Some area } }
  | "region", [ Position centre; radius ] -> (
      match Operators.binary Around (Position centre) radius with
      | Ok (Area area) -> Ok { pick with filter = { filter with region = Some area } }
      | Ok _ -> wrong s "an area"
      | Error message -> fault s message)
  | "region", _ -> wrong s "an area, or a centre and a radius"
  | "count", [ Wildcard ] -> Ok { pick with count = All }
  | "count", [ x ] -> (
      match Value.canonical_number x with
      | Integer n when n > 0 -> Ok { pick with count = Exactly n }
      | Integer n -> fault s (Printf.sprintf "the number of vehicles must be greater than 0, it is %d" n)
      | _ -> wrong s "a whole number, or _ for all")
  | "count", _ -> wrong s "a whole number, or _ for all"
  | "timeout", _ -> (
      match number s with
      | Some seconds when Time.is_one seconds -> Ok { pick with timeout = Some seconds }
      | Some seconds when seconds >= 0. -> fault s (Time.none "timeout" seconds)
      | Some seconds -> fault s (Printf.sprintf "a timeout is 0 seconds or more, not %g" seconds)
      | None -> wrong s "a time, as in timeout 10.seconds")
  | other, _ -> fault s (Printf.sprintf "pick has no setting '%s'" other)

let pick settings =
  let all = { id = None; kind = None; payload = []; region = None } in
  Results.fold add_to_pick { filter = all; count = Exactly 1; timeout = None; otherwise = false } settings

let position site settings =
  let read (latitude, longitude, height) s =
    match s.setting, number s with
    | ("lat" | "latitude"), Some n -> Ok (Some n, longitude, height)
    | ("lon" | "longitude"), Some n -> Ok (latitude, Some n, height)
    | ("height" | "hae"), Some n -> Ok (latitude, longitude, n)
    | ("lat" | "latitude" | "lon" | "longitude" | "height" | "hae"), None -> wrong s "a number"
    | other, _ -> fault s (Printf.sprintf "pos has no setting '%s': it has lat, lon and height" other)
  in
  let* coordinates = Results.fold read (None, None, 0.) settings in
  match coordinates with
  | Some latitude, Some longitude, height -> (
      match Dolphin_geo.Position.make ~latitude ~longitude ~height with
      | Ok p -> Ok (Position p)
      | Error e -> Error (Fault.make site (Format.asprintf "%a" Dolphin_geo.Position.pp_error e)))
  | None, _, _ -> Error (Fault.make site "pos lacks its latitude: lat DEGREES")
  | Some _, None, _ -> Error (Fault.make site "pos lacks its longitude: lon DEGREES")

let branches site settings =
  let read s =
    match s.setting, s.positional with
    | "when", [ Closure guard; Task body ] -> Ok { guard; body }
    | "when", [ Closure guard; Closure c ] -> Ok { guard; body = Made c }
    | "when", [ Closure _; x ] -> fault s (Operators.instead_of "a task after then" x)
    | _, _ -> fault s "only when { ... } then TASK may stand here"
  in
  let* branches = Results.map read settings in
  if branches = [] then Error (Fault.make site "no when { ... } then TASK: there is nothing to choose from")
  else Ok branches
