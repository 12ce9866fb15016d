open Dolphin_service

type json = Yojson.Safe.t

module Texts = Map.Make (String)

type phase = Fresh | Running | Shut_down | Ended of int

type t = {
  version : string;
  read : string -> string option;
  texts : string Texts.t;                       (* open documents, by URI *)
  phase : phase;
}

let make ~version ~read = { version; read; texts = Texts.empty; phase = Fresh }
let ended s = match s.phase with Ended status -> Some status | Fresh | Running | Shut_down -> None

(* {1 JSON} *)

let field name = function
  | `Assoc fields -> Option.value (List.assoc_opt name fields) ~default:`Null
  | _ -> `Null

let rec path names json = match names with [] -> json | name :: rest -> path rest (field name json)
let string_at names json = match path names json with `String s -> Some s | _ -> None
let int_at names json = match path names json with `Int n -> Some n | _ -> None

let message fields : json = `Assoc (("jsonrpc", `String "2.0") :: fields)
let answer id result = message [ "id", id; "result", result ]

let refusal id code why =
  message [ "id", id; "error", `Assoc [ "code", `Int code; "message", `String why ] ]

let not_json = refusal `Null (-32700) "this is not JSON"
let notification name parameters = message [ "method", `String name; "params", parameters ]

let position source offset : json =
  let p = Text_position.of_offset source offset in
  `Assoc [ "line", `Int p.line; "character", `Int p.character ]

let range source ({ start; stop } : Service.span) : json =
  `Assoc [ "start", position source start; "end", position source stop ]

let edit source span text : json = `Assoc [ "range", range source span; "newText", `String text ]
let markdown text : json = `Assoc [ "kind", `String "markdown"; "value", `String text ]

(* {1 Documents} *)

let text_of s path =
  let is_it uri _ = File_uri.to_path uri = path in
  match Texts.choose_opt (Texts.filter is_it s.texts) with
  | Some (_, text) -> Some text
  | None -> s.read path

let document s uri =
  let file = File_uri.to_path uri in
  let fleet =
    if Filename.check_suffix file ".fleet" then None
    else
      let path = Dolphin_scenario.Scenario.beside file in
      Option.map (fun text -> { Service.path; text }) (text_of s path) in
  Option.map (fun source -> Service.read ~file ?fleet source) (Texts.find_opt uri s.texts)

(* {1 Diagnostics} *)

let diagnostic source (d : Dolphin_syntax.Diagnostic.t) : json =
  let hint = Option.fold d.hint ~none:"" ~some:(fun hint -> "\nhint: " ^ hint) in
  let start = max 0 d.at.start.pos_cnum in
  `Assoc
    [ "range", range source { start; stop = max start d.at.stop.pos_cnum };
      "severity", `Int (match d.severity with Error -> 1 | Warning -> 2);
      "code", `String (Dolphin_syntax.Diagnostic.code_name d.code);
      "source", `String "dolphin";
      "message", `String (d.message ^ hint) ]

