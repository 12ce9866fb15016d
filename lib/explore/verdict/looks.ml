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

(* {1 Concerns} *)

type concerns = World.assumption -> bool

let is_letter c = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c = '_'
let is_digit c = c >= '0' && c <= '9'

(* The sensors that take a vehicle. *)
let of_vehicle = [ "battery"; "position"; "speed"; "connected"; "progress"; "reading" ]

(* The names in a text; a name does not begin with a digit. The vehicle and the quantity of a sensor are not among
   them, though a variable may have the name of a vehicle. *)
let names text =
  let length = String.length text in
  let rec after is_part i = if i < length && is_part text.[i] then after is_part (i + 1) else i in
  let in_word c = is_letter c || is_digit c in
  let rec go i found =
    if i >= length then found
    else if is_digit text.[i] then go (after (fun c -> in_word c || c = '.') i) found
    else if is_letter text.[i] then
      let j = after in_word i in
      let name = String.sub text i (j - i) in
      let is_sensor = List.mem name of_vehicle && j < length && text.[j] = '(' in
      go (if is_sensor then after (fun c -> c <> ')') j else j) (name :: found)
    else go (i + 1) found
  in
  go 0 []

let mentions_variable (program : Core.program) text =
  List.exists (fun name -> Array.exists (String.equal name) program.global_names) (names text)

let at_one_moment program : concerns = function
  | Claim (text, _) -> not (mentions_variable program text || List.mem "progress" (names text))
  | Sensed (Progress, _, _) -> false
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

(* {1 Readings} *)

let pp_reading ppf (a : World.assumption) =
  match a with
  | Claim (text, true) -> Format.pp_print_string ppf text
  | Claim (text, false) -> Format.pp_print_string ppf (Sensor_comparison.negated text)
  | Sensed _ | Placed _ | Late _ | Missing _ -> World.pp_assumption ppf a

let pp_readings ppf readings = Fmt.(list ~sep:(any " or ") pp_reading) ppf readings

(* {1 Knowledge} *)

type known = { holds : World.assumption list; fails : World.assumption list }

let nothing = { holds = []; fails = [] }
let same a b = World.compare_assumption a b = 0

let agrees known a =
  (not (List.exists (World.contradict a) known.holds)) && not (List.exists (same a) known.fails)

let kept (concerns : concerns) known (looks : t) =
  List.filter (List.for_all (agrees known)) (List.map (List.filter concerns) looks)

let admits concerns known looks = kept concerns known looks <> []

(* {2 Moments} *)

module Assumptions = Set.Make (struct
    type t = World.assumption

    let compare = World.compare_assumption
  end)

type moment = World.assumption list

let compare_moments = List.compare World.compare_assumption
let beginning : moment = []

(* What is known by some of the ways, but by no other that knows less. *)
let after concerns (moment : moment) looks : moment list =
  let lists = kept concerns { nothing with holds = moment } looks in
  let ways = List.map (fun assumed -> Assumptions.of_list (assumed @ moment)) lists in
  let knows_less a b = Assumptions.subset a b && not (Assumptions.equal a b) in
  let least = List.filter (fun way -> not (List.exists (fun other -> knows_less other way) ways)) ways in
  List.map Assumptions.elements (List.sort_uniq Assumptions.compare least)

let contested concerns all : concerns =
  let found = Assumptions.of_list (List.concat_map (fun looks -> List.filter concerns (List.concat looks)) all) in
  let is_contested a = Assumptions.exists (World.contradict a) found in
  let contested = Assumptions.filter is_contested found in
  fun a -> Assumptions.mem a contested

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

(* {1 Readings that are looked for} *)

let readings (concerns : concerns) (looks : t) =
  List.sort_uniq World.compare_assumption (List.filter concerns (List.concat looks))

let split_at_any symbol text =
  let n = String.length symbol and length = String.length text in
  let rec find i =
    if i + n > length then None
    else if String.sub text i n = symbol then Some (String.sub text 0 i, String.sub text (i + n) (length - i - n))
    else find (i + 1)
  in
  find 0

(* The sensors in a text, as {!World.spell} has them. *)
let rec sensors_in text =
  let opening name = Option.map (fun (_, rest) -> (name, rest)) (split_at_any (name ^ "(") text) in
  List.concat_map
    (fun (name, rest) ->
       match String.index_opt rest ')' with
       | Some i ->
         let after = String.sub rest (i + 1) (String.length rest - i - 1) in
         Printf.sprintf "%s(%s)" name (String.sub rest 0 i) :: sensors_in after
       | None -> [])
    (List.filter_map opening ("now" :: "timeOfDay" :: of_vehicle))

let sensors : World.assumption -> string list = function
  | Claim (text, _) -> ( match sensors_in text with [] -> [ text ] | found -> found)
  | Sensed (s, v, _) -> [ World.spell s v ]
  | Placed (v, _) -> [ Printf.sprintf "position(%s)" v ]
  | Late _ | Missing _ -> []

let are_at concerns wanted looks =
  let wanted = List.concat_map sensors wanted in
  List.exists (fun a -> List.exists (fun s -> List.mem s wanted) (sensors a)) (readings concerns looks)

let is_look concerns (looks : t) = List.for_all (List.exists concerns) looks && looks <> []
let may_show concerns readings looks = agree concerns [ List.map (fun a -> [ a ]) readings; looks ]

let may_repeat program ~assumed cycle =
  let all = List.map of_transition cycle in
  let at_one_moment = at_one_moment program in
  let is_met readings =
    List.for_all (may_show at_one_moment readings) all
    || List.exists (fun looks -> are_at at_one_moment readings looks && may_show at_one_moment readings looks) all
  in
  agree (of_date program) all
  && (List.exists is_event cycle || agree at_one_moment all)
  && List.for_all is_met assumed
