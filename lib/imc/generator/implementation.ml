open Dolphin_imc_definition
open Definition
open Code

let spf = Printf.sprintf

(* {1 Sets of values} *)

let enumeration name members =
  let case format (n : named) = line format (Names.constructor n.name) n.value in
  let of_int (n : named) = line "| %d -> %s" n.value (Names.constructor n.name) in
  let name_of (n : named) = line "| %s -> %S" (Names.constructor n.name) n.name in
  let body =
    paragraphs
      [
        Ocaml_types.enumeration members ~comment:(fun _ -> "");
        under "let of_int = function" (List.map of_int members @ [ line "| n -> Other n" ]);
        under "let to_int = function" (List.map (case "| %s -> %d") members @ [ line "| Other n -> n" ]);
        under "let name = function" (List.map name_of members @ [ line "| Other n -> string_of_int n" ]);
        [
          line "let to_json = function Other n -> Json.int n | known -> `String (name known)";
          line "let pp ppf value = Format.pp_print_string ppf (name value)";
        ];
      ]
  in
  enclosed (spf "module %s = struct" name) body "end"

let bits name members =
  let pair (n : named) = line "(0x%X, %S);" n.value n.name in
  let constant (n : named) = line "let %s = of_int 0x%X" (Names.value n.name) n.value in
  let body =
    paragraphs
      [
        enclosed "let names = [" (List.map pair members) "]";
        [ line "include Bits.Make (struct let names = names end)" ];
        List.map constant (List.filter Ocaml_types.constant members);
      ]
  in
  enclosed (spf "module %s = struct" name) body "end"

let set = function
  | name, Ocaml_types.Enumeration_of members -> enumeration name members
  | name, Ocaml_types.Bits_of members -> bits name members

(* {1 Fields}

   The functions of an open item take a function first, [any], that reads, writes or shows whatever
   message it may contain. *)

(* [call o i f any] is the function [f] of the item [i], given [any] if it takes it. *)
let call o item f any =
  let name = spf "%s.%s" (Names.module_ (Outline.name item)) f in
  if Outline.is_open o item then spf "%s %s" name any else name

(* The same as an argument. *)
let passed o item f any =
  let call = call o item f any in
  if Outline.is_open o item then spf "(%s)" call else call

let any_parameter o item = if Outline.is_open o item then " any" else ""

let read_contained o = function
  | None -> "any"
  | Some name -> (
      match Outline.item o name with
      | Group _ as item -> passed o item "read" "any"
      | Message m as item ->
        spf "(Reader.only %S %s.id %s)" name (Names.module_ m.name) (passed o item "read" "any"))

let write_contained o = function
  | None -> "any"
  | Some name -> (
      match Outline.item o name with
      | Group _ as item -> passed o item "write_tagged" "any"
      | Message m as item ->
        spf "(Writer.tagged %s.id %s)" (Names.module_ m.name) (passed o item "write" "any"))

let show_contained o = function
  | None -> "any"
  | Some name -> passed o (Outline.item o name) "to_json" "any"

let read_field o (f : field) =
  match f.typ with
  | Number (scalar, Quantity _) -> spf "Reader.%s input" (scalar_name scalar)
  | Number (scalar, (Enumeration names | Bits names)) ->
    spf "%s.of_int (Reader.%s input)" (Ocaml_types.set_module f names) (scalar_name scalar)
  | Text _ | Raw -> "Reader.text input"
  | Inline of_ -> spf "Reader.inline input %s" (read_contained o of_)
  | List of_ -> spf "Reader.list input %s" (read_contained o of_)

let write_field o (m : message) (f : field) =
  let field = spf "%S" (m.name ^ "." ^ f.name) and value = "m." ^ Names.label f.name in
  match f.typ with
  | Number (((F32 | F64 | I64) as scalar), Quantity _) ->
    spf "Writer.%s output %s" (scalar_name scalar) value
  | Number (scalar, Quantity _) -> spf "Writer.%s output %s %s" (scalar_name scalar) field value
  | Number (scalar, (Enumeration names | Bits names)) ->
    let set = Ocaml_types.set_module f names in
    spf "Writer.%s output %s (%s.to_int %s)" (scalar_name scalar) field set value
  | Text _ | Raw -> spf "Writer.text output %s %s" field value
  | Inline of_ -> spf "Writer.inline output %s %s %s" field (write_contained o of_) value
  | List of_ -> spf "Writer.list output %s %s %s" field (write_contained o of_) value

let show_field o (f : field) =
  let value = "m." ^ Names.label f.name in
  match f.typ with
  | Number ((F32 | F64), Quantity _) -> spf "Json.float %s" value
  | Number (I64, Quantity _) -> spf "Json.int64 %s" value
  | Number (_, Quantity _) -> spf "Json.int %s" value
  | Number (_, (Enumeration names | Bits names)) -> spf "%s.to_json %s" (Ocaml_types.set_module f names) value
  | Text _ -> spf "Json.text %s" value
  | Raw -> spf "Json.raw %s" value
  | Inline of_ -> spf "Json.inline %s %s" (show_contained o of_) value
  | List of_ -> spf "Json.list %s %s" (show_contained o of_) value

let default_field (f : field) =
  match f.typ with
  | Number ((F32 | F64), Quantity _) -> "0."
  | Number (I64, Quantity _) -> "0L"
  | Number (_, Quantity _) -> "0"
  | Number (_, Enumeration names) -> spf "%s.of_int 0" (Ocaml_types.set_module f names)
  | Number (_, Bits names) -> spf "%s.none" (Ocaml_types.set_module f names)
  | Text _ | Raw -> "\"\""
  | Inline _ -> "None"
  | List _ -> "[]"