let publish uri found : json =
  notification "textDocument/publishDiagnostics" (`Assoc [ "uri", `String uri; "diagnostics", `List found ])

let diagnosed s uri =
  match document s uri with
  | Some d -> [ publish uri (List.map (diagnostic (Service.source d)) (Service.diagnostics d)) ]
  | None -> []

(* Diagnostics of [uri], and of the program beside it if it is a fleet. *)
let all_diagnosed s uri =
  let file = File_uri.to_path uri in
  let uses_it other _ =
    other <> uri && Dolphin_scenario.Scenario.beside (File_uri.to_path other) = file in
  let users = List.map fst (Texts.bindings (Texts.filter uses_it s.texts)) in
  List.concat_map (diagnosed s) (uri :: users)

(* {1 Answers} *)

let capabilities : json =
  let yes = `Bool true in
  `Assoc
    [ "positionEncoding", `String "utf-16";
      "textDocumentSync", `Assoc [ "openClose", yes; "change", `Int 1 ];
      "completionProvider", `Assoc [ "triggerCharacters", `List [ `String "."; `String "'" ] ];
      "signatureHelpProvider", `Assoc [ "triggerCharacters", `List [ `String "("; `String "," ] ];
      "hoverProvider", yes; "definitionProvider", yes; "referencesProvider", yes; "documentHighlightProvider", yes;
      "documentSymbolProvider", yes; "documentFormattingProvider", yes;
      "inlayHintProvider", yes;
      "renameProvider", `Assoc [ "prepareProvider", yes ] ]

let item_kind : Service.item_kind -> int = function
  | Keyword -> 14
  | Function -> 3
  | Variable -> 6
  | Setting -> 10
  | Member -> 2
  | Constant -> 21
  | Text -> 12

let completion d offset : json =
  let span, items = Service.complete d offset in
  let item (i : Service.item) : json =
    `Assoc
      [ "label", `String i.label; "kind", `Int (item_kind i.kind); "detail", `String i.form;
        "documentation", markdown i.text; "textEdit", edit (Service.source d) span i.label ] in
  `List (List.map item items)

let hover d offset : json =
  match Service.hover d offset with
  | None -> `Null
  | Some (span, text) -> `Assoc [ "contents", markdown text; "range", range (Service.source d) span ]

let signature d offset : json =
  match Service.signature d offset with
  | None -> `Null
  | Some { form; text; _ } ->
    `Assoc [ "signatures", `List [ `Assoc [ "label", `String form; "documentation", markdown text ] ] ]

let definition uri d offset : json =
  match Service.definition d offset with
  | None -> `Null
  | Some { file; source; span } ->
    let target = if file = File_uri.to_path uri then uri else File_uri.of_path file in
    `Assoc [ "uri", `String target; "range", range source span ]

let references uri d offset parameters : json =
  let declared = path [ "context"; "includeDeclaration" ] parameters <> `Bool false in
  let spans =
    match Service.references d offset with
    | _ :: uses when not declared -> uses
    | spans -> spans in
  let location span : json = `Assoc [ "uri", `String uri; "range", range (Service.source d) span ] in
  `List (List.map location spans)

let highlights d offset : json =
  `List (List.map (fun span -> `Assoc [ "range", range (Service.source d) span ]) (Service.references d offset))

let symbols d : json =
  let source = Service.source d in
  let symbol (s : Service.symbol) : json =
    let range = range source s.at in
    `Assoc
      [ "name", `String s.name; "kind", `Int (if s.is_function then 12 else 13); "range", range;
        "selectionRange", range ] in
  `List (List.map symbol (Service.symbols d))

(* A hint stands before its task, as the names of parameters do: "noptilus-1, noptilus-2: imcPlan(...)". *)
let allocations d parameters : json =
  let source = Service.source d in
  let offset name or_else =
    match int_at [ "range"; name; "line" ] parameters, int_at [ "range"; name; "character" ] parameters with
    | Some line, Some character -> Text_position.to_offset source { line = max 0 line; character = max 0 character }
    | _ -> or_else
  in
  let first = offset "start" 0 and last = offset "end" (String.length source) in
  let named = function
    | a :: b :: c :: (_ :: _ :: _ as others) ->
      Printf.sprintf "%s, %s, %s and %d more" a b c (List.length others)
    | vehicles -> String.concat ", " vehicles
  in
  let hint (at, vehicles) : json =
    `Assoc
      [ "position", position source at; "label", `String (named vehicles ^ ":"); "paddingRight", `Bool true;
        "tooltip", `String ("Allocated, when all goes well: " ^ String.concat ", " vehicles) ] in
  `List (List.map hint (List.filter (fun (at, _) -> first <= at && at <= last) (Service.allocations d)))

let formatting d : json =
  let source = Service.source d in
  match Service.format d with
  | Ok text when text <> source -> `List [ edit source { start = 0; stop = String.length source } text ]
  | Ok _ | Error _ -> `List []

let renaming id uri d offset parameters =
  let name = Option.value (string_at [ "newName" ] parameters) ~default:"" in
  match Service.rename d offset name with
  | Error why -> refusal id (-32803) why
  | Ok spans ->
    let edits = List.map (fun span -> edit (Service.source d) span name) spans in
    answer id (`Assoc [ "changes", `Assoc [ uri, `List edits ] ])

