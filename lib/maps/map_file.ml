open Dolphin_geo

type thing = Point of Position.t | Line of Position.t list | Area of Area.t
type t = { things : (string * (thing, string) result) list; notes : string list }

let most_bytes = 20_000_000

let ends suffix name =
  let n = String.length suffix and length = String.length name in
  length >= n && String.lowercase_ascii (String.sub name (length - n) n) = suffix

(* {1 Formats} *)

(* Faults and things with the name of their file in an archive. *)
let in_file name read text =
  let named place = if place = "" then name else name ^ ", " ^ place in
  match read text with
  | drawn -> List.rev (List.rev_map (fun (d : Drawn.t) -> { d with place = named d.place }) drawn)
  | exception Drawn.Wrong { place; why } -> Drawn.wrong (named place) "%s" why

let archived suffix text =
  match Zip_text.files ~most:most_bytes (ends suffix) text with
  | [] -> Drawn.wrong "" "this archive has no *%s" suffix
  | files -> files

let nmisz text =
  List.concat_map (fun (name, text) -> in_file name Neptus_file.read text) (archived ".nmap" text)

(* One file is the map: doc.kml, or else the first. It may link to others in the archive. *)
let kmz text =
  let files = archived ".kml" text in
  let contents = Hashtbl.of_seq (List.to_seq files) and read = Hashtbl.create 4 in
  let rec of_file (name, text) =
    Hashtbl.replace read name ();
    let linked = ref [] and found = Hashtbl.create 4 in
    let follow href =
      match List.find_opt (Hashtbl.mem contents) (Archive_link.targets ~from:name href) with
      | Some target when not (Hashtbl.mem read target || Hashtbl.mem found target) ->
        Hashtbl.replace found target ();
        linked := (target, Hashtbl.find contents target) :: !linked;
        true
      | Some _ | None -> false
    in
    let own = in_file name (Kml_file.read ~follow) text in
    let unread file = not (Hashtbl.mem read (fst file)) in
    let of_linked file = if unread file then of_file file else [] in
    own @ List.concat_map of_linked (List.rev !linked)
  in
  let is_root (name, _) = String.lowercase_ascii name = "doc.kml" in
  let root = Option.value (List.find_opt is_root files) ~default:(List.hd files) in
  let drawn = of_file root in
  let unread (name, _) =
    if Hashtbl.mem read name then []
    else Drawn.left_out name "%s does not link to this file" (fst root)
  in
  drawn @ List.concat_map unread files

let readers =
  [ (".geojson", Geojson_file.read);
    (".json", Geojson_file.read);
    (".kml", Kml_file.read ~follow:(fun _ -> false));
    (".kmz", kmz);
    (".gpx", Gpx_file.read);
    (".plan", Qgc_plan_file.read);
    (".nmap", Neptus_file.read);
    (".nmisz", nmisz) ]

let formats = List.map fst readers

(* {1 Things and their names} *)

let area place result =
  match result with
  | Ok area -> area
  | Error e -> Drawn.wrong place "%s" (Format.asprintf "%a" Area.pp_error e)

(* Files close their rings: the last corner is the first again, perhaps with another rounding. *)
let opened ring =
  match List.rev ring with
  | _ :: (_ :: _ as before) when Drawn.gap ring <= Drawn.accuracy -> List.rev before
  | _ -> ring

(* Halves are united with halves, so that many polygons do not take quadratic time; the first half first, so that
   those which make too many corners are reported early. *)
let united place = function
  | [] -> Drawn.wrong place "a polygon has corners"
  | areas ->
    let areas = Array.of_list areas in
    let rec between i n =
      if n = 1 then areas.(i) else area place (Area.union (between i (n / 2)) (between (i + (n / 2)) (n - (n / 2)))) in
    between 0 (Array.length areas)

(* The area of polygons, with the list of repairs. *)
let ground place rings =
  let repairs = ref [] in
  let polygon ({ rim; holes } : Drawn.ring) =
    let found, changes = area place (Repair.polygon ~holes:(List.map opened holes) (opened rim)) in
    repairs := List.rev_append changes !repairs;
    found
  in
  let whole = united place (List.map polygon rings) in
  (whole, List.sort_uniq Stdlib.compare !repairs)

let thing place : Drawn.shape -> thing * Repair.change list = function
  | Spot p -> (Point p, [])
  | Way ps -> (Line ps, [])
  | Sketch ps -> ((match Area.polygon (opened ps) with Ok area -> Area area | Error _ -> Line ps), [])
  | Round { centre; radius } -> (Area (area place (Area.circle centre radius)), [])
  | Ground rings ->
    let whole, changes = ground place rings in
    (Area whole, changes)
  | Flawed why | Note why -> Drawn.wrong place "%s" why

