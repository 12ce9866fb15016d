module Request = Dolphin_http.Request
module Response = Dolphin_http.Response

type file = { kind : string; text : string; gzipped : string option; tag : string }
type t = (string list * file) list

let kinds =
  [ (".html", "text/html; charset=utf-8"); (".js", "text/javascript; charset=utf-8");
    (".css", "text/css; charset=utf-8"); (".svg", "image/svg+xml"); (".png", "image/png");
    (".txt", "text/plain; charset=utf-8"); (".json", "application/json") ]

let missing =
  "<!doctype html><meta charset=\"utf-8\"><title>Dolphin console</title><h1>The page is not built</h1>\
   <p>This server has its programming interface, which <code>docs/api.md</code> describes, and no page. \
   <code>scripts/console</code> in the sources builds the page; <code>DOLPHIN_CONSOLE</code> names the folder of one \
   that is elsewhere.</p>"

(* Pictures are compressed already; short texts gain nothing. *)
let shortest = 1_000

let file kind text =
  let gains = kind <> "image/png" && String.length text >= shortest in
  let gzipped = if gains then Some (Compressed.gzip text) else None in
  { kind; text; gzipped; tag = Digest.to_hex (Digest.string text) }

let read path =
  match Dolphin_app.Text_file.read path with Ok text -> Some text | Error _ -> None

let rec below folder path =
  match Sys.readdir (Filename.concat folder (String.concat "/" path)) with
  | exception Sys_error _ -> []
  | names -> List.concat_map (fun name -> item folder (path @ [ name ])) (Array.to_list names)

and item folder path =
  let full = Filename.concat folder (String.concat "/" path) in
  if Sys.is_directory full then below folder path
  else
    match List.assoc_opt (Filename.extension full) kinds, read full with
    | Some kind, Some text -> [ (path, file kind text) ]
    | _, _ -> []

let load folder =
  let files = Option.fold folder ~none:[] ~some:(fun folder -> below folder []) in
  if List.mem_assoc [ "index.html" ] files then files
  else [ ([ "index.html" ], file "text/html; charset=utf-8" missing) ]

(* {1 What the browser has, and understands} *)

let items text = List.map String.trim (String.split_on_char ',' text)

(* [gzip;q=0] refuses it. *)
let takes_gzip (r : Request.t) =
  let is_gzip item =
    match List.map String.trim (String.split_on_char ';' (String.lowercase_ascii item)) with
    | [ "gzip" ] -> true
    | [ "gzip"; quality ] -> (
        match String.split_on_char '=' quality with
        | [ "q"; q ] -> Option.fold (float_of_string_opt q) ~none:false ~some:(fun q -> q > 0.)
        | _ -> false)
    | _ -> false
  in
  Option.fold (Request.header r "accept-encoding") ~none:false ~some:(fun text -> List.exists is_gzip (items text))

(* A weak tag is as good: [W/"..."]. *)
let has (r : Request.t) tag =
  let bare item =
    let n = String.length item in
    if n > 2 && String.sub item 0 2 = "W/" then String.sub item 2 (n - 2) else item
  in
  let is_it item = item = "*" || bare item = tag in
  Option.fold (Request.header r "if-none-match") ~none:false ~some:(fun text -> List.exists is_it (items text))

(* The browser keeps the file, and asks each time whether it has changed. *)
let response r { kind; text; gzipped; tag } =
  let encoding, body, tag =
    match gzipped with
    | Some body when takes_gzip r -> ([ ("Content-Encoding", "gzip") ], body, Printf.sprintf "\"%s-gzip\"" tag)
    | Some _ | None -> ([], text, Printf.sprintf "\"%s\"" tag)
  in
  let headers = [ ("ETag", tag); ("Cache-Control", "no-cache"); ("Vary", "Accept-Encoding") ] in
  if has r tag then { Response.status = 304; headers; body = Text "" }
  else Response.text ~headers:(headers @ encoding) ~kind 200 body

let find page (r : Request.t) =
  let path = if r.path = [] then [ "index.html" ] else r.path in
  Option.map (response r) (List.assoc_opt path page)

(* The command of a build is _build/default/bin/dolphin.exe. *)
let folder () =
  match Sys.getenv_opt "DOLPHIN_CONSOLE" with
  | Some path when path <> "" -> Some path
  | Some _ | None ->
    let up path = Filename.dirname path in
    let command = try Unix.realpath Sys.executable_name with Unix.Unix_error _ -> Sys.executable_name in
    let installed = Filename.concat (up (up command)) "share/dolphin/console" in
    let built = Filename.concat (up (up (up command))) "console" in
    List.find_opt (fun path -> Sys.file_exists (Filename.concat path "index.html")) [ installed; built ]
