open Dolphin_semantics
module Map_file = Dolphin_maps.Map_file

type chart = { path : string; digest : string; value : (Chart.t, string) result }
type t = chart list

let of_thing : Map_file.thing -> Core.value = function
  | Point p -> Position p
  | Line ps -> List (Vector.of_list (List.rev (List.rev_map (fun p -> Core.Position p) ps)))
  | Area area -> Area area

let of_map ({ things; notes } : Map_file.t) : Chart.t =
  let entry (name, thing) = (name, match thing with Ok thing -> of_thing thing | Error _ -> Core.Null) in
  let flaw (name, thing) = match thing with Ok _ -> None | Error why -> Some (name, why) in
  { value = Map (List.rev (List.rev_map entry things)); flawed = List.filter_map flaw things; notes }

let of_text path text = Result.map of_map (Map_file.read ~path text)

(* An editor asks for the same files again with each letter that is typed. *)
let most_recent = 8
let recent = ref []

let remembered path text =
  let key = (path, Digest.string text) in
  match List.assoc_opt key !recent with
  | Some value -> value
  | None ->
    let value = of_text path text in
    recent := (key, value) :: List.filteri (fun i _ -> i < most_recent - 1) !recent;
    value

let read file program =
  let paths = List.sort_uniq String.compare (List.map fst (Chart_calls.paths program)) in
  let one path =
    match file path with
    | Ok text -> { path; digest = Digest.to_hex (Digest.string text); value = remembered path text }
    | Error why -> { path; digest = ""; value = Error why }
  in
  List.map one paths

(* "harbour.geojson: line 3, column 5: ..." *)
let value charts path =
  match List.find_opt (fun c -> c.path = path) charts with
  | None -> Error (path ^ ": it was not read")
  | Some c ->
    let named why = if String.length why > String.length path && String.sub why 0 (String.length path) = path then why
      else path ^ ": " ^ why in
    Result.map_error named c.value

let identity charts = String.concat "" (List.map (fun c -> Printf.sprintf "// map '%s' %s\n" c.path c.digest) charts)
