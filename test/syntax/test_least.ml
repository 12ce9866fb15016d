(* Random tasks, printed with no parentheses but those that the table of precedence in docs/language.md calls for, and
   read again. The printer here shares nothing with [Print]: it chooses between prefix and postfix forms, and between
   one line and several. *)

open Dolphin_syntax
open Ast

type task =
  | Name of string
  | Operator of binary * task * task
  | Limit of { postfix : bool; newline : bool; limit : limit; body : task }
  | Wait of task
  | Watched of task
  | Rounds of { counted : bool; asked : bool; body : task }

and limit = Time of on_cut * string | Condition of on_cut * string

(* {1 The tree that is meant} *)

let bare it = { it; at = Location.none }
let variable x = bare (Variable x)
let code x = { parameters = None; body = [ bare (Expression (variable x)) ] }

let duration = function
  | "5.min" -> bare (Member { subject = bare (Integer 5); name = bare "min"; safe = false })
  | "(2 * n)" -> bare (Binary (Multiply, bare (Integer 2), variable "n"))
  | name -> variable name

let rec tree = function
  | Name x -> variable x
  | Operator (o, a, b) -> bare (Binary (o, tree a, tree b))
  | Limit { limit = Time (on_cut, d); body; _ } -> bare (During (on_cut, duration d, tree body))
  | Limit { limit = Condition (on_cut, c); body; _ } -> bare (Until (on_cut, code c, tree body))
  | Wait t -> bare (Wait_for (code "c", tree t))
  | Watched t -> bare (Watch (tree t, code "e"))
  | Rounds { counted; asked; body } ->
    let rounds = if counted then Some (bare (Integer 3)) else None in
    bare (Repeat { rounds; body = tree body; until = (if asked then Some (code "u") else None) })

(* {1 Its text} *)

(* Rows of the table, from the loosest. *)
let row = function Parallel -> 1 | Intersect -> 2 | _ -> 3
let symbol = function Parallel -> " | " | Intersect -> " & " | _ -> " >> "
let limited = 4

(* [last]: nothing but the end of the enclosing construct follows. [in_rounds]: an [until] behind it would be that of a
   [repeat]. [until_follows]: one does. *)
type place = { level : int; last : bool; in_rounds : bool; until_follows : bool }

let enclosed = { level = 0; last = true; in_rounds = false; until_follows = false }

let words = function
  | Time (Completes, d) -> ("during", d)
  | Time (Fails, d) -> ("within", d)
  | Condition (Completes, c) -> ("until", "{ " ^ c ^ " }")
  | Condition (Fails, c) -> ("assure", "{ " ^ c ^ " }")

(* Whether the limit stands behind its task. *)
let is_behind place ~postfix limit =
  postfix && not (place.in_rounds && match limit with Condition (Completes, _) -> true | _ -> false)

(* A [repeat] with its [until], and limits of all its rounds: no operator follows it. *)
let rec is_closed place = function
  | Rounds { asked; _ } -> asked
  | Limit { postfix; limit; body; _ } -> is_behind place ~postfix limit && is_closed place body
  | _ -> false

let rec text place task =
  let if_fits fits bare = if fits then bare place else "(" ^ bare enclosed ^ ")" in
  let open_ended head body = if_fits place.last (fun place -> head ^ text { place with level = 0 } body) in
  match task with
  | Name x -> x
  | Operator (o, a, b) ->
    let row = row o in
    let both place =
      text { place with level = row; last = false; until_follows = false } a
      ^ symbol o ^ text { place with level = row + 1 } b in
    if_fits (row >= place.level) both
  | Limit { postfix; newline; limit; body } ->
    let word, what = words limit in
    if is_behind place ~postfix limit then
      text { place with level = limited; last = place.last && is_closed place body; until_follows = false } body
      ^ (if newline then "\n  " else " ") ^ word ^ " " ^ what
    else open_ended (Printf.sprintf "%s %s run " word what) body
  | Wait t -> open_ended "waitFor { c } then " t
  | Watched t -> "watch " ^ text enclosed t ^ " onError { e }"
  | Rounds { counted; asked; body } ->
    let rounds _ =
      let inside = { level = 0; last = true; in_rounds = true; until_follows = asked } in
      "repeat " ^ (if counted then "3, " else "") ^ text inside body ^ if asked then " until { u }" else "" in
    if_fits (place.last && (asked || not place.until_follows)) rounds

let statement task = "x = " ^ text enclosed task ^ "\ny"

(* {1 The laws} *)

let read source =
  match Parse.program ~file:"task.dol" source with
  | Ok program -> Some (Erase.program program)
  | Error _ -> None

let meant task =
  [ bare (Assign { target = variable "x"; operator = None; value = tree task }); bare (Expression (variable "y")) ]

let is_read_as_meant task = read (statement task) = Some (meant task)

(* The places of parentheses around tasks. *)
let parentheses source =
  let rec go i openers found =
    if i = String.length source then found
    else
      match source.[i] with
      | '(' -> go (i + 1) (i :: openers) found
      | ')' -> go (i + 1) (List.tl openers) ((List.hd openers, i) :: found)
      | _ -> go (i + 1) openers found
  in
  List.filter (fun (first, _) -> source.[first + 1] <> '2') (go 0 [] [])

let none_is_superfluous task =
  let source = statement task in
  let without (first, last) = String.mapi (fun i c -> if i = first || i = last then ' ' else c) source in
  List.for_all (fun pair -> read (without pair) <> Some (meant task)) (parentheses source)

let rec task fuel =
  let open QCheck2.Gen in
  let name = map (fun x -> Name x) (oneofl [ "a"; "b"; "t" ]) in
  if fuel <= 0 then name
  else
    let t = task (fuel / 2) in
    let on_cut = oneofl [ Completes; Fails ] in
    let limit durations c =
      oneof [ map2 (fun e d -> Time (e, d)) on_cut (oneofl durations); map (fun e -> Condition (e, c)) on_cut ] in
    (* Where prefix and postfix have the same limit, their order does not matter. *)
    let limited =
      let prefix = map2 (fun limit body -> Limit { postfix = false; newline = false; limit; body }) (limit [ "m" ] "p") t in
      let behind newline limit body = Limit { postfix = true; newline; limit; body } in
      oneof [ prefix; map3 behind bool (limit [ "5.min"; "d"; "(2 * n)" ] "c") t ] in
    frequency
      [ (1, name); (5, map3 (fun o a b -> Operator (o, a, b)) (oneofl [ Parallel; Sequence; Intersect ]) t t);
        (5, limited);
        (1, map (fun t -> Wait t) t); (1, map (fun t -> Watched t) t);
        (2, map3 (fun counted asked body -> Rounds { counted; asked; body }) bool bool t) ]

let tasks = QCheck2.Gen.(sized_size (int_bound 30) task)

let suite =
  [ Test_support.Property.case "least parentheses are read as meant" ~count:3000 tasks ~print:statement is_read_as_meant;
    Test_support.Property.case "none of them is superfluous" ~count:1000 tasks ~print:statement none_is_superfluous ]
