module Response = Dolphin_http.Response

type t = (string list * (string * string)) list

let kinds =
  [ (".html", "text/html; charset=utf-8"); (".js", "text/javascript; charset=utf-8");
    (".css", "text/css; charset=utf-8"); (".svg", "image/svg+xml"); (".png", "image/png");
    (".txt", "text/plain; charset=utf-8"); (".json", "application/json") ]

let missing =
  "<!doctype html><meta charset=\"utf-8\"><title>Dolphin console</title><h1>The page is not built</h1>\
   <p>This server has its programming interface, which <code>docs/api.md</code> describes, and no page. \
   <code>scripts/console</code> in the sources builds the page; <code>DOLPHIN_CONSOLE</code> names the folder of one \
   that is elsewhere.</p>"

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
    | Some kind, Some text -> [ (path, (kind, text)) ]
    | _, _ -> []

let load folder =
  let files = Option.fold folder ~none:[] ~some:(fun folder -> below folder []) in
  if List.mem_assoc [ "index.html" ] files then files else [ ([ "index.html" ], ("text/html; charset=utf-8", missing)) ]

let find page path =
  let path = if path = [] then [ "index.html" ] else path in
  Option.map (fun (kind, text) -> Response.text ~kind 200 text) (List.assoc_opt path page)

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