let kind : Drawn.shape -> string = function
  | Spot _ -> "point"
  | Way _ -> "line"
  | Sketch _ | Ground _ | Round _ -> "area"
  | Flawed _ | Note _ -> "feature"

(* [(name, kind, x)] with a name that no other has. *)
let named things =
  let things = List.rev (List.rev_map (fun (name, kind, x) -> (Utf8_text.harmless name, kind, x)) things) in
  let own = Hashtbl.create 64 and taken = Hashtbl.create 64 and next = Hashtbl.create 64 in
  List.iter (fun (name, _, _) -> Hashtbl.replace own name ()) things;
  let free stem ~from =
    let rec from_number n =
      let name = Printf.sprintf "%s %d" stem n in
      if Hashtbl.mem own name || Hashtbl.mem taken name then from_number (n + 1)
      else begin
        Hashtbl.replace next stem (n + 1);
        name
      end
    in
    from_number (Option.value (Hashtbl.find_opt next stem) ~default:from)
  in
  let one (name, kind, x) =
    let name =
      if name = "" then free kind ~from:1
      else if Hashtbl.mem taken name then free name ~from:2
      else name
    in
    Hashtbl.replace taken name ();
    (name, x)
  in
  List.rev (List.fold_left (fun found x -> one x :: found) [] things)

(* {1 Reading} *)

let told place why = Utf8_text.harmless (if place = "" then why else place ^ ": " ^ why)

let read_by f ~path text =
  match List.find_opt (fun (suffix, _) -> ends suffix path) readers with
  | None -> Error (Printf.sprintf "a map ends in %s" (String.concat ", " formats))
  | Some _ when String.length text > most_bytes ->
    Error (Printf.sprintf "it has more than %d MB" (most_bytes / 1_000_000))
  | Some (_, read) -> (
      match f (read text) with
      | things -> Ok things
      | exception Drawn.Wrong { place; why } -> Error (told place why)
      | exception Stack_overflow -> Error "it is too intricate")

let repaired changes = String.concat ", " (List.map (Format.asprintf "%a" Repair.pp) changes)

let of_drawn drawn =
  let notes = ref [] in
  let note (d : Drawn.t) why =
    let quoted = Printf.sprintf "('%s')" d.name in
    let has_name = d.name = "" || ends (String.lowercase_ascii quoted) d.place in
    let place = if has_name then d.place else d.place ^ " " ^ quoted in
    notes := told place why :: !notes
  in
  let thing (d : Drawn.t) =
    match thing d.place d.shape with
    | found, [] -> Ok found
    | found, changes -> note d (repaired changes); Ok found
    | exception Drawn.Wrong { place; why } -> Error (told place why)
  in
  let one (d : Drawn.t) =
    match d.shape with
    | Note text -> note d text; None
    | Spot _ | Way _ | Ground _ | Sketch _ | Round _ | Flawed _ -> Some (d.name, kind d.shape, thing d)
  in
  let things = named (List.filter_map one drawn) in
  (* A map of which nothing can be used is wrong as a whole. *)
  match things with
  | (_, Error why) :: others when List.for_all (fun (_, thing) -> Result.is_error thing) others ->
    Drawn.wrong "" "%s" why
  | things -> { things; notes = List.rev !notes }

let read = read_by of_drawn

(* {1 As it is drawn} *)

type outline = Outline.t =
  | Spot of Position.t
  | Way of Position.t list
  | Rings of Position.t list list
  | Round of { centre : Position.t; radius : float }

let outline : Drawn.shape -> outline option = function
  | Spot p -> Some (Spot p)
  | Way ps -> Some (Way ps)
  | Sketch ps -> Some (Rings [ ps ])
  | Round { centre; radius } -> Some (Round { centre; radius })
  | Ground rings -> Some (Rings (List.concat_map (fun ({ rim; holes } : Drawn.ring) -> rim :: holes) rings))
  | Flawed _ | Note _ -> None

let drawn_outlines drawn =
  let one (d : Drawn.t) = Option.map (fun outline -> (Utf8_text.harmless d.name, outline)) (outline d.shape) in
  let flaw (d : Drawn.t) = match d.shape with Flawed why -> Some (d.place, why) | _ -> None in
  match List.filter_map one drawn, List.find_map flaw drawn with
  | [], Some (place, why) -> Drawn.wrong place "%s" why
  | outlines, (Some _ | None) -> outlines

let outlines = read_by drawn_outlines
