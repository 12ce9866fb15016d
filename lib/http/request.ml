type t = {
  verb : string;
  path : string list;
  query : (string * string) list;
  headers : (string * string) list;
  body : string;
}

type fault = Malformed of string | Too_large | Unsupported of string

let ( let* ) = Result.bind

let header r name =
  match List.filter (fun (known, _) -> known = name) r.headers with [ (_, text) ] -> Some text | _ -> None

let parameter r name = List.assoc_opt name r.query

(* {1 Targets} *)

let decoded ~plus text =
  let text = if plus then String.map (function '+' -> ' ' | c -> c) text else text in
  match Dolphin_numerals.Percent_encoding.decoded text with
  | Some text -> Ok text
  | None -> Error (Malformed "a percent sign without two digits")

let rec each f = function
  | [] -> Ok []
  | x :: rest ->
    let* y = f x in
    let* others = each f rest in
    Ok (y :: others)

let not_empty text = text <> ""

let pair text =
  let name, value =
    match String.index_opt text '=' with
    | Some i -> (String.sub text 0 i, String.sub text (i + 1) (String.length text - i - 1))
    | None -> (text, "")
  in
  let* name = decoded ~plus:true name in
  let* value = decoded ~plus:true value in
  Ok (name, value)

let target text =
  if text = "" || text.[0] <> '/' then Error (Malformed "the target does not begin with /")
  else
    let path, query =
      match String.index_opt text '?' with
      | Some i -> (String.sub text 0 i, String.sub text (i + 1) (String.length text - i - 1))
      | None -> (text, "")
    in
    let* path = each (decoded ~plus:false) (List.filter not_empty (String.split_on_char '/' path)) in
    let* query = each pair (List.filter not_empty (String.split_on_char '&' query)) in
    Ok (path, query)

(* {1 Headers} *)

let is_token c =
  match c with
  | 'a' .. 'z' | 'A' .. 'Z' | '0' .. '9' | '!' | '#' | '$' | '%' | '&' | '\'' | '*' | '+' | '-' | '.' | '^' | '_' | '`'
  | '|' | '~' -> true
  | _ -> false

let for_all f text = Seq.fold_left (fun all c -> all && f c) true (String.to_seq text)
let is_visible c = c = '\t' || (c >= ' ' && c <> '\127')

let header_of_line line =
  match String.index_opt line ':' with
  | Some i when i > 0 ->
    let name = String.sub line 0 i and text = String.trim (String.sub line (i + 1) (String.length line - i - 1)) in
    if for_all is_token name && for_all is_visible text then Ok (String.lowercase_ascii name, text)
    else Error (Malformed "a header with characters that none has")
  | Some _ | None -> Error (Malformed "a line that is not a header")

let length r =
  match List.assoc_opt "transfer-encoding" r.headers, List.filter (fun (n, _) -> n = "content-length") r.headers with
  | Some _, _ -> Error (Unsupported "bodies have a Content-Length here")
  | None, [] -> Ok 0
  | None, [ (_, text) ] when text <> "" && String.length text < 10 && for_all (fun c -> c >= '0' && c <= '9') text ->
    Ok (int_of_string text)
  | None, [ (_, text) ] when for_all (fun c -> c >= '0' && c <= '9') text && text <> "" -> Error Too_large
  | None, _ -> Error (Malformed "the Content-Length is not a number")

let verbs = [ "GET"; "HEAD"; "POST"; "PUT"; "DELETE"; "OPTIONS"; "PATCH" ]

let without_cr line =
  let n = String.length line in
  if n > 0 && line.[n - 1] = '\r' then String.sub line 0 (n - 1) else line

let of_head text =
  match List.map without_cr (String.split_on_char '\n' text) with
  | [] -> Error (Malformed "an empty request")
  | first :: lines -> (
      match String.split_on_char ' ' first with
      | [ verb; wanted; ("HTTP/1.1" | "HTTP/1.0") ] when List.mem verb verbs && for_all is_visible wanted ->
        let* path, query = target wanted in
        let* headers = each header_of_line lines in
        let r = { verb; path; query; headers; body = "" } in
        let* length = length r in
        Ok (r, length)
      | [ _; _; version ] when String.length version > 5 && String.sub version 0 5 = "HTTP/" ->
        Error (Unsupported "this is neither HTTP/1.1 nor a method of it")
      | _ -> Error (Malformed "the first line is not a request"))

let keeps_alive r =
  match Option.map String.lowercase_ascii (List.assoc_opt "connection" r.headers) with
  | Some "close" -> false
  | Some _ | None -> true
