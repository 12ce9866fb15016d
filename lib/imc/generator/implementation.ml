open Dolphin_imc_definition
open Definition
open Code

(* {1 Sets of values} *)

let enumeration name members =
  let case format = List.map (fun (n : named) -> line format (Names.constructor n.name) n.value) members in
  let named = List.map (fun (n : named) -> line "| %s -> %S" (Names.constructor n.name) n.name) members in
  let of_int = List.map (fun (n : named) -> line "| %d -> %s" n.value (Names.constructor n.name)) members in
  [
    line "module %s = struct" name;
    Nest
      (Shape.enumeration members ~comment:(fun _ -> "")
       @ [ line ""; line "let of_int = function"; Nest (of_int @ [ line "| n -> Other n" ]) ]
       @ [ line ""; line "let to_int = function"; Nest (case "| %s -> %d" @ [ line "| Other n -> n" ]) ]
       @ [ line ""; line "let name = function"; Nest (named @ [ line "| Other n -> string_of_int n" ]) ]
       @ [
         line "";
         line "let to_json = function Other n -> Json.int n | known -> `String (name known)";
         line "let pp ppf value = Format.pp_print_string ppf (name value)";
       ]);
    line "end";
  ]

let bits name members =
  let pair (n : named) = line "(0x%X, %S);" n.value n.name in
  let constant (n : named) = line "let %s = of_int 0x%X" (Names.value n.name) n.value in
  let constants = List.map constant (List.filter Shape.constant members) in
  [
    line "module %s = struct" name;
    Nest [ line "let names = ["; Nest (List.map pair members); line "]" ];
    line "";
    Nest [ line "include Bits.Make (struct let names = names end)" ];
    line "";
    Nest constants;
    line "end";
  ]

let set (name, set) =
  (match set with
   | Shape.Enumeration_of members -> enumeration name members
   | Shape.Bits_of members -> bits name members)
  @ [ line "" ]

(* {1 Fields}

   In the code of an open item, [any] reads, writes or shows whatever message it may contain. *)

let scalar = Definition.scalar_name
let any o item = if Outline.is_open o item then " any" else ""

(* [applied o name f] is the function [f] of the item [name], given [any] if it needs it. *)
let applied o name f =
  let call = Printf.sprintf "%s.%s" (Names.module_ name) f in
  if Outline.is_open o (Outline.item o name) then Printf.sprintf "(%s any)" call else call

let reader o = function
  | None -> "any"
  | Some name -> (
      match Outline.item o name with
      | Group _ -> applied o name "read"
      | Message m ->
        Printf.sprintf "(Reader.only %S %s.id %s)" m.name (Names.module_ name) (applied o name "read"))

let read_field o (f : field) =
  match f.typ with
  | Number (s, Quantity _) -> Printf.sprintf "Reader.%s input" (scalar s)
  | Number (s, (Enumeration names | Bits names)) ->
    Printf.sprintf "%s.of_int (Reader.%s input)" (Shape.set_module f names) (scalar s)
  | Text _ | Raw -> "Reader.text input"
  | Inline of_ -> Printf.sprintf "Reader.inline input %s" (reader o of_)
  | List of_ -> Printf.sprintf "Reader.list input %s" (reader o of_)

let writer o = function
  | None -> "any"
  | Some name -> (
      match Outline.item o name with
      | Group _ -> applied o name "write_tagged"
      | Message _ ->
        Printf.sprintf "(Writer.tagged %s.id %s)" (Names.module_ name) (applied o name "write"))

let write_field o (m : message) (f : field) =
  let field = Printf.sprintf "%S" (m.name ^ "." ^ f.name) and value = "m." ^ Names.label f.name in
  match f.typ with
  | Number (((F32 | F64 | I64) as s), Quantity _) -> Printf.sprintf "Writer.%s output %s" (scalar s) value
  | Number (s, Quantity _) -> Printf.sprintf "Writer.%s output %s %s" (scalar s) field value
  | Number (s, (Enumeration names | Bits names)) ->
    Printf.sprintf "Writer.%s output %s (%s.to_int %s)" (scalar s) field (Shape.set_module f names) value
  | Text _ | Raw -> Printf.sprintf "Writer.text output %s %s" field value
  | Inline of_ -> Printf.sprintf "Writer.inline output %s %s %s" field (writer o of_) value
  | List of_ -> Printf.sprintf "Writer.list output %s %s %s" field (writer o of_) value

