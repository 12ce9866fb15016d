type json = Yojson.Safe.t

exception Wrong of string
exception Too_large

type budget = { mutable parts : int; mutable depth : int }

let most_parts = 500_000

(* Some parts are lists in lists: half of the size that [Oracle] reads. *)
let deepest = 5_000

let budget () = { parts = most_parts; depth = deepest }

let part left write =
  left.parts <- left.parts - 1;
  if left.parts < 0 || left.depth = 0 then raise Too_large;
  left.depth <- left.depth - 1;
  let json = write () in
  left.depth <- left.depth + 1;
  json

let wrong what json = raise (Wrong (Printf.sprintf "%s is not %s" (Dolphin_json.Canonical.shortened 40 json) what))
let tagged name parts : json = `List (`String name :: parts)
let whole : json -> int = function `Int i -> i | json -> wrong "a whole number" json
let text : json -> string = function `String text -> text | json -> wrong "a text" json
let truth : json -> bool = function `Bool b -> b | json -> wrong "true or false" json
let list read : json -> _ = function `List items -> List.map read items | json -> wrong "a list" json

let pair first second : json -> _ = function
  | `List [ a; b ] ->
    let a = first a in
    (a, second b)
  | json -> wrong "a pair" json

let of_list write xs : json = `List (List.map write xs)
let of_pair first second (a, b) : json = `List [ first a; second b ]
let of_option write : _ -> json = function None -> `Null | Some x -> write x
let option read : json -> _ = function `Null -> None | json -> Some (read json)

let of_float x : json =
  if Float.is_finite x then `Float x
  else `String (if Float.is_nan x then "nan" else if x > 0. then "inf" else "-inf")

let float : json -> float = function
  | `Float x -> x
  | `Int i -> float_of_int i
  | `String "nan" -> Float.nan
  | `String "inf" -> infinity
  | `String "-inf" -> neg_infinity
  | json -> wrong "a number" json