let prepared d offset : json =
  let here (span : Service.span) = span.start <= offset && offset <= span.stop in
  match List.find_opt here (Service.references d offset) with
  | Some span -> range (Service.source d) span
  | None -> `Null

let of_document s id name parameters =
  let uri = Option.value (string_at [ "textDocument"; "uri" ] parameters) ~default:"" in
  match document s uri with
  | None -> refusal id (-32602) "this document is not open"
  | Some d ->
    let at name = max 0 (Option.value (int_at [ "position"; name ] parameters) ~default:0) in
    let offset = Text_position.to_offset (Service.source d) { line = at "line"; character = at "character" } in
    match name with
    | "textDocument/completion" -> answer id (completion d offset)
    | "textDocument/signatureHelp" -> answer id (signature d offset)
    | "textDocument/hover" -> answer id (hover d offset)
    | "textDocument/definition" -> answer id (definition uri d offset)
    | "textDocument/references" -> answer id (references uri d offset parameters)
    | "textDocument/documentHighlight" -> answer id (highlights d offset)
    | "textDocument/documentSymbol" -> answer id (symbols d)
    | "textDocument/inlayHint" -> answer id (allocations d parameters)
    | "textDocument/formatting" -> answer id (formatting d)
    | "textDocument/rename" -> renaming id uri d offset parameters
    | "textDocument/prepareRename" -> answer id (prepared d offset)
    | _ -> refusal id (-32601) (Printf.sprintf "unknown request '%s'" name)

let request s id name parameters =
  match s.phase, name with
  | Fresh, "initialize" ->
    let about = `Assoc [ "name", `String "dolphin"; "version", `String s.version ] in
    { s with phase = Running }, [ answer id (`Assoc [ "capabilities", capabilities; "serverInfo", about ]) ]
  | Fresh, _ -> s, [ refusal id (-32002) "the first request is 'initialize'" ]
  | Running, "shutdown" -> { s with phase = Shut_down }, [ answer id `Null ]
  | Running, _ -> s, [ of_document s id name parameters ]
  | (Shut_down | Ended _), _ -> s, [ refusal id (-32600) "the server has been shut down" ]

(* {1 Notifications} *)

let changed s uri text =
  let s = { s with texts = Texts.add uri text s.texts } in
  s, all_diagnosed s uri

let closed s uri =
  let s = { s with texts = Texts.remove uri s.texts } in
  s, publish uri [] :: all_diagnosed s uri

let last = function `List xs -> (match List.rev xs with x :: _ -> x | [] -> `Null) | _ -> `Null

let notified s name parameters =
  let uri = string_at [ "textDocument"; "uri" ] parameters in
  match name, uri with
  | "exit", _ -> { s with phase = Ended (if s.phase = Shut_down then 0 else 1) }, []
  | "textDocument/didOpen", Some uri when s.phase = Running ->
    Option.fold (string_at [ "textDocument"; "text" ] parameters) ~none:(s, []) ~some:(changed s uri)
  | "textDocument/didChange", Some uri when s.phase = Running ->
    Option.fold (string_at [ "text" ] (last (field "contentChanges" parameters))) ~none:(s, []) ~some:(changed s uri)
  | "textDocument/didClose", Some uri when s.phase = Running -> closed s uri
  | _, _ -> s, []

let handle s m =
  let parameters = field "params" m in
  match string_at [ "method" ] m, field "id" m with
  | None, `Null -> s, [ refusal `Null (-32600) "this is not a message of the protocol" ]
  | None, _ -> s, []
  | Some name, `Null -> notified s name parameters
  | Some name, id ->
    match request s id name parameters with
    | result -> result
    | exception (Stack_overflow | Not_found | Invalid_argument _ | Failure _ as error) ->
      s, [ refusal id (-32603) (Printexc.to_string error) ]
