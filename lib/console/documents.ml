open Dolphin_service
module Diagnostic = Dolphin_syntax.Diagnostic
module Location = Dolphin_syntax.Location
module On_map = Dolphin_json.On_map

let service ~file ~fleet ~may_read source = Service.read ~file ?fleet ~may_read source

(* {1 Places} *)

(* [units text n] is the number of code units of UTF-16 that the first [n] bytes of [text] have. To be applied to
   [text] once for many [n]. *)
let units text =
  let length = String.length text in
  let before = Array.make (length + 1) 0 in
  for i = 0 to length - 1 do
    let c = Char.code text.[i] in
    before.(i + 1) <- before.(i) + if c < 0x80 then 1 else if c < 0xC0 then 0 else if c >= 0xF0 then 2 else 1
  done;
  fun n -> before.(max 0 (min n length))

(* The byte after this number of code units of [text]. *)
let byte text wanted =
  let length = String.length text in
  let rec from i count =
    if i >= length || count >= wanted then i
    else
      let c = Char.code text.[i] in
      if c < 0x80 then from (i + 1) (count + 1)
      else if c >= 0xF0 then from (i + 4) (count + 2)
      else if c >= 0xE0 then from (i + 3) (count + 1)
      else from (i + 2) (count + 1)
  in
  min length (from 0 0)

let span_in units ({ start; stop } : Service.span) : (string * Yojson.Safe.t) list =
  [ ("from", `Int (units start)); ("to", `Int (units stop)) ]

let span source at = span_in (units source) at

(* {1 Diagnostics} *)

let diagnostic ?file units (d : Diagnostic.t) : Yojson.Safe.t =
  let { Location.start; stop } = d.at in
  let hint = Option.fold d.hint ~none:[] ~some:(fun text -> [ ("hint", `String text) ]) in
  let elsewhere =
    match file, Location.file d.at with
    | None, _ | Some _, "" -> []
    | Some file, other when file = other -> []
    | Some file, other -> [ ("file", `String (Dolphin_syntax.Include.from file other)) ]
  in
  let severity = match d.severity with Error -> "error" | Warning -> "warning" in
  `Assoc
    (span_in units { start = max 0 start.pos_cnum; stop = max 0 stop.pos_cnum }
     @ [ ("line", `Int (Location.line d.at)); ("column", `Int (Location.column d.at)); ("severity", `String severity);
         ("message", `String d.message); ("code", `String (Diagnostic.code_name d.code)) ]
     @ elsewhere @ hint)

let diagnostics d = `List (List.map (diagnostic (units (Service.source d))) (Service.diagnostics d))

let of_error ~file ~source e =
  let plain text = Diagnostic.error Location.none text in
  let found = Dolphin_app.Error.diagnostics e @ List.map plain (Dolphin_app.Error.sentences e) in
  `List (List.map (diagnostic ~file (units source)) found)

(* {1 Writing} *)

let kind : Service.item_kind -> string = function
  | Keyword -> "keyword"
  | Function -> "function"
  | Variable -> "variable"
  | Setting -> "property"
  | Member -> "method"
  | Constant -> "constant"
  | Text -> "text"

let complete d offset : Yojson.Safe.t =
  let at, items = Service.complete d (byte (Service.source d) offset) in
  let item (i : Service.item) =
    `Assoc
      [ ("label", `String i.label); ("kind", `String (kind i.kind)); ("form", `String i.form);
        ("text", `String i.text) ]
  in
  `Assoc (span (Service.source d) at @ [ ("items", `List (List.map item items)) ])

let hover d offset : Yojson.Safe.t =
  match Service.hover d (byte (Service.source d) offset) with
  | Some (at, text) -> `Assoc (span (Service.source d) at @ [ ("text", `String text) ])
  | None -> `Null

let signature d offset : Yojson.Safe.t =
  match Service.signature d (byte (Service.source d) offset) with
  | Some { form; text; _ } -> `Assoc [ ("form", `String form); ("text", `String text) ]
  | None -> `Null

let definition ~path d offset : Yojson.Safe.t =
  match Service.definition d (byte (Service.source d) offset) with
  | Some { file; source; span = at } -> `Assoc (("file", path file) :: span source at)
  | None -> `Null

let format d =
  match Service.format d with
  | Ok text -> Ok (`Assoc [ ("text", `String text) ])
  | Error _ -> Error "the text has faults, and stays as it is"

(* {1 Shapes} *)

let number units (n : Map_shapes.number) : Yojson.Safe.t =
  `Assoc (span_in units n.span @ [ ("negative", `Bool n.negative) ])

let point units (p : Map_shapes.point) : Yojson.Safe.t =
  let coordinates : (string * Yojson.Safe.t) list =
    match p.coordinates with
    | Some (latitude, longitude) -> [ ("latitude", number units latitude); ("longitude", number units longitude) ]
    | None -> []
  in
  `Assoc (("at", On_map.pair p.at) :: coordinates)

let form units : Map_shapes.form -> (string * Yojson.Safe.t) list =
  let list points = `List (List.map (point units) points) in
  function
  | Spot p -> [ ("kind", `String "position"); ("points", list [ p ]) ]
  | Way points -> [ ("kind", `String "way"); ("points", list points) ]
  | Plan points -> [ ("kind", `String "plan"); ("points", list points) ]
  | Rings rings ->
    let rim, holes = match rings with rim :: holes -> (rim, holes) | [] -> ([], []) in
    [ ("kind", `String "area"); ("points", list rim); ("holes", `List (List.map list holes)) ]
  | Round { centre; radius; metres } ->
    let metres = Option.fold metres ~none:[] ~some:(fun n -> [ ("metres", number units n) ]) in
    [ ("kind", `String "circle"); ("points", list [ centre ]); ("radius", Dolphin_json.Canonical.number radius) ]
    @ metres
  | Computed area -> (("kind", `String "computed") :: ("points", `List []) :: On_map.area area)

let shapes d =
  let units = units (Service.source d) in
  let shape ({ name; form = f; span } : Map_shapes.t) =
    `Assoc (("name", `String name) :: span_in units span @ form units f) in
  let of_list found : Yojson.Safe.t =
    `Assoc [ ("shapes", `List (List.map shape found)); ("first", `Int (units (Service.beginning d))) ] in
  Result.map_error (fun _ -> "the text has faults") (Result.map of_list (Service.shapes d))
