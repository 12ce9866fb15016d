type t = { host : string; port : int }

let scheme = "imc+udp://"
let pp ppf a = Format.fprintf ppf "%s:%d" a.host a.port
let to_service a = Format.asprintf "%s%a/" scheme pp a

let is_byte text =
  match int_of_string_opt ("0u" ^ text) with
  | Some n -> n <= 255 && String.for_all (fun c -> c >= '0' && c <= '9') text
  | None -> false

let is_host text =
  let parts = String.split_on_char '.' text in
  List.length parts = 4 && List.for_all is_byte parts

let of_service service =
  let start = String.length scheme and length = String.length service in
  if length <= start || String.sub service 0 start <> scheme then None
  else
    match String.split_on_char ':' (String.sub service start (length - start)) with
    | [ host; rest ] when is_host host -> (
        match String.split_on_char '/' rest with
        | [ port ] | [ port; "" ] -> (
            match int_of_string_opt ("0u" ^ port) with
            | Some port when port > 0 && port <= 0xFFFF -> Some { host; port }
            | Some _ | None -> None)
        | _ -> None)
    | _ -> None

let of_services services = List.filter_map of_service (String.split_on_char ';' services)
