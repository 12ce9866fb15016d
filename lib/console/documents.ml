open Dolphin_service
module Diagnostic = Dolphin_syntax.Diagnostic
module Location = Dolphin_syntax.Location

let service ~file ~fleet ~may_read source = Service.read ~file ?fleet ~may_read source

(* {1 Places} *)

(* How many code units of UTF-16 the first [n] bytes of [text] have. *)
let units text n =
  let count = ref 0 in
  for i = 0 to min n (String.length text) - 1 do
    let c = Char.code text.[i] in
    if c < 0x80 || c >= 0xC0 then count := !count + if c >= 0xF0 then 2 else 1
  done;
  !count

(* The byte at which so many code units of [text] have passed. *)
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

let span source ({ start; stop } : Service.span) : (string * Yojson.Safe.t) list =
  [ ("from", `Int (units source start)); ("to", `Int (units source stop)) ]

(* {1 Diagnostics} *)

let diagnostic ?file source (d : Diagnostic.t) : Yojson.Safe.t =
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
    (span source { start = max 0 start.pos_cnum; stop = max 0 stop.pos_cnum }
     @ [ ("line", `Int (Location.line d.at)); ("column", `Int (Location.column d.at)); ("severity", `String severity);
         ("message", `String d.message); ("code", `String (Diagnostic.code_name d.code)) ]
     @ elsewhere @ hint)

let diagnostics d = `List (List.map (diagnostic (Service.source d)) (Service.diagnostics d))

let of_error ~file ~source e =
  let plain text = Diagnostic.error Location.none text in
  let found = Dolphin_app.Error.diagnostics e @ List.map plain (Dolphin_app.Error.sentences e) in
  `List (List.map (diagnostic ~file source) found)

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
