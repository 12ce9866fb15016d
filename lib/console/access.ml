module Request = Dolphin_http.Request

let hosts port =
  let names = [ "127.0.0.1"; "localhost"; "[::1]" ] in
  List.map (fun name -> Printf.sprintf "%s:%d" name port) names @ if port = 80 then names else []

let is_host port text = List.mem (String.lowercase_ascii text) (hosts port)

let is_origin port text =
  List.exists (fun host -> String.lowercase_ascii text = "http://" ^ host) (hosts port)

(* Of every header at most one counts: with two, nobody knows which. *)
let header (r : Request.t) name =
  match List.filter (fun (known, _) -> known = name) r.headers with
  | [] -> `None
  | [ (_, text) ] -> `One text
  | _ -> `Many

let is_json text =
  match String.split_on_char ';' text with kind :: _ -> String.trim kind = "application/json" | [] -> false

let is_api (r : Request.t) = match r.path with "api" :: _ -> true | _ -> false

let check ~port (r : Request.t) =
  let reads = r.verb = "GET" || r.verb = "HEAD" in
  match header r "host", header r "origin", header r "sec-fetch-site", header r "content-type" with
  | `One host, _, _, _ when not (is_host port host) -> Error (421, "this console is not called so")
  | (`None | `Many), _, _, _ -> Error (400, "a request has one Host")
  | _, `Many, _, _ -> Error (403, "a request has one Origin")
  | _, `One origin, _, _ when not (is_origin port origin) -> Error (403, "this comes from the page of another")
  | _, _, `One ("cross-site" | "same-site"), _ when is_api r -> Error (403, "this comes from the page of another")
  | _, _, `Many, _ -> Error (403, "this comes from the page of another")
  | _, _, _, `One kind when (not reads) && is_json kind -> Ok ()
  | _, _, _, _ when not reads -> Error (415, "changes are sent as application/json")
  | _, _, _, _ -> Ok ()

let policy =
  "default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self' data:; connect-src 'self'; font-src 'self'; \
   base-uri 'none'; form-action 'none'; frame-ancestors 'none'"

let headers =
  [ ("Content-Security-Policy", policy); ("X-Content-Type-Options", "nosniff"); ("Referrer-Policy", "no-referrer");
    ("Cross-Origin-Opener-Policy", "same-origin"); ("Cross-Origin-Resource-Policy", "same-origin");
    ("X-Frame-Options", "DENY"); ("Cache-Control", "no-store") ]
