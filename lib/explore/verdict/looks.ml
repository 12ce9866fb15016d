open Dolphin_semantics

type t = World.assumption list list

let none : t = [ [] ]
let of_transition (t : Transition.t) : t = t.assumed :: t.otherwise

let is_event (t : Transition.t) =
  match t.label with
  | Done _ | Fail _ | Time_out | Answer _ | No_answer | Resume | Reply _ | No_reply _ | Input _ | Interrupt
  | No_vehicles _ -> true
  | Start _ | Check _ | Act _ | Cut _ | Set_time _ | Make | Allocate _ | Recruit _ | Broken _ | Did _ | Silent | Pick _
  | Bind _ | Ask _ | Pause _ | Call _ | Execute | Cannot_execute _ | End | Halt _ | Fault _ -> false

(* {1 Comparisons}

   The semantics spells a comparison in one way: two operands with [<], [>], [==] or [in] between them. *)

type bound = { value : float; closed : bool }
type range = { least : bound; most : bound }

let split_at symbol text =
  let n = String.length symbol and length = String.length text in
  let rec find depth i =
    if i + n > length then None
    else if depth = 0 && String.sub text i n = symbol then
      Some (String.sub text 0 i, String.sub text (i + n) (length - i - n))
    else
      match text.[i] with
      | '(' -> find (depth + 1) (i + 1)
      | ')' -> find (depth - 1) (i + 1)
      | _ -> find depth (i + 1)
  in
  find 0 0

let from value closed = { least = { value; closed }; most = { value = infinity; closed = false } }
let upto value closed = { least = { value = neg_infinity; closed = false }; most = { value; closed } }

(* The values of an operand for which the comparison of it with [x] has this outcome, if they are in a row. *)
let range symbol x holds =
  match symbol, holds with
  | "<", true -> Some (upto x false)
  | "<", false -> Some (from x true)
  | ">", true -> Some (from x false)
  | ">", false -> Some (upto x true)
  | "==", true -> Some { least = { value = x; closed = true }; most = { value = x; closed = true } }
  | _, _ -> None

let mirrored = function "<" -> ">" | ">" -> "<" | symbol -> symbol

(* The operand that a claim compares with a number, and the values that it may have. *)
let ranged text holds =
  let with_symbol symbol =
    Option.bind (split_at (" " ^ symbol ^ " ") text) (fun (left, right) ->
        match float_of_string_opt left, float_of_string_opt right with
        | None, Some x -> Option.map (fun r -> (left, r)) (range symbol x holds)
        | Some x, None -> Option.map (fun r -> (right, r)) (range (mirrored symbol) x holds)
        | None, None | Some _, Some _ -> None)
  in
  List.find_map with_symbol [ "<"; ">"; "==" ]

let is_empty { least; most } =
  least.value > most.value || (least.value = most.value && not (least.closed && most.closed))

let common a b =
  let least =
    if a.least.value > b.least.value || (a.least.value = b.least.value && not a.least.closed) then a.least else b.least
  and most =
    if a.most.value < b.most.value || (a.most.value = b.most.value && not a.most.closed) then a.most else b.most
  in
  { least; most }

let contradict (a : World.assumption) (b : World.assumption) =
  match a, b with
  | Claim (text, holds), Claim (text', holds') when String.equal text text' -> holds <> holds'
  | Claim (text, holds), Claim (text', holds') -> (
      match ranged text holds, ranged text' holds' with
      | Some (x, r), Some (y, r') -> String.equal x y && is_empty (common r r')
      | _, _ -> false)
  | Sensed (s, v, x), Sensed (s', v', x') -> s = s' && String.equal v v' && Value.compare x x' <> 0
  | Placed (v, p), Placed (v', p') -> String.equal v v' && Dolphin_geo.Position.compare p p' <> 0
  | (Late _ | Missing _ | Sensed _ | Placed _ | Claim _), _ -> false

(* {1 Concerns} *)

type concerns = World.assumption -> bool

let is_letter c = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c = '_'
let is_digit c = c >= '0' && c <= '9'

(* The names in a text; a name does not begin with a digit. *)
let names text =
  let length = String.length text in
  let rec after is_part i = if i < length && is_part text.[i] then after is_part (i + 1) else i in
  let in_word c = is_letter c || is_digit c in
  let rec go i found =
    if i >= length then found
    else if is_digit text.[i] then go (after (fun c -> in_word c || c = '.') i) found
    else if is_letter text.[i] then
      let j = after in_word i in
      go j (String.sub text i (j - i) :: found)
    else go (i + 1) found
  in
  go 0 []

let mentions_variable (program : Core.program) text =
  List.exists (fun name -> Array.exists (String.equal name) program.global_names) (names text)

let at_one_moment program : concerns = function
  | Claim (text, _) -> not (mentions_variable program text)
  | Sensed _ | Placed _ -> true
  | Late _ | Missing _ -> false

(* Operations on a date and numbers. *)
let computing =
  [ "now"; "abs"; "round"; "intValue"; "toInteger"; "doubleValue"; "toDouble"; "Math"; "floor"; "ceil"; "min"; "max" ]

let of_date program : concerns = function
  | Claim (text, _) ->
    let found = names text in
    List.mem "now" found && List.for_all (fun name -> List.mem name computing) found
    && not (mentions_variable program text)
  | Sensed _ | Placed _ | Late _ | Missing _ -> false

(* {1 Knowledge} *)

type known = { holds : World.assumption list; fails : World.assumption list }

let nothing = { holds = []; fails = [] }
let same a b = World.compare_assumption a b = 0

let agrees known a =
  (not (List.exists (contradict a) known.holds)) && not (List.exists (same a) known.fails)

let kept (concerns : concerns) known (looks : t) =
  List.filter (List.for_all (agrees known)) (List.map (List.filter concerns) looks)

let admits concerns known looks = kept concerns known looks <> []

type outcome = Agree | Ask of known * known

(* Each look takes the first of its lists that agrees with those before. If none does, its first assumption that is
   not known decides. *)
let compare_all concerns known all =
  let is_known a = List.exists (same a) known.holds in
  let rec go found = function
    | [] -> Agree
    | looks :: rest -> (
        let lists = kept concerns known looks in
        match List.find_opt (List.for_all (agrees found)) lists with
        | Some assumed -> go { found with holds = assumed @ found.holds } rest
        | None -> (
            let undecided = List.filter (fun a -> not (is_known a)) (List.concat lists) in
            match undecided with
            | a :: _ -> Ask ({ known with holds = a :: known.holds }, { known with fails = a :: known.fails })
            | [] -> go found rest))
  in
  go known all

let rec can_agree concerns known all =
  List.for_all (admits concerns known) all
  &&
  match compare_all concerns known all with
  | Agree -> true
  | Ask (one, other) -> can_agree concerns one all || can_agree concerns other all

let agree concerns all = can_agree concerns nothing all
