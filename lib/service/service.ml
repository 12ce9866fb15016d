open Dolphin_syntax
module Elaborate = Dolphin_semantics.Elaborate
module Fence_declarations = Dolphin_semantics.Fence_declarations
module Fences = Dolphin_plans.Fences
module Scenario = Dolphin_scenario.Scenario

type span = Occurrences.span = { start : int; stop : int }
type fleet = { path : string; text : string }

type t = {
  file : string;
  read : string -> (string, string) result;     (* a file that the text names *)
  source : string;
  fleet : fleet option;
  scenario : Scenario.t option;                 (* the fleet's contents, if it can be read *)
  ast : (Ast.program, Diagnostic.t list) result;
  bindings : Occurrences.binding list;
}

let is_fleet file = Filename.check_suffix file ".fleet"

(* {1 Files} *)

let most_bytes = 64 * 1024 * 1024

let read_file path =
  match open_in_bin path with
  | exception Sys_error why -> Error why
  | channel ->
    Fun.protect ~finally:(fun () -> close_in_noerr channel) @@ fun () ->
    (match in_channel_length channel with
     | n when n > most_bytes -> Error (path ^ " is larger than 64 MB")
     | n -> Ok (really_input_string channel n)
     | exception (Sys_error _ | End_of_file) -> Error (path ^ " cannot be read"))

let chart read ast = Dolphin_charts.Charts.value (Dolphin_charts.Charts.read read ast)

let read_fleet read ~file source =
  let ast = Result.value (Parse.program ~file source) ~default:[] in
  Scenario.read ~chart:(chart read ast) ~file source

(* {1 Documents} *)

let read ~file ?fleet ?(may_read = fun _ -> Ok ()) source =
  let reads path = Result.bind (may_read path) (fun () -> read_file path) in
  let ast = Parse.program ~file source in
  let scenario = Option.bind fleet (fun { path; text } -> Result.to_option (read_fleet reads ~file:path text)) in
  let bindings =
    match ast with
    | Ok ast when not (is_fleet file) -> Occurrences.of_program ~source ast
    | Ok _ | Error _ -> [] in
  { file; read = reads; source; fleet; scenario; ast; bindings }

let source d = d.source

(* {1 Diagnostics} *)

let elaborated d =
  let _, parsed = Include.program ~read:d.read ~file:d.file d.source in
  let elaborate ast =
    let chart = chart d.read ast in
    let of_program (program, warnings) = (program, warnings, (chart, ast)) in
    Result.map of_program (Elaborate.program_with_charts ~chart ~source_name:d.file ast)
  in
  Result.bind parsed elaborate

let of_fleet program (chart, ast) (s : Scenario.t) =
  let program, to_compare = Scenario.within s program in
  let plans = Elaborate.known_plans ~chart ~place:program.place ast in
  let broken = if to_compare = [] then [] else Fence_declarations.broken (Fences.make to_compare) plans in
  broken @ Timeless_loops.found ~plans ast s @ Plan_names.misspelt program s
  @ Foreseen.found ~own_fleet:true program s

let without_place (program : Dolphin_semantics.Core.program) (chart, ast) (s : Scenario.t option) =
  if program.place <> None || Option.bind s (fun s -> s.plans_at) <> None then []
  else Elaborate.plans_without_place ~chart ast

(* Faults in included files are reported in their own documents. *)
let of_program d =
  let own found = List.filter (fun (f : Diagnostic.t) -> Location.file f.at = d.file) found in
  own
  @@
  match elaborated d with
  | Error found -> found
  | Ok (program, warnings, text) ->
    let of_fleet = Option.fold d.scenario ~none:[] ~some:(of_fleet program text) in
    warnings @ without_place program text d.scenario @ of_fleet

let diagnostics d =
  let found =
    match d.ast with
    | Error found -> found
    | Ok _ when is_fleet d.file ->
      (match read_fleet d.read ~file:d.file d.source with Ok _ -> [] | Error found -> found)
    | Ok _ -> of_program d in
  List.stable_sort Diagnostic.compare found

(* {1 Names and strings of the text} *)

let is_letter c =
  match c with
  | 'a' .. 'z' | 'A' .. 'Z' | '0' .. '9' | '_' -> true
  | c -> Char.code c >= 0x80

(* The name at [offset], or just before it. *)
let name_at source offset =
  let length = String.length source in
  let rec back i = if i > 0 && is_letter source.[i - 1] then back (i - 1) else i in
  let rec on i = if i < length && is_letter source.[i] then on (i + 1) else i in
  let offset = max 0 (min offset length) in
  let start = back offset and stop = on offset in
  if start < stop then Some ({ start; stop }, String.sub source start (stop - start)) else None

(* The string in quotes on one line around [offset]. *)
let text_at source offset =
  let length = String.length source in
  let is_quote c = c = '\'' || c = '"' in
  let rec back i =
    if i = 0 || source.[i - 1] = '\n' then None else if is_quote source.[i - 1] then Some i else back (i - 1) in
  let rec on i =
    if i >= length || source.[i] = '\n' then None else if is_quote source.[i] then Some i else on (i + 1) in
  match back (min offset length), on offset with
  | Some start, Some stop when source.[start - 1] = source.[stop] ->
    Some ({ start; stop }, String.sub source start (stop - start))
  | _, _ -> None

let after_point source { start; _ } = start > 0 && source.[start - 1] = '.'

(* {1 Completion} *)

type item_kind = Keyword | Function | Variable | Setting | Member | Constant | Text
type item = { label : string; kind : item_kind; form : string; text : string }

let kind_of_entry : Vocabulary.kind -> item_kind = function
  | Word -> Keyword
  | Procedure | Block | Maneuver -> Function
  | Setting -> Setting
  | Member -> Member
  | Constant -> Constant
  | Fleet_word -> Keyword

let item_of_entry (e : Vocabulary.entry) =
  { label = e.name; kind = kind_of_entry e.kind; form = e.form; text = e.text }

let own_item d name =
  match List.find_opt (fun (b : Occurrences.binding) -> b.name = name) d.bindings with
  | Some { kind = Function parameters; _ } ->
    let form = Printf.sprintf "%s(%s)" name (String.concat ", " parameters) in
    { label = name; kind = Function; form; text = "A function of this program." }
  | Some { kind = Global _ | Local _ | Parameter; _ } | None ->
    { label = name; kind = Variable; form = name; text = "A name of this program." }

let names_of_fleet d =
  let named text name = { label = name; kind = Text; form = Printf.sprintf "'%s'" name; text } in
  match d.scenario with
  | None -> []
  | Some s ->
    List.map (fun (p : Scenario.plan) -> named "A plan of the fleet." p.name) s.plans
    @ List.map (fun (v : Scenario.vehicle) -> named (Printf.sprintf "A vehicle of type %s." v.kind) v.id) s.vehicles

let prelude_item (e : Prelude.entry) = { label = e.name; kind = Function; form = e.form; text = e.text }

(* The files that a text includes, which need not be a program yet. *)
let includes source =
  let of_line line =
    let line = String.trim line in
    let rest = if String.starts_with ~prefix:"include " line then String.sub line 8 (String.length line - 8) else "" in
    let rest = String.trim rest in
    let n = String.length rest in
    if n > 2 && (rest.[0] = '\'' || rest.[0] = '"') && rest.[n - 1] = rest.[0] then Some (String.sub rest 1 (n - 2))
    else None
  in
  List.filter_map of_line (String.split_on_char '\n' source)

(* The parts of the prelude that a program includes, if it does. *)
let of_prelude d = if List.mem Prelude.name (includes d.source) then Prelude.entries () else []

(* The possible names after [owner] and a point: in [owner.x], up to the next point. *)
let constants_of owner =
  let inside = owner ^ "." in
  let n = String.length inside in
  let member (e : Vocabulary.entry) =
    if String.length e.name > n && String.sub e.name 0 n = inside then
      let rest = String.sub e.name n (String.length e.name - n) in
      Some { (item_of_entry e) with label = List.hd (String.split_on_char '.' rest) }
    else None in
  let once items item = if List.exists (fun other -> other.label = item.label) items then items else item :: items in
  List.rev (List.fold_left once [] (List.filter_map member Vocabulary.constants))

let arguments_of_setting vocabulary name =
  let argument x = { label = x; kind = Setting; form = x ^ ": "; text = "An argument of " ^ name ^ "." } in
  match List.assoc_opt name vocabulary with
  | Some names -> List.map argument names
  | None -> []

let entries = List.map item_of_entry

let in_program d (s : Cursor_context.t) =
  let own = List.filter (fun x -> x <> s.prefix) (Cursor_context.assigned d.source) in
  let settings =
    match s.builder, s.call with
    | Some Imc_plan, Some call -> arguments_of_setting Dolphin_semantics.Plan_builder.vocabulary call
    | Some Mission, Some call -> arguments_of_setting Dolphin_semantics.Mission_builder.vocabulary call
    | Some builder, None -> entries (Vocabulary.settings builder)
    | Some _, Some _ | None, _ -> [] in
  settings @ List.map (own_item d) own @ List.map prelude_item (of_prelude d)
  @ entries (Vocabulary.procedures @ Vocabulary.blocks @ Vocabulary.words)

let in_fleet (s : Cursor_context.t) =
  match s.block, s.call with
  | Some block, None -> entries (Vocabulary.fleet_settings block)
  | None, None -> entries Vocabulary.fleet_entries
  | _, Some _ -> []

let complete d offset =
  let s = Cursor_context.at d.source offset in
  let items =
    if s.comment then []
    else if s.text then names_of_fleet d
    else
      match s.owner with
      | Number -> entries Vocabulary.units
      | Named owner ->
        (match constants_of owner with
         | [] -> entries Vocabulary.members @ entries Vocabulary.units
         | constants -> constants)
      | Value -> entries Vocabulary.members
      | Nothing -> if is_fleet d.file then in_fleet s else in_program d s in
  { start = offset - String.length s.prefix; stop = offset }, items

let format d = Formatting.program ~file:d.file d.source

(* {1 Hover} *)

let line_at source { start; _ } =
  let first = match String.rindex_from_opt source (max 0 (start - 1)) '\n' with
    | Some n when start > 0 -> n + 1
    | Some _ | None -> 0 in
  let last = Option.value (String.index_from_opt source start '\n') ~default:(String.length source) in
  String.trim (String.sub source first (last - first))

let quoted form text = Printf.sprintf "```dolphin\n%s\n```\n%s" form text

(* The certain value of [e]. *)
let described (e : Ast.expression option) =
  match Option.map (fun (e : Ast.expression) -> e.it) e with
  | Some (Builder (Pick, _)) -> "A vehicle set"
  | Some (Builder ((Imc_plan | Mission), _)) -> "A task"
  | Some (Builder (Pos, _)) -> "A position"
  | Some (Builder ((All_of | One_of), _)
         | Call { callee = { it = Variable ("task" | "imcPlan" | "action" | "condition" | "idle"); _ }; _ }
         | Binary (Sequence, _, _)) -> "A task"
  | Some (Integer _ | Number _) -> "A number"
  | Some (String _ | Template _) -> "A string"
  | Some (List _) -> "A list"
  | Some (Map _) -> "A map"
  | Some (Closure _) -> "A closure"
  | _ -> "A variable"

let hover_binding d (b : Occurrences.binding) =
  let line = 1 + (Text_position.of_offset d.source b.definition.start).line in
  match b.kind with
  | Function parameters ->
    quoted (Printf.sprintf "def %s(%s)" b.name (String.concat ", " parameters))
      (Printf.sprintf "A function of line %d." line)
  | Global value -> quoted (line_at d.source b.definition) (Printf.sprintf "%s of line %d." (described value) line)
  | Local value ->
    quoted (line_at d.source b.definition) (Printf.sprintf "%s of line %d, a local." (described value) line)
  | Parameter -> quoted b.name (Printf.sprintf "A parameter, of line %d." line)

type place = { file : string; source : string; span : span }

(* The place of the fleet's entry for [name]. *)
let in_fleet_file d name =
  let entry { path; text } =
    let is_entry ({ it; _ } : Ast.statement) =
      match it with
      | Expression
          { it = Call { callee = { it = Variable ("vehicle" | "plan"); _ }; arguments = Positional e :: _ }; _ }
        when e.it = String name -> Some { start = e.at.start.pos_cnum; stop = e.at.stop.pos_cnum }
      | _ -> None in
    match Parse.program ~file:path text with
    | Ok program ->
      Option.map (fun span -> { file = path; source = text; span }) (List.find_map is_entry program)
    | Error _ -> None
  in
  Option.bind d.fleet entry

let hover d offset =
  match Occurrences.at d.bindings offset, text_at d.source offset, name_at d.source offset with
  | Some b, _, Some (span, x) when x = b.name -> Some (span, hover_binding d b)
  | _, Some (span, text), _ when in_fleet_file d text <> None ->
    Option.map (fun place -> span, quoted (line_at place.source place.span) "As the fleet has it.")
      (in_fleet_file d text)
  | _, _, Some (span, x) ->
    let suits (e : Vocabulary.entry) =
      match e.kind with
      | Member | Constant -> after_point d.source span
      | Word | Procedure | Block | Setting | Maneuver | Fleet_word -> not (after_point d.source span) in
    let told_by_language (e : Vocabulary.entry) = quoted e.form e.text in
    let told_by_prelude (e : Prelude.entry) = if e.name = x then Some (quoted e.form e.text) else None in
    let found =
      List.filter_map told_by_prelude (of_prelude d)
      @ List.map told_by_language (List.filter suits (Vocabulary.find x)) in
    if found = [] then None else Some (span, String.concat "\n\n" found)
  | _, _, None -> None

(* {1 Other files} *)

(* The definitions that its included files give it. *)
let included (d : t) : (place * Occurrences.binding) list =
  let bindings path source =
    let of_binding (b : Occurrences.binding) =
      match b.kind with
      | Function _ | Global _ -> Some ({ file = path; source; span = b.definition }, b)
      | Local _ | Parameter -> None
    in
    match Parse.program ~file:path source with
    | Ok ast -> List.filter_map of_binding (Occurrences.of_program ~source ast)
    | Error _ -> []
  in
  let rec of_text (seen, found) file source =
    let of_file (seen, found) name =
      let path = Include.beside file name in
      match if name = Prelude.name || List.mem path seen then Error path else d.read path with
      | Ok source -> of_text (path :: seen, found @ bindings path source) path source
      | Error _ -> (seen, found)
    in
    List.fold_left of_file (seen, found) (includes source)
  in
  snd (of_text ([ Include.beside d.file (Filename.basename d.file) ], []) d.file d.source)

let in_included_file (d : t) x = List.find_opt (fun (_, (b : Occurrences.binding)) -> b.name = x) (included d)

(* {1 Definitions and uses} *)

let definition (d : t) offset =
  match Occurrences.at d.bindings offset, text_at d.source offset, name_at d.source offset with
  | Some b, _, _ -> Some { file = d.file; source = d.source; span = b.definition }
  | None, Some (_, text), _ -> in_fleet_file d text
  | None, None, Some (_, x) -> Option.map fst (in_included_file d x)
  | None, None, None -> None

(* {1 Calls} *)

let signature (d : t) offset =
  let s = Cursor_context.at d.source offset in
  let own x =
    let item form = { label = x; kind = Function; form; text = "A function of this program." } in
    Option.map item (Cursor_context.header d.source x)
  in
  let of_file x =
    match in_included_file d x with
    | Some ({ file; _ }, { kind = Function parameters; _ }) ->
      let form = Printf.sprintf "%s(%s)" x (String.concat ", " parameters) in
      Some { label = x; kind = Function; form; text = "A function of " ^ Filename.basename file ^ "." }
    | Some (_, { kind = Global _ | Local _ | Parameter; _ }) | None -> None
  in
  let of_prelude x = Option.map prelude_item (List.find_opt (fun (e : Prelude.entry) -> e.name = x) (of_prelude d)) in
  let of_language x =
    let is_called (e : Vocabulary.entry) =
      match e.kind with
      | Word | Procedure | Block | Setting | Maneuver | Member | Fleet_word -> true
      | Constant -> String.contains e.form '('
    in
    Option.map item_of_entry (List.find_opt is_called (Vocabulary.find x))
  in
  let first found x = match found with Some _ -> found | None -> x () in
  let item x =
    List.fold_left first (own x) [ (fun () -> of_prelude x); (fun () -> of_file x); (fun () -> of_language x) ] in
  if s.comment then None else Option.bind s.call item

let references d offset =
  match Occurrences.at d.bindings offset with
  | Some b -> b.definition :: List.filter (fun use -> use <> b.definition) b.uses
  | None -> []

let replaced source spans x =
  let buffer = Buffer.create (String.length source) in
  let last =
    List.fold_left
      (fun from { start; stop } ->
         Buffer.add_string buffer (String.sub source from (start - from));
         Buffer.add_string buffer x;
         stop)
      0 spans in
  Buffer.add_string buffer (String.sub source last (String.length source - last));
  Buffer.contents buffer

(* Which uses belong together: of all uses in the order of the text, the number of the binding. *)
let structure bindings =
  let uses =
    List.concat (List.mapi (fun i (b : Occurrences.binding) -> List.map (fun u -> u.start, i) b.uses) bindings) in
  List.map snd (List.sort compare uses)

let rename d offset x =
  match Occurrences.at d.bindings offset with
  | None -> Error "no variable or function of the program here"
  | Some _ when not (Cursor_context.is_name x) -> Error (Printf.sprintf "'%s' is not a name" x)
  | Some b ->
    let renamed = read ~file:d.file ?fleet:d.fleet (replaced d.source b.uses x) in
    let errors d = List.filter (fun (f : Diagnostic.t) -> f.severity = Error) (diagnostics d) in
    if structure renamed.bindings <> structure d.bindings then
      Error (Printf.sprintf "the name '%s' is taken: the program would mean something else" x)
    else
      match errors d, errors renamed with
      | [], f :: _ -> Error f.message
      | _, _ -> Ok b.uses

type symbol = { name : string; is_function : bool; at : span }

let symbols d =
  let symbol (b : Occurrences.binding) =
    match b.kind with
    | Function _ -> Some { name = b.name; is_function = true; at = b.definition }
    | Global _ -> Some { name = b.name; is_function = false; at = b.definition }
    | Local _ | Parameter -> None in
  List.filter_map symbol d.bindings

let allocations (d : t) =
  let own ((at : Location.t), vehicles) =
    if Location.file at = d.file then Some (at.start.pos_cnum, vehicles) else None
  in
  match d.scenario, elaborated d with
  | Some scenario, Ok (program, _, _) when not (is_fleet d.file) ->
    List.filter_map own (Allocations.of_program program scenario)
  | _ -> []

let shapes (d : t) =
  let place = Option.bind d.scenario (fun s -> s.plans_at) in
  let of_ast ast =
    if is_fleet d.file then [] else Map_shapes.of_program ~source:d.source ~chart:(chart d.read ast) ~place ast in
  Result.map of_ast d.ast

let beginning (d : t) =
  match d.ast with
  | Ok ({ at; _ } :: _) -> at.start.pos_cnum
  | Ok [] | Error _ -> String.length d.source
