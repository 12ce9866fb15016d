type t = Yojson.Safe.t

let int n = `Int n
let int64 n = `Intlit (Int64.to_string n)

let float x =
  match Float.classify_float x with
  | FP_nan -> `String "NaN"
  | FP_infinite -> `String (if x > 0. then "Infinity" else "-Infinity")
  | FP_zero | FP_normal | FP_subnormal -> `Float x

let text s = `String (Dolphin_utf8.Utf8.repaired s)

let raw s =
  let hex c = Printf.sprintf "%02x" (Char.code c) in
  `String (String.concat "" (List.map hex (List.of_seq (String.to_seq s))))

let inline show = function None -> `Null | Some m -> show m
let list show ms = `List (List.map show ms)
let message name fields = `Assoc (("abbrev", `String name) :: fields)
