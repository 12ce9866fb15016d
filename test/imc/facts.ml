open Yojson.Safe.Util

type field = {
  name : string;
  typ : string;
  unit : string option;
  restriction : string option;
  values : (int * string) list;
}

type message = { id : int; name : string; fields : field list }

let value json = (to_int (index 0 json), to_string (index 1 json))

let field json =
  {
    name = to_string (member "name" json);
    typ = to_string (member "type" json);
    unit = to_string_option (member "unit" json);
    restriction = to_string_option (member "message-type" json);
    values = (match member "values" json with `Null -> [] | values -> List.map value (to_list values));
  }

let lines = lazy (Corpus.json_lines "facts.jsonl")

let messages =
  lazy
    (let message json =
       match member "id" json with
       | `Int id ->
         let fields = List.map field (to_list (member "fields" json)) in
         Some { id; name = to_string (member "abbrev" json); fields }
       | _ -> None
     in
     List.filter_map message (Lazy.force lines))

let groups =
  lazy
    (let group (name, members) = (name, List.map to_string (to_list members)) in
     let of_line json = match member "groups" json with `Assoc groups -> List.map group groups | _ -> [] in
     List.concat_map of_line (Lazy.force lines))

let message name = List.find (fun (m : message) -> String.equal m.name name) (Lazy.force messages)

let admitted = function
  | None -> Lazy.force messages
  | Some name -> (
      match List.assoc_opt name (Lazy.force groups) with
      | Some members -> List.map message members
      | None -> [ message name ])

let bits values n =
  let single (bit, _) = List.mem bit (List.init 32 (fun i -> 1 lsl i)) in
  let set = List.filter (fun (bit, name) -> single (bit, name) && n land bit <> 0) values in
  let rest = List.fold_left (fun rest (bit, _) -> rest land lnot bit) n set in
  match List.assoc_opt n values with
  | Some name when n <> 0 -> [ name ]
  | _ -> List.map snd set @ if rest = 0 then [] else [ Printf.sprintf "0x%X" rest ]

let number field n =
  match field.unit with
  | Some "Enumerated" -> (
      match List.assoc_opt n field.values with Some name -> `String name | None -> `Int n)
  | Some "Bitfield" -> `List (List.map (fun name -> `String name) (bits field.values n))
  | _ -> `Int n

let rec shown json =
  match json with
  | `Assoc (("abbrev", `String name) :: members) ->
    let field (f : field) =
      let value = List.assoc f.name members in
      let value =
        match (f.typ, value) with
        | ("message" | "message-list"), _ -> shown value
        | ("fp32_t" | "fp64_t"), `Int n -> `Float (float n)
        | _, `Int n -> number f n
        | _, other -> other
      in
      (f.name, value)
    in
    `Assoc (("abbrev", `String name) :: List.map field (message name).fields)
  | `List items -> `List (List.map shown items)
  | other -> other
