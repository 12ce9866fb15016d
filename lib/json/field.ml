open Dolphin_results

type members = (string * Yojson.Safe.t) list

let ( let* ) = Result.bind

let within name read json = Result.map_error (fun why -> Printf.sprintf "%S is %s" name why) (read json)

(* Journals of long runs have millions of members: names are compared as strings, not as any values. *)
let rec find name = function
  | [] -> None
  | (name', json) :: rest -> if String.equal name name' then Some json else find name rest

let get read name members =
  match find name members with
  | Some json -> within name read json
  | None -> Error (Printf.sprintf "%S is missing" name)

let optional read ~default name members =
  match find name members with Some json -> within name read json | None -> Ok default

let wrong json what = Error (Printf.sprintf "%s, not %s" (Canonical.shortened 40 json) what)
let text : Yojson.Safe.t -> _ = function `String text -> Ok text | json -> wrong json "a text"

let number : Yojson.Safe.t -> _ = function
  | `Int i -> Ok (float_of_int i)
  | `Float x when Float.is_finite x -> Ok x
  | json -> wrong json "a number"

let whole : Yojson.Safe.t -> _ = function `Int i -> Ok i | json -> wrong json "a whole number"
let truth : Yojson.Safe.t -> _ = function `Bool b -> Ok b | json -> wrong json "true or false"
let members : Yojson.Safe.t -> _ = function `Assoc members -> Ok members | json -> wrong json "an object"

let list read : Yojson.Safe.t -> _ = function
  | `List items -> Results.map read items
  | json -> wrong json "a list"

let nullable read : Yojson.Safe.t -> _ = function `Null -> Ok None | json -> Result.map Option.some (read json)
let any json = Ok json
let texts xs : Yojson.Safe.t = `List (List.map (fun text -> `String text) xs)
let unless_empty name write = function [] -> [] | xs -> [ (name, write xs) ]
let of_option write : _ -> Yojson.Safe.t = function None -> `Null | Some x -> write x
