module Search = Dolphin_explore.Search
module Property = Dolphin_explore.Property
module Columns = Dolphin_display.Columns
module Location = Dolphin_syntax.Location

type json = Yojson.Safe.t

let message text : string * json = ("message", `Assoc [ ("text", `String text) ])

(* {1 Places} *)

(* As in a URI: a character that is neither unreserved nor a slash is a percent sign with two digits. *)
let uri path =
  let encoded = function
    | ('a' .. 'z' | 'A' .. 'Z' | '0' .. '9' | '-' | '.' | '_' | '~' | '/') as c -> String.make 1 c
    | c -> Printf.sprintf "%%%02X" (Char.code c)
  in
  String.concat "" (List.map encoded (List.of_seq (String.to_seq path)))

let artifact path = ("artifactLocation", `Assoc [ ("uri", `String (uri path)) ])

(* The stop of a location is the column after its last character, as SARIF has it. *)
let physical (at : Location.t) : string * json =
  let stop = Location.make (at.stop, at.stop) in
  let number (name, n) = (name, `Int n) in
  let region =
    List.map number
      [ ("startLine", Location.line at); ("startColumn", Location.column at); ("endLine", Location.line stop);
        ("endColumn", Location.column stop) ]
  in
  ("physicalLocation", `Assoc [ artifact (Location.file at); ("region", `Assoc region) ])

let location (p : Program_file.t) at : json =
  match at with
  | Some at -> `Assoc [ physical at ]
  | None -> `Assoc [ ("physicalLocation", `Assoc [ artifact p.path ]) ]

(* {1 Runs} *)

let flow rows : (string * json) list =
  let step (row : Columns.row) : json =
    let text = Printf.sprintf "%s: %s" row.actor row.text in
    `Assoc [ ("location", `Assoc (message text :: List.map physical (Option.to_list row.at))) ]
  in
  match rows with
  | [] -> []
  | _ :: _ ->
    let thread = `Assoc [ ("locations", `List (List.map step rows)) ] in
    [ ("codeFlows", `List [ `Assoc [ ("threadFlows", `List [ thread ]) ] ]) ]

let last_place rows = List.find_map (fun (row : Columns.row) -> row.at) (List.rev rows)

(* {1 Results} *)

let rule : Property.t -> string = function
  | Invariant _ -> "invariant"
  | Formula _ -> "formula"
  | Apart _ -> "least-distance"
  | ( No_deadlock | Termination | No_error | Assertions | Vehicles | Allocation | No_halt | No_leftover
    | All_reached ) as property ->
    String.map (function ' ' -> '-' | c -> c) (Property.name property)

let results ~strict ~fairness (p : Program_file.t) (property, (verdict : Search.verdict)) : json list =
  let text = Format.asprintf "%a" (Search.pp_verdict ~fairness p.program) (property, verdict) in
  let result kind level at more : json =
    `Assoc
      ([ ("ruleId", `String (rule property)); ("kind", `String kind); ("level", `String level); message text;
         ("locations", `List [ location p at ]) ] @ more)
  in
  let violated = result "fail" (if strict || not (Exploration.is_remark property) then "error" else "note") in
  match verdict with
  | Holds | Holds_if _ | By_design _ -> [ result "pass" "none" None [] ]
  | Inconclusive _ -> [ result "open" "none" None [] ]
  | Violated run ->
    let rows = Columns.rows p.program ~source:p.source (run.steps @ run.cycle) in
    [ violated (last_place rows) (flow rows) ]
  | Unreached pieces ->
    let at (piece : Dolphin_explore.Coverage.piece) = Some p.program.locations.(piece.site) in
    List.map (fun piece -> violated (at piece) []) pieces

let rules (o : Search.outcome) : json list =
  let add found (property, _) =
    if List.mem_assoc (rule property) found then found else (rule property, property) :: found
  in
  let description text : json = `Assoc [ ("text", `String text) ] in
  let described (id, property) : json =
    `Assoc
      [ ("id", `String id); ("shortDescription", description ("violated: " ^ Property.question property)) ]
  in
  List.rev_map described (List.fold_left add [] o.verdicts)

let json ~strict ~version p (o : Search.outcome) : json =
  let driver : json =
    `Assoc [ ("name", `String "dolphin explore"); ("version", `String version); ("rules", `List (rules o)) ] in
  let run : json =
    `Assoc
      [ ("tool", `Assoc [ ("driver", driver) ]); ("columnKind", `String "unicodeCodePoints");
        ("results", `List (List.concat_map (results ~strict ~fairness:o.fairness p) o.verdicts)) ]
  in
  `Assoc
    [ ("$schema", `String "https://json.schemastore.org/sarif-2.1.0.json"); ("version", `String "2.1.0");
      ("runs", `List [ run ]) ]

let write ~strict ~version p path o =
  Text_file.write path (fun channel ->
      output_string channel (Dolphin_json.Canonical.to_lines (json ~strict ~version p o));
      output_char channel '\n')
