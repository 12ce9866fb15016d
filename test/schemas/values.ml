open QCheck2.Gen

type json = Yojson.Safe.t

(* Texts that fit the patterns of the schemas. *)
let of_pattern = function
  | "^/" -> map (fun name -> "/" ^ name) (string_size ~gen:(char_range 'a' 'z') (int_bound 5))
  | "^[A-Za-z0-9_-]+$" -> string_size ~gen:(oneofl [ 'a'; 'Z'; '0'; '_'; '-' ]) (int_range 1 5)
  | "^[0-9a-f]{32}$" -> string_size ~gen:(char_range 'a' 'f') (return 32)
  | "^[A-Z][A-Z0-9]*(-[A-Z0-9]+)*$" -> oneofl [ "SEQ-1"; "PAR-ERR"; "DONE" ]
  | "^(.*:)?[1-9][0-9]*:[1-9][0-9]*$" -> oneofl [ "1:2"; "lib.dol:10:3" ]
  | "^[0-9]{4}-[0-9]{2}-[0-9]{2}T[0-9]{2}:[0-9]{2}:[0-9]{2}Z$" -> return "2026-03-01T12:00:00Z"
  | "^[0-9]{4}-[0-9]{2}-[0-9]{2}T[0-9]{2}:[0-9]{2}:[0-9]{2}[+-][0-9]{2}:[0-9]{2}$" ->
    return "2026-06-01T21:00:00+01:00"
  | pattern -> invalid_arg ("no texts for " ^ pattern)

let character =
  oneof [ oneofl [ "\""; "\\"; "\n"; " "; "\xC3\xA9"; "\xF0\x9F\x90\xAC" ]; map (String.make 1) (char_range 'a' 'z') ]

let text ~least ~most =
  let* length = int_range least (min most (least + 6)) in
  map (fun cs -> String.concat "" cs) (list_repeat length character)

(* A text has more bytes than characters. *)
let short ~least ~most =
  if most = max_int then text ~least ~most else string_size ~gen:(char_range 'a' 'z') (int_range least most)

let any : json t =
  oneofl
    [ `Null; `Bool true; `Int 2; `Float 0.5; `String "x"; `List [ `Int 1; `String "y" ]; `Assoc [ ("a", `Int 1) ] ]

let member name (schema : json) = match schema with `Assoc members -> List.assoc_opt name members | _ -> None
let number json = Yojson.Safe.Util.to_number json
let whole ~default name schema = Option.fold (member name schema) ~none:default ~some:Yojson.Safe.Util.to_int
let texts json = List.map Yojson.Safe.Util.to_string (Yojson.Safe.Util.to_list json)

(* Whole numbers are read where others may be, so both are drawn. *)
let real schema : json t =
  let least = Option.fold (member "minimum" schema) ~none:(-1e9) ~some:number
  and most = Option.fold (member "maximum" schema) ~none:1e9 ~some:number in
  let whole x : json = `Int (int_of_float x) in
  let inside x = x >= least && x <= most in
  oneof
    [ map (fun x : json -> `Float (if member "multipleOf" schema = None then x else Float.round x)) (float_range least (Float.min most (least +. 1e9)));
      oneofl (List.map (fun x : json -> `Float x) [ least; most ]);
      oneofl (List.map whole (List.filter inside [ -7.; 0.; 1.; 2.; 30.; Float.ceil least ])) ]

