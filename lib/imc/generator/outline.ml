open Dolphin_imc_definition
open Definition

type item = Message of Definition.message | Group of Definition.group * Definition.message list
type t = { definition : Definition.t; items : item list }

exception Unsupported of string

let unsupported format = Printf.ksprintf (fun why -> raise (Unsupported why)) format
let definition o = o.definition
let items o = o.items
let name = function Message m -> m.name | Group (g, _) -> g.name

let find definition name =
  match find_name definition name with
  | Some m -> Message m
  | None ->
    (* Names in a definition are of messages or of groups: Definition has checked it. *)
    let g = List.find (fun (g : group) -> String.equal g.name name) (groups definition) in
    let members = List.filter_map (find_name definition) g.members in
    Group (g, List.sort (fun (m : message) (n : message) -> compare m.id n.id) members)

let item o name = find o.definition name

let references definition = function
  | Group (_, members) -> List.map (fun m -> Message m) members
  | Message m ->
    let reference (f : field) =
      match f.typ with
      | Inline (Some name) | List (Some name) -> Some (find definition name)
      | Inline None | List None | Number _ | Text _ | Raw -> None
    in
    List.filter_map reference m.fields

let rec is_open_in definition item =
  let any (f : field) = match f.typ with Inline None | List None -> true | _ -> false in
  (match item with Message m -> List.exists any m.fields | Group _ -> false)
  || List.exists (is_open_in definition) (references definition item)

let is_open o item = is_open_in o.definition item

(* Depth first: [placed] grows by an item when all that it refers to is there. *)
let place definition =
  let rec visit above placed item =
    if List.exists (fun i -> String.equal (name i) (name item)) placed then placed
    else if List.mem (name item) above then unsupported "%s contains itself" (name item)
    else
      let above = name item :: above in
      item :: List.fold_left (visit above) placed (references definition item)
  in
  let messages = List.map (fun m -> Message m) (messages definition) in
  let groups = List.map (fun (g : group) -> find definition g.name) (groups definition) in
  List.rev (List.fold_left (visit []) [] (messages @ groups))

let check definition =
  let groups_of (m : message) = List.filter (fun g -> List.mem m.name g.members) (groups definition) in
  let check_field (m : message) (f : field) =
    match f.typ with
    | Inline (Some name) | List (Some name) -> (
        match find definition name with
        | Message { fields = []; _ } -> unsupported "%s.%s: %s has no fields" m.name f.name name
        | Message _ | Group _ -> ())
    | Inline None | List None | Number _ | Text _ | Raw -> ()
  in
  let check_message (m : message) =
    if List.length (groups_of m) > 1 then unsupported "%s is in two groups" m.name;
    List.iter (check_field m) m.fields
  in
  List.iter check_message (messages definition)

let make definition =
  let items = place definition in
  check definition;
  { definition; items }

let all_groups o = List.map (fun (g : group) -> item o g.name) (groups o.definition)

let loose o =
  let grouped (m : message) = List.exists (fun g -> List.mem m.name g.members) (groups o.definition) in
  List.filter (fun m -> not (grouped m)) (messages o.definition)
