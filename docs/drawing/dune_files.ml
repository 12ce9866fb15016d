(* The dune files of the project, and pages that describe it. *)

type sexp = Atom of string | List of sexp list

(* Atoms are words, in quotes or not; a comment is from a semicolon to the end of the line. *)
let parse text =
  let length = String.length text in
  let rec until stop i = if i < length && not (stop text.[i]) then until stop (i + 1) else i in
  let is_delimiter c = String.contains " \t\n()\";" c in
  let rec items parsed i =
    if i >= length then (List.rev parsed, i)
    else
      match text.[i] with
      | ')' -> (List.rev parsed, i + 1)
      | '(' ->
        let inner, i = items [] (i + 1) in
        items (List inner :: parsed) i
      | ' ' | '\t' | '\n' -> items parsed (i + 1)
      | ';' -> items parsed (until (Char.equal '\n') i)
      | '"' ->
        let rec quote i = if text.[i] = '\\' then quote (i + 2) else if text.[i] = '"' then i else quote (i + 1) in
        let stop = quote (i + 1) in
        items (Atom (String.sub text (i + 1) (stop - i - 1)) :: parsed) (stop + 1)
      | _ ->
        let stop = until is_delimiter i in
        items (Atom (String.sub text i (stop - i)) :: parsed) stop
  in
  fst (items [] 0)

(* [package] is the one that installs it; [uses] are libraries, of this project and of others. *)
type component = { name : string; public : string; package : string; folder : string; uses : string list }

let field name fields =
  let is_it = function List (Atom a :: values) when a = name -> Some values | List _ | Atom _ -> None in
  Option.value (List.find_map is_it fields) ~default:[]

let atoms = List.filter_map (function Atom a -> Some a | List _ -> None)

(* Libraries are used by either of their names. *)
let component folder = function
  | List (Atom ("library" | "executable") :: fields) -> (
      match (field "name" fields, field "public_name" fields) with
      | [ Atom name ], [ Atom public ] ->
        let package = List.hd (String.split_on_char '.' public) in
        Some { name; public; package; folder; uses = atoms (field "libraries" fields) }
      | _ -> None)
  | List _ | Atom _ -> None

let read path =
  let channel = open_in_bin path in
  Fun.protect
    ~finally:(fun () -> close_in channel)
    (fun () -> really_input_string channel (in_channel_length channel))

(* Folders with a dot in front are dune's own, and change while it builds. *)
let rec components ~shown folder =
  let entries = Array.to_list (Sys.readdir folder) in
  let inside entry =
    let path = Filename.concat folder entry and shown = shown ^ "/" ^ entry in
    if entry.[0] <> '.' && Sys.is_directory path then components ~shown path else []
  in
  let here = if List.mem "dune" entries then parse (read (Filename.concat folder "dune")) else [] in
  List.filter_map (component shown) here @ List.concat_map inside (List.sort String.compare entries)

let named all x = List.find_opt (fun c -> c.name = x || c.public = x) all

let find text part =
  let n = String.length part in
  let rec go i =
    if i + n > String.length text then failwith ("the page lacks: " ^ part)
    else if String.sub text i n = part then i
    else go (i + 1)
  in
  go 0

let has text part = match find text part with _ -> true | exception Failure _ -> false