let integer schema : json t =
  let least = whole ~default:(-1000) "minimum" schema in
  let most = whole ~default:(least + 2000) "maximum" schema in
  map (fun i : json -> `Int i) (int_range least most)

let rec parts f = function
  | [] -> return []
  | x :: rest ->
    let* first = f x in
    map (fun rest -> first @ rest) (parts f rest)

let of_schema ~document root =
  (* The schema that a reference means, and the document that it is in. *)
  let resolve root uri =
    match String.split_on_char '#' uri with
    | [ file; pointer ] ->
      let root = if file = "" then root else document file in
      let step schema name = if name = "" then schema else Option.get (member name schema) in
      (root, List.fold_left step root (String.split_on_char '/' pointer))
    | _ -> invalid_arg uri
  in
  let rec value depth root schema : json t =
    match member "$ref" schema, member "const" schema, member "enum" schema, member "type" schema with
    | Some (`String uri), _, _, None ->
      let root, schema = resolve root uri in
      value (depth - 1) root schema
    | _, Some x, _, _ -> return x
    | _, _, Some (`List names), _ -> oneofl names
    | _, _, _, Some (`String name) -> typed depth root schema name
    | _, _, _, Some (`List names) ->
      let* name = oneofl names in
      typed depth root schema (Yojson.Safe.Util.to_string name)
    | _ -> ( match member "oneOf" schema with Some one_of -> possibility depth root one_of (value depth root) | None -> any)
  and possibility : 'a. int -> json -> json -> (json -> 'a t) -> 'a t = fun depth _ one_of f ->
    match one_of with
    (* The first ones end a recursion. *)
    | `List all when depth < 0 -> f (List.hd all)
    | `List all -> let* one = oneofl all in f one
    | _ -> invalid_arg "oneOf"
  and typed depth root schema = function
    | "null" -> return `Null
    | "boolean" -> map (fun b : json -> `Bool b) bool
    | "integer" -> integer schema
    | "number" -> real schema
    | "string" ->
      let least = whole ~default:0 "minLength" schema and most = whole ~default:max_int "maxLength" schema in
      let text = match member "pattern" schema with Some (`String p) -> of_pattern p | _ -> short ~least ~most in
      map (fun text : json -> `String text) text
    | "array" ->
      let least = whole ~default:0 "minItems" schema in
      let most = whole ~default:(if depth < 0 then least else least + 3) "maxItems" schema in
      let item = Option.fold (member "items" schema) ~none:any ~some:(value depth root) in
      map (fun items : json -> `List items) (list_size (int_range least most) item)
    | "object" ->
      let+ members = members depth root schema and+ others = others depth root schema in
      `Assoc (members @ List.filter (fun (name, _) -> not (List.mem_assoc name members)) others)
    | name -> invalid_arg name
  and members depth root schema : (string * json) list t =
    match member "$ref" schema with
    | Some (`String uri) -> let root, schema = resolve root uri in members (depth - 1) root schema
    | _ ->
      let required = Option.fold (member "required" schema) ~none:[] ~some:texts in
      let properties = match member "properties" schema with Some (`Assoc all) -> all | _ -> [] in
      let property (name, schema) =
        let* is_there = if List.mem name required then return true else if depth < 0 then return false else bool in
        if is_there then map (fun x -> [ (name, x) ]) (value depth root schema) else return []
      in
      let* own = parts property properties in
      let* own = return (with_companions schema own) in
      let unions = match member "allOf" schema with Some (`List all) -> all | _ -> [ schema ] in
      let chosen schema =
        match member "oneOf" schema with
        | Some one_of -> possibility depth root one_of (members depth root)
        | None -> return []
      in
      map (fun chosen -> own @ chosen) (parts chosen unions)
  and with_companions schema own =
    match member "dependentRequired" schema with
    | Some (`Assoc needs) ->
      let is_whole (name, _) =
        match List.assoc_opt name needs with
        | Some others -> List.for_all (fun other -> List.mem_assoc other own) (texts others)
        | None -> true
      in
      List.filter is_whole own
    | _ -> own
  and others depth root schema =
    match member "additionalProperties" schema with
    | Some (`Assoc _ as schema) ->
      let names = list_size (int_bound 2) (text ~least:1 ~most:3) in
      let entry name = map (fun x -> [ (name, x) ]) (value depth root schema) in
      let* names = names in
      parts entry (List.sort_uniq String.compare names)
    | _ -> return []
  in
  value 4 root root