let shown o = function None -> "any" | Some name -> applied o name "to_json"

let show_field o (f : field) =
  let value = "m." ^ Names.label f.name in
  match f.typ with
  | Number ((F32 | F64), Quantity _) -> Printf.sprintf "Json.float %s" value
  | Number (I64, Quantity _) -> Printf.sprintf "Json.int64 %s" value
  | Number (_, Quantity _) -> Printf.sprintf "Json.int %s" value
  | Number (_, (Enumeration names | Bits names)) ->
    Printf.sprintf "%s.to_json %s" (Shape.set_module f names) value
  | Text _ -> Printf.sprintf "Json.text %s" value
  | Raw -> Printf.sprintf "Json.raw %s" value
  | Inline of_ -> Printf.sprintf "Json.inline %s %s" (shown o of_) value
  | List of_ -> Printf.sprintf "Json.list %s %s" (shown o of_) value

let default_field (f : field) =
  match f.typ with
  | Number ((F32 | F64), Quantity _) -> "0."
  | Number (I64, Quantity _) -> "0L"
  | Number (_, Quantity _) -> "0"
  | Number (_, Enumeration names) -> Printf.sprintf "%s.of_int 0" (Shape.set_module f names)
  | Number (_, Bits names) -> Printf.sprintf "%s.none" (Shape.set_module f names)
  | Text _ | Raw -> "\"\""
  | Inline _ -> "None"
  | List _ -> "[]"

(* {1 Messages and groups} *)

let record_functions o (m : message) =
  let any = any o (Message m) in
  let labels = List.map (fun (f : field) -> Names.label f.name) m.fields in
  let read (f : field) = line "let %s = %s in" (Names.label f.name) (read_field o f) in
  let rec writes = function
    | [] -> []
    | [ f ] -> [ line "%s" (write_field o m f) ]
    | f :: rest -> line "%s;" (write_field o m f) :: writes rest
  in
  let show (f : field) = line "(%S, %s);" f.name (show_field o f) in
  let default (f : field) = line "%s = %s;" (Names.label f.name) (default_field f) in
  [ line ""; line "let default = {"; Nest (List.map default m.fields); line "}"; line "" ]
  @ [ line "let read%s input =" any ]
  @ [ Nest (List.map read m.fields @ [ line "{ %s }" (String.concat "; " labels) ]); line "" ]
  @ [ line "let write%s output m =" any; Nest (writes m.fields); line "" ]
  @ [ line "let to_json%s m =" any ]
  @ [ Nest [ line "Json.message %S [" m.name; Nest (List.map show m.fields); line "]" ] ]

let message o (m : message) =
  let id = line "let id = %d" m.id in
  let body =
    match m.fields with
    | [] -> [ id ]
    | _ ->
      List.concat_map set (Shape.own_sets m)
      @ Shape.record o m ~comment:(fun _ -> "")
      @ [ line ""; id ]
      @ record_functions o m
  in
  [ line "module %s = struct" (Names.module_ m.name); Nest body; line "end"; line "" ]

(* One case for each message: [with_fields name] if it has fields, otherwise [without]. *)
let cases messages ~with_fields ~without =
  let case (m : message) =
    let name = Names.module_ m.name in
    line "| %s" (match m.fields with [] -> without m name | _ -> with_fields m name)
  in
  Nest (List.map case messages)

let pattern name = name ^ " m"
let id_cases = cases ~with_fields:(fun _ n -> n ^ " _ -> " ^ n ^ ".id") ~without:(fun _ n -> n ^ " -> " ^ n ^ ".id")

let name_cases =
  cases
    ~with_fields:(fun m n -> Printf.sprintf "%s _ -> %S" n m.name)
    ~without:(fun m n -> Printf.sprintf "%s -> %S" n m.name)

let read_cases o ~any =
  cases
    ~with_fields:(fun m n -> Printf.sprintf "%d -> %s (%s.read%s input)" m.id n n (any o (Outline.Message m)))
    ~without:(fun m n -> Printf.sprintf "%d -> %s" m.id n)

