type severity = Information | Error | Bug_of_tlc | Warning | State

type t = Message of { code : int; severity : severity; text : string } | Line of string

(* Of a message that has begun: its lines so far, the last first. *)
type reader = Outside | Inside of { code : int; severity : severity; lines : string list }

let start = Outside
let mark = "@!@!@"

(* [between prefix s] is the part of [s] between [prefix] and a mark at the end. *)
let between prefix s =
  let first = String.length prefix in
  let rest = String.length s - first - String.length mark in
  if rest < 0 || String.sub s 0 first <> prefix || String.sub s (first + rest) (String.length mark) <> mark then None
  else Some (String.trim (String.sub s first rest))

let severity = function
  | "1" -> Some Error
  | "2" -> Some Bug_of_tlc
  | "3" -> Some Warning
  | "4" -> Some State
  | "0" -> Some Information
  | _ -> None

let beginning s =
  match Option.map (String.split_on_char ':') (between (mark ^ "STARTMSG ") s) with
  | Some [ code; of_what ] -> (
      match int_of_string_opt code, severity of_what with
      | Some code, Some severity -> Some (Inside { code; severity; lines = [] })
      | None, _ | _, None -> None)
  | Some _ | None -> None

let is_end s = between (mark ^ "ENDMSG ") s <> None

let without_return s =
  let n = String.length s in
  if n > 0 && s.[n - 1] = '\r' then String.sub s 0 (n - 1) else s

let finish = function
  | Outside -> []
  | Inside { code; severity; lines } -> [ Message { code; severity; text = String.concat "\n" (List.rev lines) } ]

let line reader s =
  let s = without_return s in
  match beginning s, reader with
  | Some message, _ -> (message, finish reader)
  | None, Outside -> (Outside, [ Line s ])
  | None, Inside _ when is_end s -> (Outside, finish reader)
  | None, Inside m -> (Inside { m with lines = s :: m.lines }, [])

let of_string text =
  let add (reader, found) s =
    let reader, more = line reader s in
    (reader, List.rev_append more found)
  in
  let lines = String.split_on_char '\n' text in
  let lines = match List.rev lines with "" :: rest -> List.rev rest | _ -> lines in
  let reader, found = List.fold_left add (start, []) lines in
  List.rev_append found (finish reader)
