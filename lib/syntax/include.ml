open Ast

type whole = { text : string; files : string list }

type state = {
  read : string -> (string, string) result;
  text : Buffer.t;
  mutable files : string list;                  (* latest first *)
}

(* [a/./b/../c] is [a/c], so that one file has one name. *)
let normal path =
  let step parts = function
    | "" | "." -> parts
    | ".." -> ( match parts with (".." :: _ | []) -> ".." :: parts | _ :: rest -> rest)
    | part -> part :: parts
  in
  let parts = List.rev (List.fold_left step [] (String.split_on_char '/' path)) in
  (if Filename.is_relative path then "" else "/") ^ String.concat "/" parts

let beside file path =
  normal (if Filename.is_relative path then Filename.concat (Filename.dirname file) path else path)

let from file path =
  let parts path = List.filter (( <> ) "") (String.split_on_char '/' (normal path)) in
  let rec beyond folder path =
    match folder, path with
    | part :: folder, part' :: (_ :: _ as path) when part = part' -> beyond folder path
    | folder, path -> List.map (fun _ -> "..") folder @ path
  in
  if path = Prelude.file || Filename.is_relative file <> Filename.is_relative path then path
  else String.concat "/" (beyond (parts (Filename.dirname file)) (parts path))

let shifted by ({ start; stop } : Location.t) =
  let place (p : Lexing.position) = { p with pos_cnum = p.pos_cnum + by; pos_bol = p.pos_bol + by } in
  Location.make (place start, place stop)

let included (s : statement) =
  match s.it with
  | Expression { it = Call { callee = { it = Variable "include"; _ }; arguments }; at } -> (
      match arguments with
      | [ Positional { it = String path; at } ] when path <> "" -> Some (Ok (path, at))
      | _ -> Some (Error (Diagnostic.error at "include takes the name of a file" ~hint:"write include 'lib.dol'")))
  | _ -> None

(* Once for all programs of a process: parsing it takes longer than most programs do. *)
let prelude = lazy (Parse.program ~file:Prelude.file Prelude.text)

(* [chain] is the files that are being included, innermost first. *)
let rec statements state chain file source =
  let base = Buffer.length state.text in
  Buffer.add_string state.text source;
  Buffer.add_char state.text '\n';
  state.files <- file :: state.files;
  match if source == Prelude.text then Lazy.force prelude else Parse.program ~file source with
  | Error found -> Error (List.map (fun (d : Diagnostic.t) -> { d with at = shifted base d.at }) found)
  | Ok ast ->
    let ast = if base = 0 then ast else Relocate.program (shifted base) ast in
    let add result s =
      match result, part state chain file s with
      | Ok before, Ok these -> Ok (List.rev_append these before)
      | Error found, Error found' -> Error (found @ found')
      | (Error _ as wrong), Ok _ | Ok _, (Error _ as wrong) -> wrong
    in
    Result.map List.rev (List.fold_left add (Ok []) ast)

and part state chain file s =
  match included s with
  | None -> Ok [ s ]
  | Some (Error fault) -> Error [ fault ]
  | Some (Ok (name, at)) -> (
      let path = if name = Prelude.name then Prelude.file else beside file name in
      if List.mem path chain then
        let round = String.concat " includes " (List.rev (path :: chain)) in
        Error [ Diagnostic.error at (Printf.sprintf "files that include each other: %s" round) ]
      else if List.mem path state.files then Ok []
      else
        match if name = Prelude.name then Ok Prelude.text else state.read path with
        | Ok source -> statements state (path :: chain) path source
        | Error why -> Error [ Diagnostic.error at (Printf.sprintf "cannot be included: %s" why) ])

let program ~read ~file source =
  let state = { read; text = Buffer.create (String.length source + 1); files = [] } in
  let result = statements state [ normal file ] file source in
  let text = if List.length state.files = 1 then source else Buffer.contents state.text in
  ({ text; files = List.rev state.files }, result)
