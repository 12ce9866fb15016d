type body = Text of string | Stream of ((string -> unit Lwt.t) -> unit Lwt.t)
type t = { status : int; headers : (string * string) list; body : body }

let text ?(headers = []) ~kind status body =
  { status; headers = ("Content-Type", kind) :: headers; body = Text body }

let stream ?(headers = []) ~kind body =
  { status = 200; headers = ("Content-Type", kind) :: headers; body = Stream body }

let reason = function
  | 200 -> "OK"
  | 201 -> "Created"
  | 202 -> "Accepted"
  | 204 -> "No Content"
  | 303 -> "See Other"
  | 304 -> "Not Modified"
  | 400 -> "Bad Request"
  | 401 -> "Unauthorized"
  | 403 -> "Forbidden"
  | 404 -> "Not Found"
  | 405 -> "Method Not Allowed"
  | 408 -> "Request Timeout"
  | 409 -> "Conflict"
  | 413 -> "Content Too Large"
  | 415 -> "Unsupported Media Type"
  | 421 -> "Misdirected Request"
  | 422 -> "Unprocessable Content"
  | 429 -> "Too Many Requests"
  | 431 -> "Request Header Fields Too Large"
  | 500 -> "Internal Server Error"
  | 501 -> "Not Implemented"
  | 503 -> "Service Unavailable"
  | _ -> "Status"

let head ~keep r =
  let length =
    match r.body with
    | Text _ when r.status = 304 || r.status = 204 -> []
    | Text text -> [ ("Content-Length", string_of_int (String.length text)) ]
    | Stream _ -> []
  in
  let line (name, value) = name ^ ": " ^ value ^ "\r\n" in
  let headers = r.headers @ length @ [ ("Connection", if keep then "keep-alive" else "close") ] in
  Printf.sprintf "HTTP/1.1 %d %s\r\n%s\r\n" r.status (reason r.status) (String.concat "" (List.map line headers))
