module Request = Dolphin_http.Request

type role = Operators.role = Watches | Answers | Steers
type t = { port : int; tls : bool; operators : Operators.operator list; proxy_header : string option }

(* {1 Tokens} *)

(* Not letter by letter: the time that it takes must not depend on the token. *)
let same a b = Digest.string a = Digest.string b
let operator_of a text = List.find_opt (fun (o : Operators.operator) -> same text o.token) a.operators
let role_of a text = Option.map (fun (o : Operators.operator) -> o.role) (operator_of a text)
let has_tokens a = a.operators <> []

let cookie port = Printf.sprintf "dolphin-%d" port

let cookies text =
  let pair text =
    match String.index_opt text '=' with
    | Some i -> Some (String.trim (String.sub text 0 i), String.sub text (i + 1) (String.length text - i - 1))
    | None -> None
  in
  List.filter_map pair (String.split_on_char ';' text)

(* {1 Names of this console} *)

let is_address text =
  let n = String.length text in
  let bare = if n > 2 && text.[0] = '[' && text.[n - 1] = ']' then String.sub text 1 (n - 2) else text in
  match Unix.inet_addr_of_string bare with _ -> true | exception Failure _ -> false

(* As one writes it: OCaml reads 0x50 and 8_0, too. *)
let port_of text =
  if text <> "" && String.length text <= 5 && String.for_all (fun c -> c >= '0' && c <= '9') text then
    int_of_string_opt text
  else None

let scheme a = if a.tls then "https" else "http"

let split_port a text =
  match String.rindex_opt text ':' with
  | Some i when text.[String.length text - 1] <> ']' ->
    (String.sub text 0 i, port_of (String.sub text (i + 1) (String.length text - i - 1)))
  | Some _ | None -> (text, Some (if a.tls then 443 else 80))

(* On the loopback address its names alone: others may have been bound to it. Elsewhere there are tokens, and any
   address may be that of this machine. *)
let is_host a text =
  let name, port = split_port a (String.lowercase_ascii text) in
  let loopback = List.mem name [ "127.0.0.1"; "localhost"; "[::1]" ] in
  let named () = is_address name || name = String.lowercase_ascii (Unix.gethostname ()) in
  (* Behind a proxy the name is the proxy's. *)
  a.proxy_header <> None || (port = Some a.port && (loopback || (has_tokens a && named ())))

(* A proxy has TLS of its own. *)
let is_origin a ~host text =
  let schemes = if a.proxy_header = None then [ scheme a ] else [ "http"; "https" ] in
  List.mem (String.lowercase_ascii text) (List.map (fun s -> s ^ "://" ^ String.lowercase_ascii host) schemes)

(* Two headers of one name are ambiguous. *)
let header (r : Request.t) name =
  match List.filter (fun (known, _) -> known = name) r.headers with
  | [] -> `None
  | [ (_, text) ] -> `One text
  | _ -> `Many

let is_json text =
  match String.split_on_char ';' text with kind :: _ -> String.trim kind = "application/json" | [] -> false

let is_api (r : Request.t) = match r.path with "api" :: _ -> true | _ -> false

let meant a (r : Request.t) =
  let reads = r.verb = "GET" || r.verb = "HEAD" in
  match header r "host", header r "origin", header r "sec-fetch-site", header r "content-type" with
  | `One host, _, _, _ when not (is_host a host) -> Error (421, "this console is not called so")
  | (`None | `Many), _, _, _ -> Error (400, "a request has one Host")
  | _, `Many, _, _ -> Error (403, "a request has one Origin")
  | `One host, `One origin, _, _ when not (is_origin a ~host origin) ->
    Error (403, "this comes from the page of another")
  | _, _, `One ("cross-site" | "same-site"), _ when is_api r -> Error (403, "this comes from the page of another")
  | _, _, `Many, _ -> Error (403, "this comes from the page of another")
  | _, _, _, `One kind when (not reads) && is_json kind -> Ok ()
  | _, _, _, _ when not reads -> Error (415, "changes are sent as application/json")
  | _, _, _, _ -> Ok ()

let bearer text =
  match String.split_on_char ' ' text with
  | [ kind; token ] when String.lowercase_ascii kind = "bearer" -> Some token
  | _ -> None

let told a r =
  match header r "authorization", header r "cookie" with
  | `One text, _ -> bearer text
  | `None, `One text -> List.assoc_opt (cookie a.port) (cookies text)
  | (`None | `Many), _ -> None

let sender a r =
  match a.proxy_header with
  | None -> Option.bind (told a r) (operator_of a)
  | Some name -> (
      match header r name with
      | `One user -> List.find_opt (fun (o : Operators.operator) -> o.name = Some user) a.operators
      | `None | `Many -> None)

