module Safe_print = Dolphin_display.Safe_print

module Parameters = Dolphin_syntax.Parameters
module Text_table = Dolphin_display.Text_table

type t = { parameter : string; values : int list; load : int -> (Program_file.t, Error.t) result }
type question = One of Program_file.t | Several of t
type verdict = Dolphin_checker.Verdict.t = Holds | Violated | Inconclusive
type 'a row = { value : int; program : Program_file.t; found : 'a; verdict : verdict }
type 'a fewest = { row : 'a row; below : 'a row option; is_least : bool }

let ( let* ) = Result.bind

(* {1 Questions} *)

(* A text such as [1..8] is a range only for a parameter that is a whole number. *)
let may_be_range (_, text) =
  match Dolphin_syntax.Parse.expression ~file:"--set" text with Ok { it = Range _; _ } -> true | Ok _ | Error _ -> false

let question ~set path =
  let maybe, others = List.partition may_be_range set in
  let one () = Result.map (fun p -> One p) (Program_file.load ~set path) in
  if maybe = [] then one ()
  else
    let* program = Program_file.load ~set:others path in
    let range (x, text) =
      let of_parameter (p : Parameters.t) = if p.name = x then Parameters.range p text else None in
      Option.map (fun values -> (x, values)) (List.find_map of_parameter program.parameters)
    in
    match List.filter_map range maybe with
    | [] -> one ()
    | [ (parameter, values) ] ->
      let fixed = List.filter (fun (x, _) -> x <> parameter) set in
      let load n = Program_file.load ~set:(fixed @ [ (parameter, string_of_int n) ]) path in
      Ok (Several { parameter; values; load })
    | (x, _) :: (y, _) :: _ ->
      Error (Error.Bad_input (Printf.sprintf "only one parameter may have a range of values, not both %s and %s" x y))

let within fleet = function
  | One program -> Result.map (fun p -> One p) (Program_file.within fleet program)
  | Several s -> Ok (Several { s with load = (fun n -> Result.bind (s.load n) (Program_file.within fleet)) })

let rows s ~interrupted ask =
  let rec ask_each found = function
    | value :: rest when not (interrupted ()) ->
      let* program = s.load value in
      let* answer, verdict = ask program in
      ask_each ({ value; program; found = answer; verdict } :: found) rest
    | _ -> Ok (List.rev found)
  in
  ask_each [] s.values

(* {1 Answers} *)

let fewest rows =
  let by_value = List.sort (fun a b -> compare a.value b.value) rows in
  let rec find below = function
    | ({ verdict = Holds; _ } as row) :: _ ->
      let is_least = List.for_all (fun r -> r.verdict = Violated) below in
      Some { row; below = (match below with r :: _ -> Some r | [] -> None); is_least }
    | row :: rest -> find (row :: below) rest
    | [] -> None
  in
  find [] by_value

let verdict rows =
  match fewest rows with
  | Some { is_least; _ } -> if is_least then Holds else Inconclusive
  | None -> if List.for_all (fun r -> r.verdict = Violated) rows then Violated else Inconclusive

(* {1 Output} *)

let name s row = Printf.sprintf "%s=%d" s.parameter row.value

let print s ~heads cells rows =
  let line row = string_of_int row.value :: cells row in
  let columns = Run_columns.columns () in
  List.iter Safe_print.line (Text_table.lines ?columns (s.parameter :: heads) (List.map line rows));
  if List.length rows < List.length s.values then Safe_print.line "interrupted: the other values were not asked for";
  match fewest rows with
  | Some { row; is_least = true; _ } -> Safe_print.printf "fewest: %s\n" (name s row)
  | Some { row; is_least = false; _ } -> Safe_print.printf "fewest: %s, or one that is inconclusive\n" (name s row)
  | None when verdict rows = Violated -> Safe_print.line "fewest: none of them"
  | None -> Safe_print.line "fewest: none of which it is known"

let to_json s json rows : Yojson.Safe.t =
  let row r =
    let verdict = Dolphin_checker.Verdict.name r.verdict in
    `Assoc [ ("value", `Int r.value); ("verdict", `String verdict); ("found", json r) ] in
  let least =
    match fewest rows with
    | Some { row; is_least; _ } -> [ ("fewest", `Int row.value); ("least", `Bool is_least) ]
    | None -> [ ("fewest", `Null) ]
  in
  `Assoc ((("parameter", `String s.parameter) :: least) @ [ ("values", `List (List.map row rows)) ])
