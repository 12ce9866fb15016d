type violation = Invariant of string | Property of string | Temporal | Deadlock | Unnamed

type t =
  | Version of string
  | Begins of string
  | Initial_states of int
  | Progress of { depth : int; generated : int; distinct : int; queue : int }
  | Checks_temporal of int
  | Violation of violation
  | Behaviour
  | State of { number : int; action : string option; text : string }
  | Stutters
  | Returns_to of int
  | Holds
  | Totals of { generated : int; distinct : int; queue : int }
  | Depth of int
  | Printed of string
  | Worker of string
  | Assertion of string
  | Trouble of string
  | Warning of string
  | Other

(* {1 Words} *)

(* The index of [part] in [text]. *)
let find part text =
  let n = String.length part in
  let rec go i =
    if i + n > String.length text then None else if String.sub text i n = part then Some i else go (i + 1)
  in
  go 0

let from i text = String.sub text i (String.length text - i)
let after part text = Option.map (fun i -> from (i + String.length part) text) (find part text)
let before part text = Option.map (fun i -> String.sub text 0 i) (find part text)
let is_of_number = function '0' .. '9' | ',' -> true | _ -> false

(* TLC groups digits by commas. *)
let number digits = int_of_string_opt (String.concat "" (String.split_on_char ',' digits))

let leading_number text =
  let rec length i = if i < String.length text && is_of_number text.[i] then length (i + 1) else i in
  number (String.sub text 0 (length 0))

(* The number at the end of the text before [part]. *)
let number_before part text =
  let last_number text =
    let n = String.length text in
    let rec start i = if i > 0 && is_of_number text.[i - 1] then start (i - 1) else i in
    number (from (start n) text)
  in
  Option.bind (before part text) last_number

let number_after part text = Option.bind (after part text) leading_number
let first_line text = match String.index_opt text '\n' with Some i -> String.sub text 0 i | None -> text

(* {1 Messages} *)

let counts make text =
  let counted what = number_before (" states " ^ what) text in
  match counted "generated", number_before " distinct states found" text, counted "left on queue" with
  | Some generated, Some distinct, Some queue -> make generated distinct queue
  | _, _, _ -> Other

let progress text =
  match number_after "Progress(" text with
  | Some depth -> counts (fun generated distinct queue -> Progress { depth; generated; distinct; queue }) text
  | None -> Other

let totals = counts (fun generated distinct queue -> Totals { generated; distinct; queue })

let initial_states text =
  match number_after "with " text, number_before " distinct state" text with
  | Some n, _ | None, Some n -> Initial_states n
  | None, None -> Other

(* ["Invariant Safe is violated."] *)
let named text =
  match String.split_on_char ' ' (first_line text) with
  | ("Invariant" | "Property") :: name :: _ -> name
  | "Action" :: "property" :: name :: _ -> name
  | _ -> first_line text

(* ["The first argument of Assert evaluated to FALSE; the second argument was:\n\"too large\""]. *)
let assertion text =
  let said = Option.value (after "\n" text) ~default:"" in
  Assertion (Option.value (Quoted.unescape said) ~default:said)

(* ["<Inc line 5, col 11 to line 5, col 78 of module M>"], ["<Initial predicate>"]. *)
let action text = Option.bind (after "<" text) (before " line ")

let state text =
  match leading_number text, String.index_opt text '\n' with
  | Some number, Some i ->
    State { number; action = action (String.sub text 0 i); text = String.trim (from (i + 1) text) }
  | Some number, None -> State { number; action = action text; text = "" }
  | None, _ -> Other

let returns_to text = match leading_number text with Some n -> Returns_to n | None -> Other

let of_numbered make = function Some n -> make n | None -> Other

let of_code code (severity : Message.severity) text =
  match code with
  | 2262 -> Version (String.trim text)
  | 2187 -> Begins (String.trim text)
  | 2190 | 2191 | 2207 | 2208 -> initial_states text
  | 2200 -> progress text
  | 2199 -> totals text
  | 2192 -> of_numbered (fun n -> Checks_temporal n) (number_before " total distinct states" text)
  | 2194 -> of_numbered (fun n -> Depth n) (number_after "search is " text)
  | 2193 -> Holds
  | 2107 | 2110 -> Violation (Invariant (named text))
  | 2108 | 2112 -> Violation (Property (named text))
  | 2114 -> Violation Deadlock
  | 2116 -> Violation Temporal
  | 2132 -> assertion text
  | 2217 -> state text
  | 2218 -> Stutters
  | 2122 -> returns_to text
  | 2121 | 2264 -> Behaviour
  | 2401 -> Other  (* advice on Java's garbage collector *)
  | 7000 | 7001 | 7002 | 7003 | 7006 | 7008 | 7009 | 7010 -> Worker (String.trim text)
  | _ -> (
      match severity with
      | Error | Bug_of_tlc -> Trouble (String.trim text)
      | Warning -> Warning (String.trim text)
      | Information | State -> Other)

let of_message : Message.t -> t = function
  | Line text when find "TLC2 TLC Server Version" text = Some 0 -> Version text
  | Line text -> Printed text
  | Message { code; severity; text } -> of_code code severity text

let variable x text =
  let prefix = Printf.sprintf "/\\ %s = " x in
  let value line =
    let n = String.length prefix in
    if String.length line >= n && String.sub line 0 n = prefix then Some (from n line) else None
  in
  List.find_map value (String.split_on_char '\n' text)