let write_cases o ~any =
  cases
    ~with_fields:(fun m n -> Printf.sprintf "%s -> %s.write%s output m" (pattern n) n (any o (Outline.Message m)))
    ~without:(fun _ n -> n ^ " -> ()")

let json_cases o ~any =
  cases
    ~with_fields:(fun m n -> Printf.sprintf "%s -> %s.to_json%s m" (pattern n) n (any o (Outline.Message m)))
    ~without:(fun m n -> Printf.sprintf "%s -> Json.message %S []" n m.name)

let group o (g : group) members =
  let item = Outline.Group (g, members) in
  let any_here = any o item in
  let constructor m = line "| %s" (Shape.constructor o (Message m)) in
  [
    line "module %s = struct" (Names.module_ g.name);
    Nest
      [
        line "type %st =" (Shape.parameter o item);
        Nest (List.map constructor members);
        line "";
        line "let id = function";
        id_cases members;
        line "";
        line "let name = function";
        name_cases members;
        line "";
        line "let read%s input = function" any_here;
        read_cases o ~any members;
        Nest [ line "| id -> Reader.misplaced input id %S" g.name ];
        line "";
        line "let write%s output = function" any_here;
        write_cases o ~any members;
        line "";
        line "let write_tagged%s output m = Writer.tagged (id m) (write%s) output m" any_here any_here;
        line "";
        line "let to_json%s = function" any_here;
        json_cases o ~any members;
      ];
    line "end";
    line "";
  ]

let item o = function
  | Outline.Message m -> message o m
  | Outline.Group (g, members) -> group o g members

(* The type of all messages: here [any] becomes the functions on that type itself. *)
let all o =
  let loose = Outline.loose o in
  let groups =
    let member (g : group) =
      match Outline.item o g.name with
      | Group (g, members) -> Some (g, members)
      | Message _ -> None
    in
    List.filter_map member (Definition.groups (Outline.definition o))
  in
  let tied f o item = if Outline.is_open o item then " " ^ f else "" in
  let constructors =
    List.map (fun (g, members) -> Outline.Group (g, members)) groups
    @ List.map (fun m -> Outline.Message m) loose
  in
  let delegate f arguments =
    let case ((g : group), members) =
      let name = Names.module_ g.name in
      line "| %s m -> %s.%s%s%s m" name name f (tied f o (Group (g, members))) arguments
    in
    Nest (List.map case groups)
  in
  let ids members = String.concat " | " (List.map (fun (m : message) -> string_of_int m.id) members) in
  let read_group ((g : group), members) =
    let name = Names.module_ g.name in
    [
      line "| %s ->" (ids members);
      Nest [ line "%s (%s.read%s input id)" name name (tied "read" o (Group (g, members))) ];
    ]
  in
  let known = ids (Definition.messages (Outline.definition o)) in
  [
    line "type t =";
    Nest (List.map (fun item -> line "| %s" (Shape.constructor o item)) constructors);
    line "";
    line "let id = function";
    delegate "id" "";
    id_cases loose;
    line "";
    line "let name = function";
    delegate "name" "";
    name_cases loose;
    line "";
    line "let is_known = function";
    Nest [ line "| %s -> true" known; line "| _ -> false" ];
    line "";
    line "let rec read input id =";
    Nest [ line "match id with" ];
    Nest (List.concat_map read_group groups);
    read_cases o ~any:(tied "read") loose;
    Nest [ line "| id -> Reader.unknown input id" ];
    line "";
    line "let rec write output = function";
    delegate "write" " output";
    write_cases o ~any:(tied "write_tagged") loose;
    line "";
    line "and write_tagged output m = Writer.tagged (id m) write output m";
    line "";
    line "let rec to_json = function";
    delegate "to_json" "";
    json_cases o ~any:(tied "to_json") loose;
    line "";
    line "let equal m n = compare m n = 0";
    line "let pp ppf m = Yojson.Safe.pretty_print ppf (to_json m)";
  ]

let code o =
  List.concat_map set (Shape.shared_sets o) @ List.concat_map (item o) (Outline.items o) @ all o