let role a (r : Request.t) =
  if not (has_tokens a) then Ok Steers
  else if not (is_api r) then Ok Watches
  else
    let none =
      if a.proxy_header = None then "this console is opened by the link that it printed when it began"
      else "the proxy does not name an operator of this console"
    in
    Option.to_result ~none:(401, none) (Option.map (fun (o : Operators.operator) -> o.role) (sender a r))

let check a r = Result.bind (meant a r) (fun () -> role a r)

let operator a r = Option.bind (sender a r) (fun (o : Operators.operator) -> o.name)

let rank a (r : Request.t) : Dolphin_http.Server.rank =
  let shown () =
    match told a r, Request.parameter r "token", r.path with
    | None, Some text, [] when a.proxy_header = None -> role_of a text
    | _, _, _ -> Option.map (fun (o : Operators.operator) -> o.role) (sender a r)
  in
  match meant a r with
  | Error _ -> Unknown
  | Ok () when not (has_tokens a) -> Trusted
  | Ok () -> (
      match shown () with Some (Steers | Answers) -> Trusted | Some Watches -> Guest | None -> Unknown)

let enter a (r : Request.t) =
  match r.path, Request.parameter r "token" with
  | [], Some text when a.proxy_header = None && role_of a text <> None ->
    let secure = if a.tls then "; Secure" else "" in
    Some [ ("Location", "/");
           ("Set-Cookie", Printf.sprintf "%s=%s; Path=/; HttpOnly; SameSite=Strict%s" (cookie a.port) text secure) ]
  | _, _ -> None

let without a name =
  { a with operators = List.filter (fun (o : Operators.operator) -> o.name <> Some name) a.operators }

let check_proxy_header text =
  let name = String.lowercase_ascii text in
  let is_good c = match c with 'a' .. 'z' | '0' .. '9' | '-' -> true | _ -> false in
  let n = String.length name in
  if n > 2 && n <= 64 && String.sub name 0 2 = "x-" && String.for_all is_good name && name <> "x-dolphin-client" then
    Ok name
  else Error (Printf.sprintf "'%s' is not a header such as X-Forwarded-User" (String.escaped text))

let is_loopback address =
  let text = Unix.string_of_inet_addr address in
  text = "::1" || (String.length text > 4 && String.sub text 0 4 = "127." && not (String.contains text ':'))

(* {1 Replies} *)

(* [https://tile.example] of [https://tile.example/{z}/{x}/{y}.png]. *)
let origin url =
  match String.split_on_char '/' url with
  | scheme :: "" :: host :: _ when host <> "" -> scheme ^ "//" ^ host
  | _ -> ""

let policy tiles =
  let images = Option.fold tiles ~none:"" ~some:(fun url -> " " ^ origin url) in
  "default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self' data:" ^ images
  ^ "; connect-src 'self'; font-src 'self'; base-uri 'none'; form-action 'none'; frame-ancestors 'none'"

let is_plain c =
  match c with 'a' .. 'z' | 'A' .. 'Z' | '0' .. '9' | '.' | '-' | ':' | '/' -> true | _ -> false

let check_tiles url =
  let has part =
    let n = String.length part in
    let rec from i = i + n <= String.length url && (String.sub url i n = part || from (i + 1)) in
    from 0
  in
  match String.split_on_char ':' (origin url) with
  | ("http" | "https") :: _ when not (String.for_all is_plain (origin url)) ->
    Error (url ^ " is not an address of tiles")
  | ("http" | "https") :: _ when List.for_all has [ "{z}"; "{x}"; "{y}" ] -> Ok url
  | _ -> Error (url ^ " is not an address of tiles, such as https://tile.example/{z}/{x}/{y}.png")

let headers ~tiles =
  [ ("Content-Security-Policy", policy tiles); ("X-Content-Type-Options", "nosniff");
    ("Referrer-Policy", "no-referrer");
    ("Cross-Origin-Opener-Policy", "same-origin"); ("Cross-Origin-Resource-Policy", "same-origin");
    ("X-Frame-Options", "DENY"); ("Cache-Control", "no-store") ]
