module Model = Dolphin_tla.Model

let specification = Dolphin_tla.Spec.modules

(* The place of [part] in [text]. *)
let find part text =
  let n = String.length part in
  let rec go i =
    if i + n > String.length text then None else if String.sub text i n = part then Some i else go (i + 1)
  in
  go 0

let split_at part text =
  Option.map
    (fun i ->
       let after = i + String.length part in
       (String.sub text 0 i, String.sub text after (String.length text - after)))
    (find part text)

let prefixed prefix text =
  let n = String.length prefix in
  if String.length text > n && String.sub text 0 n = prefix then Some (String.sub text n (String.length text - n))
  else None

(* Paragraphs of MC.tla: "MCName == ..." and "MCName(x, y) == ...". *)
let of_paragraph text : Family.constant option =
  match Option.bind (prefixed "MC" (String.trim text)) (split_at " ==") with
  | None -> None
  | Some (head, definition) ->
    let name, parameters =
      match split_at "(" head with
      | None -> (head, [])
      | Some (name, parameters) ->
        let inside = String.sub parameters 0 (String.length parameters - 1) in
        (name, List.map String.trim (String.split_on_char ',' inside))
    in
    Some { name; parameters; definition }

let rec paragraphs text =
  match split_at "\n\n" text with Some (first, rest) -> first :: paragraphs rest | None -> [ text ]

(* Constants that MC.cfg gives numbers: "  ScriptFuel = 10000". *)
let of_line line : Family.constant option =
  match prefixed "  " line, split_at " = " (String.trim line) with
  | Some _, Some (name, definition) -> Some { name; parameters = []; definition }
  | None, _ | _, None -> None

let text_of files name = (List.find (fun (f : Model.file) -> f.name = name) files).text

let model ?times (c : Case.t) =
  let explain = Format.asprintf "%a" (Fmt.list (Dolphin_syntax.Diagnostic.pp ~source:c.source)) in
  Result.map_error explain
    (Model.of_program ?times ~plans:c.plans ~prompts:c.prompts ~calls:c.calls ~environment:c.environment c.world
       c.program)

let paragraphs_of files name = List.filter_map of_paragraph (paragraphs (text_of files name))
let lines_of files name = List.filter_map of_line (String.split_on_char '\n' (text_of files name))
let of_model files = paragraphs_of files "MC.tla" @ lines_of files "MC.cfg"
let constants c = Result.map of_model (model c)

let timed_constants times c =
  let of_model files =
    paragraphs_of files "MC.tla" @ paragraphs_of files "MCTimed.tla" @ lines_of files "Timed.cfg" in
  Result.map of_model (model ~times c)
