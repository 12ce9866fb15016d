(* Prints every mutation of a file. Fails if one does not parse, or changes nothing, or if a kind has none.

   test_mutation.exe --parse FILE...      of each file and kind, the first mutation parses
   test_mutation.exe --documented PAGE    PAGE has a table with a row for each kind

   The last two print nothing. *)

let parses text =
  match Parse.implementation (Lexing.from_string text) with
  | _ -> true
  | exception Syntaxerr.Error _ -> false

let fail format = Printf.ksprintf (fun message -> prerr_endline message; exit 1) format

let check file source (m : Mutation.t) =
  let text = Mutation.apply m source in
  let difference = Mutation.difference source text in
  if String.equal source text then fail "%s:%d: %s changes nothing" file m.line (Mutation.name m.kind);
  if not (parses text) then fail "%s:%d: %s\n%s" file m.line (Mutation.name m.kind) difference;
  difference

let print_all file =
  let source = Working_copy.read file in
  let mutations = Mutation.all source in
  let print (m : Mutation.t) = Printf.printf "%d: %s\n%s" m.line (Mutation.name m.kind) (check file source m) in
  List.iter print mutations;
  let is_missing kind = not (List.exists (fun (m : Mutation.t) -> m.kind = kind) mutations) in
  List.iter (fun kind -> fail "no %s" (Mutation.name kind)) (List.filter is_missing Mutation.kinds)

let parse_some file =
  let source = Working_copy.read file in
  let mutations = Mutation.all source in
  let first kind = List.find_opt (fun (m : Mutation.t) -> m.kind = kind) mutations in
  List.iter (fun m -> ignore (check file source m : string)) (List.filter_map first Mutation.kinds)

(* Each kind stands in the page for people, with its meaning. *)
let documented page =
  let text = Working_copy.read page in
  let check kind =
    let meaning = String.concat "\\|" (String.split_on_char '|' (Mutation.meaning kind)) in
    let row = Printf.sprintf "| `%s` | %s |" (Mutation.name kind) meaning in
    if not (List.mem row (String.split_on_char '\n' text)) then fail "%s lacks this row:\n%s" page row
  in
  List.iter check Mutation.kinds

let () =
  match List.tl (Array.to_list Sys.argv) with
  | "--parse" :: files -> List.iter parse_some files
  | [ "--documented"; page ] -> documented page
  | files -> List.iter print_all files
