open Dolphin_geo

type thing = Point of Position.t | Line of Position.t list | Area of Area.t

let most_bytes = 20_000_000

let ends suffix name =
  let n = String.length suffix and length = String.length name in
  length >= n && String.lowercase_ascii (String.sub name (length - n) n) = suffix

(* {1 Formats} *)

(* What an archive has: the files that end so, each read like one. *)
let archived suffix read text =
  match Zip_text.files ~most:most_bytes (ends suffix) text with
  | [] -> Drawn.wrong "" "there is no *%s in this archive" suffix
  | files ->
    let one (name, text) =
      try read text
      with Drawn.Wrong { place; why } -> Drawn.wrong (if place = "" then name else name ^ ", " ^ place) "%s" why
    in
    List.concat_map one files

let readers =
  [ (".geojson", Geojson_file.read);
    (".json", Geojson_file.read);
    (".kml", Kml_file.read);
    (".kmz", archived ".kml" Kml_file.read);
    (".gpx", Gpx_file.read);
    (".plan", Qgc_plan_file.read);
    (".nmap", Neptus_file.read);
    (".nmisz", archived ".nmap" Neptus_file.read) ]

let formats = List.map fst readers

(* {1 Things and their names} *)

let area place result =
  match result with
  | Ok area -> area
  | Error e -> Drawn.wrong place "%s" (Format.asprintf "%a" Area.pp_error e)

(* Files close their rings: the last corner is the first again. *)
let opened ring =
  match ring, List.rev ring with
  | (first : Position.t) :: _ :: _, last :: before
    when first.latitude = last.Position.latitude && first.longitude = last.longitude -> List.rev before
  | ring, _ -> ring

(* Halves are united with halves, so that many polygons take no square of the time; the first half first, so that those
   which make too many corners are told early. *)
let united place = function
  | [] -> Drawn.wrong place "a polygon has corners"
  | areas ->
    let areas = Array.of_list areas in
    let rec between i n =
      if n = 1 then areas.(i) else area place (Area.union (between i (n / 2)) (between (i + (n / 2)) (n - (n / 2)))) in
    between 0 (Array.length areas)

let thing (d : Drawn.t) =
  match d.shape with
  | Spot p -> Point p
  | Way ps -> Line ps
  | Sketch ps -> ( match Area.polygon (opened ps) with Ok area -> Area area | Error _ -> Line ps)
  | Round { centre; radius } -> Area (area d.place (Area.circle centre radius))
  | Ground rings ->
    let polygon ({ rim; holes } : Drawn.ring) =
      area d.place (Area.polygon ~holes:(List.map opened holes) (opened rim)) in
    Area (united d.place (List.map polygon rings))

let kind = function Point _ -> "point" | Line _ -> "line" | Area _ -> "area"

(* A name of a file is no text of a program: control characters would do harm. *)
let harmless name = String.trim (String.map (fun c -> if c < ' ' || c = '\127' then ' ' else c) name)

let named things =
  let taken = Hashtbl.create 64 and next = Hashtbl.create 64 in
  (* The first of its stem may do without a number. *)
  let free ~bare stem =
    let rec from n =
      let name = if bare && n = 1 then stem else Printf.sprintf "%s %d" stem n in
      if Hashtbl.mem taken name then from (n + 1)
      else begin
        Hashtbl.replace next stem (n + 1);
        name
      end
    in
    from (Option.value (Hashtbl.find_opt next stem) ~default:1)
  in
  let one (name, thing) =
    let name =
      match harmless name with
      | "" -> free ~bare:false (kind thing)
      | name -> free ~bare:true name
    in
    Hashtbl.replace taken name ();
    (name, thing)
  in
  List.rev (List.fold_left (fun found x -> one x :: found) [] things)

(* {1 Reading} *)

let read_by f ~path text =
  match List.find_opt (fun (suffix, _) -> ends suffix path) readers with
  | None -> Error (Printf.sprintf "a map ends in %s" (String.concat ", " formats))
  | Some _ when String.length text > most_bytes ->
    Error (Printf.sprintf "it has more than %d MB" (most_bytes / 1_000_000))
  | Some (_, read) -> (
      match f (read text) with
      | things -> Ok things
      | exception Drawn.Wrong { place = ""; why } -> Error why
      | exception Drawn.Wrong { place; why } -> Error (place ^ ": " ^ why)
      | exception Stack_overflow -> Error "it is too intricate")

let read = read_by (fun drawn -> named (List.map (fun (d : Drawn.t) -> (d.name, thing d)) drawn))

(* {1 As it is drawn} *)

type outline =
  | Spot of Position.t
  | Way of Position.t list
  | Rings of Position.t list list
  | Round of { centre : Position.t; radius : float }

let outline : Drawn.shape -> outline = function
  | Spot p -> Spot p
  | Way ps -> Way ps
  | Sketch ps -> Rings [ ps ]
  | Round { centre; radius } -> Round { centre; radius }
  | Ground rings -> Rings (List.concat_map (fun ({ rim; holes } : Drawn.ring) -> rim :: holes) rings)

let outlines =
  let one (d : Drawn.t) = (harmless d.name, outline d.shape) in
  read_by (fun drawn -> List.rev (List.rev_map one drawn))
