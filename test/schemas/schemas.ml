(* schemas.exe NAME prints the schema of the format NAME, with what fits a line of 120 characters on one line. *)

module Canonical = Dolphin_json_text.Canonical

let name_text name = Canonical.to_string (`String name) ^ ": "

let rec flat : Yojson.Safe.t -> string = function
  | `Assoc members -> "{" ^ String.concat ", " (List.map (fun (name, x) -> name_text name ^ flat x) members) ^ "}"
  | `List items -> "[" ^ String.concat ", " (List.map flat items) ^ "]"
  | json -> Canonical.to_string json

(* Constants, as many to a line as fit. *)
let filled indent items =
  let add lines item =
    match lines with
    | line :: rest when String.length line + String.length item + 3 <= 120 -> (line ^ ", " ^ item) :: rest
    | lines -> (indent ^ item) :: lines
  in
  String.concat ",\n" (List.rev (List.fold_left add [] items))

let is_constant : Yojson.Safe.t -> bool = function `Assoc _ | `List _ -> false | _ -> true

(* The text of a value that begins at [column] of a line with this indentation; a comma may follow. *)
let rec text ~indent ~column json =
  let one_line = flat json in
  let below opening items closing =
    let inner = indent ^ "  " in
    let item (label, x) =
      inner ^ label ^ text ~indent:inner ~column:(String.length inner + String.length label) x
    in
    opening ^ "\n" ^ String.concat ",\n" (List.map item items) ^ "\n" ^ indent ^ closing
  in
  match json with
  | `Assoc members when column = 0 || column + String.length one_line > 119 ->
    below "{" (List.map (fun (name, x) -> (name_text name, x)) members) "}"
  | `List items when column + String.length one_line > 119 && List.for_all is_constant items ->
    "[\n" ^ filled (indent ^ "  ") (List.map flat items) ^ "\n" ^ indent ^ "]"
  | `List items when column + String.length one_line > 119 -> below "[" (List.map (fun x -> ("", x)) items) "]"
  | _ -> one_line

let () = print_endline (text ~indent:"" ~column:0 (Formats.schema (Formats.find Sys.argv.(1))))