(* {1 Messages} *)

let record_functions o (m : message) =
  let any = any_parameter o (Message m) in
  let label (f : field) = Names.label f.name in
  let read f = line "let %s = %s in" (label f) (read_field o f) in
  let record = line "{ %s }" (String.concat "; " (List.map label m.fields)) in
  let last = List.length m.fields - 1 in
  let write i f = line "%s%s" (write_field o m f) (if i = last then "" else ";") in
  let show (f : field) = line "(%S, %s);" f.name (show_field o f) in
  let default f = line "%s = %s;" (label f) (default_field f) in
  [
    enclosed "let default = {" (List.map default m.fields) "}";
    under (spf "let read%s input =" any) (List.map read m.fields @ [ record ]);
    under (spf "let write%s output m =" any) (List.mapi write m.fields);
    under (spf "let to_json%s m =" any)
      (enclosed (spf "Json.message %S [" m.name) (List.map show m.fields) "]");
  ]

let message o (m : message) =
  let id = [ line "let id = %d" m.id ] in
  let body =
    match m.fields with
    | [] -> id
    | _ ->
      let sets = List.map set (Ocaml_types.own_sets m) in
      let record = Ocaml_types.record o m ~comment:(fun _ -> "") in
      paragraphs (sets @ (record :: id :: record_functions o m))
  in
  enclosed (spf "module %s = struct" (Names.module_ m.name)) body "end"

(* {1 Variants}

   The functions of a variant have one case for each message, with or without fields. *)

let id_case (m : message) =
  let name = Names.module_ m.name in
  line "| %s%s -> %s.id" name (if m.fields = [] then "" else " _") name

let name_case (m : message) =
  line "| %s%s -> %S" (Names.module_ m.name) (if m.fields = [] then "" else " _") m.name

let read_case o any (m : message) =
  let name = Names.module_ m.name in
  match m.fields with
  | [] -> line "| %d -> %s" m.id name
  | _ -> line "| %d -> %s (%s input)" m.id name (call o (Message m) "read" any)

let write_case o any (m : message) =
  let name = Names.module_ m.name in
  match m.fields with
  | [] -> line "| %s -> ()" name
  | _ -> line "| %s m -> %s output m" name (call o (Message m) "write" any)

let show_case o any (m : message) =
  let name = Names.module_ m.name in
  match m.fields with
  | [] -> line "| %s -> Json.message %S []" name m.name
  | _ -> line "| %s m -> %s m" name (call o (Message m) "to_json" any)

let group o (g : group) members =
  let item = Outline.Group (g, members) in
  let any = any_parameter o item in
  let cases case = List.map case members in
  let body =
    paragraphs
      [
        Ocaml_types.variant o item (cases (fun m -> Outline.Message m));
        under "let id = function" (cases id_case);
        under "let name = function" (cases name_case);
        under (spf "let read%s input = function" any)
          (cases (read_case o "any") @ [ line "| id -> Reader.misplaced input id %S" g.name ]);
        under (spf "let write%s output = function" any) (cases (write_case o "any"));
        [ line "let write_tagged%s output m = Writer.tagged (id m) (write%s) output m" any any ];
        under (spf "let to_json%s = function" any) (cases (show_case o "any"));
      ]
  in
  enclosed (spf "module %s = struct" (Names.module_ g.name)) body "end"

let item o = function
  | Outline.Message m -> message o m
  | Outline.Group (g, members) -> group o g members

(* {1 All messages}

   Here the knot is tied: [any] is the function on the type of all messages itself. *)

let members = function Outline.Group (_, members) -> members | Outline.Message m -> [ m ]
let ids messages = String.concat " | " (List.map (fun (m : message) -> string_of_int m.id) messages)

let all o =
  let groups = Outline.all_groups o and loose = Outline.loose o in
  (* One case for each group, which hands over to the group's function; then the loose messages. *)
  let cases f ~arguments ~any case =
    let hand_over item =
      let name = Names.module_ (Outline.name item) in
      let call = match any with None -> spf "%s.%s" name f | Some any -> call o item f any in
      line "| %s m -> %s%s m" name call arguments
    in
    List.map hand_over groups @ List.map case loose
  in
  let read_group item =
    let read = spf "%s (%s input id)" (Names.module_ (Outline.name item)) (call o item "read" "read") in
    under (spf "| %s ->" (ids (members item))) [ line "%s" read ]
  in
  let read =
    line "match id with"
    :: List.concat_map read_group groups
    @ List.map (read_case o "read") loose
    @ [ line "| id -> Reader.unknown input id" ]
  in
  let known = List.concat_map members groups @ loose in
  [
    Ocaml_types.all o;
    under "let id = function" (cases "id" ~arguments:"" ~any:None id_case);
    under "let name = function" (cases "name" ~arguments:"" ~any:None name_case);
    under "let is_known = function" [ line "| %s -> true" (ids known); line "| _ -> false" ];
    under "let rec read input id =" read;
    under "let rec write output = function"
      (cases "write" ~arguments:" output" ~any:(Some "write_tagged") (write_case o "write_tagged"));
    [ line "and write_tagged output m = Writer.tagged (id m) write output m" ];
    under "let rec to_json = function"
      (cases "to_json" ~arguments:"" ~any:(Some "to_json") (show_case o "to_json"));
    [
      line "let equal m n = compare m n = 0";
      line "let pp ppf m = Yojson.Safe.pretty_print ppf (to_json m)";
    ];
  ]

let code o =
  paragraphs (List.map set (Ocaml_types.shared_sets o) @ List.map (item o) (Outline.items o) @ all o)
