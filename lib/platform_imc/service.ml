open Dolphin_imc

type address = { host : Unix.inet_addr; port : int }

let pp_address ppf a = Format.fprintf ppf "%s:%d" (Unix.string_of_inet_addr a.host) a.port
let scheme = "imc+udp://"

let is_ipv4 text =
  let number part =
    part <> "" && String.length part <= 3
    && String.for_all (fun c -> c >= '0' && c <= '9') part
    && int_of_string part <= 255
  in
  match String.split_on_char '.' text with
  | [ _; _; _; _ ] as parts -> List.for_all number parts
  | _ -> false

let port_of text =
  if text <> "" && String.length text <= 5 && String.for_all (fun c -> c >= '0' && c <= '9') text then
    match int_of_string text with
    | port when port > 0 && port <= 0xFFFF -> Some port
    | _ -> None
  else None

let address service =
  let service = String.trim service in
  let skip = String.length scheme in
  if String.length service <= skip || String.sub service 0 skip <> scheme then None
  else
    let rest = String.sub service skip (String.length service - skip) in
    let authority, path =
      match String.index_opt rest '/' with
      | None -> (rest, "")
      | Some i -> (String.sub rest 0 i, String.sub rest (i + 1) (String.length rest - i - 1))
    in
    match String.split_on_char ':' authority with
    | [ host; port ] when path = "" && is_ipv4 host ->
      Option.map (fun port -> { host = Unix.inet_addr_of_string host; port }) (port_of port)
    | _ -> None

let addresses services = List.filter_map address (String.split_on_char ';' services)

let announced addresses =
  String.concat ";" (List.map (fun a -> Format.asprintf "%s%a/" scheme pp_address a) addresses)

let kind ~names : Message.System_type.t -> string = function
  | Other n as kind -> Option.value (List.assoc_opt n names) ~default:(Message.System_type.name kind)
  | (Ccu | Humansensor | Uuv | Usv | Uav | Ugv | Staticsensor | Mobilesensor | Wsn) as kind ->
    Message.System_type.name kind

let is_vehicle : Message.System_type.t -> bool = function
  | Uuv | Usv | Uav | Ugv | Other _ -> true
  | Ccu | Humansensor | Staticsensor | Mobilesensor | Wsn -> false
