open Dolphin_plans
open Core
module Position = Dolphin_geo.Position
module Area = Dolphin_geo.Area

type t = value

(* Comparison by cases of one type: first the kind's rank, then what it holds. *)

let rank = function
  | Null -> 0 | Boolean _ -> 1 | Integer _ -> 2 | Number _ -> 3 | String _ -> 4 | Wildcard -> 5 | Symbol _ -> 6
  | List _ -> 7 | Map _ -> 8 | Range _ -> 9 | Position _ -> 10 | Area _ -> 11 | Vehicles _ -> 12 | Task _ -> 13
  | Closure _ -> 14 | Host _ -> 15 | Settings _ -> 16 | Reading _ -> 17 | Unknown _ -> 18

let rank_task = function
  | Platform _ -> 0 | Action _ -> 1 | Condition _ -> 2 | Sequence _ -> 3 | Parallel _ -> 4 | Allocated _ -> 5
  | All_of _ -> 6 | One_of _ -> 7 | Until _ -> 8 | Idle _ -> 9 | During _ -> 10 | Watch _ -> 11
  | Repeat _ -> 12 | Made _ -> 13 | Confirm _ -> 14 | Recruit _ -> 15 | Fresh _ -> 16
  | Ensure _ -> 17

(* Two values may hold their parts many times over. Pairs of parts that took long to compare, and are equal, are
   remembered: this number of the latest. *)
let long = 1_000
let remembered = 16

(* Two things to compare, as data: what is left to compare is a list of these, so that no depth takes stack. *)
type pair =
  | Settled of int
  | Values of value * value
  | Items of value Vector.t * value Vector.t * int  (* as long as each other; from this index on *)
  | Tasks of task * task
  | Code of closure * closure
  | Both of pair * pair
  | Several of pair Seq.t
  | Equal_since of int * pair                       (* this pair is equal, and its comparison began at this step *)

type memory = { mutable steps : int; mutable values : (value * value) list; mutable tasks : (task * task) list }

let memory () = { steps = 0; values = []; tasks = [] }

let is_known known x y = List.exists (fun (x', y') -> x == x' && y == y') known
let latest pair known = pair :: List.filteri (fun i _ -> i < remembered - 1) known

let remember m before pair =
  if m.steps - before > long then
    match pair with
    | Values (x, y) -> m.values <- latest (x, y) m.values
    | Tasks (t, t') -> m.tasks <- latest (t, t') m.tasks
    | Settled _ | Items _ | Code _ | Both _ | Several _ | Equal_since _ -> ()

let compare_on_cut e e' =
  match e, e' with
  | Completes _, Completes _ -> 0
  | Fails site, Fails site' -> Int.compare site site'
  | Completes _, Fails _ -> -1
  | Fails _, Completes _ -> 1

let first n pair = if n <> 0 then Settled n else pair

(* As [Order.list]. *)
let lists pair xs ys =
  let rec from xs ys () =
    if xs == ys then Seq.Nil
    else
      match xs, ys with
      | [], [] -> Seq.Nil
      | [], _ :: _ -> Seq.Cons (Settled (-1), Seq.empty)
      | _ :: _, [] -> Seq.Cons (Settled 1, Seq.empty)
      | x :: xs, y :: ys -> Seq.Cons (pair x y, from xs ys)
  in
  Several (from xs ys)

let items a b = first (Int.compare (Vector.length a) (Vector.length b)) (Items (a, b, 0))
let values x y = Values (x, y)
let entry (k, x) (k', x') = first (String.compare k k') (Values (x, x'))

let setting s s' =
  first
    (Int.compare s.setting_site s'.setting_site)
    (Both (lists values s.positional s'.positional, lists entry s.named s'.named))

let code c c' =
  first
    (Int.compare c.lambda.id c'.lambda.id)
    (items (Vector.of_array c.captured) (Vector.of_array c'.captured))

let option pair x y =
  match x, y with
  | None, None -> Settled 0
  | None, Some _ -> Settled (-1)
  | Some _, None -> Settled 1
  | Some x, Some y -> pair x y

let closures c c' = Code (c, c')
let branch b b' = Both (Code (b.guard, b'.guard), Tasks (b.body, b'.body))

let duration d d' =
  match d, d' with
  | Seconds s, Seconds s' -> Settled (Float.compare s s')
  | Given_by c, Given_by c' -> Code (c, c')
  | Seconds _, Given_by _ -> Settled (-1)
  | Given_by _, Seconds _ -> Settled 1

let ensured d d' =
  match d, d' with
  | Pair (k, x), Pair (k', x') -> entry (k, x) (k', x')
  | Variable (i, _, x), Variable (i', _, x') -> first (Int.compare i i') (Values (x, x'))
  | Taken, Taken -> Settled 0
  | Pair _, (Variable _ | Taken) | Variable _, Taken -> Settled (-1)
  | (Variable _ | Taken), Pair _ | Taken, Variable _ -> Settled 1

let task_parts t t' =
  match t, t' with
  | Platform p, Platform p' ->
    Settled
      (Order.both (String.compare p.name p'.name) (fun () ->
           Order.both (Int.compare p.task_site p'.task_site) (fun () ->
               Option.compare Inline_plan.compare p.plan p'.plan)))
  | Action c, Action c' | Condition c, Condition c' | Made c, Made c' | Fresh c, Fresh c' -> Code (c, c')
  | Sequence (a, b), Sequence (a', b') | Parallel (a, b), Parallel (a', b') -> Both (Tasks (a, a'), Tasks (b, b'))
  | Allocated (a, vs), Allocated (a', vs') -> first (List.compare String.compare vs vs') (Tasks (a, a'))
  | All_of bs, All_of bs' | One_of bs, One_of bs' -> lists branch bs bs'
  | Until (e, c, a), Until (e', c', a') -> first (compare_on_cut e e') (Both (Code (c, c'), Tasks (a, a')))
  | Watch (a, c), Watch (a', c') -> Both (Code (c, c'), Tasks (a, a'))
  | Idle a, Idle b -> Settled (Float.compare a.seconds b.seconds)
  | Confirm a, Confirm b ->
    Settled (Order.both (Int.compare a.site b.site) (fun () -> String.compare a.prompt b.prompt))
  | During (e, d, a), During (e', d', a') -> first (compare_on_cut e e') (Both (duration d d', Tasks (a, a')))
  | Repeat a, Repeat b ->
    first
      (Option.compare Int.compare a.rounds b.rounds)
      (Both (option closures a.until b.until, first (Int.compare a.site b.site) (Tasks (a.body, b.body))))
  | Recruit a, Recruit b ->
    Both
      ( Code (a.code, b.code),
        Settled
          (Order.both (Int.compare a.site b.site) (fun () -> Vehicle_filter.compare a.asked b.asked)) )
  | Ensure (ds, a), Ensure (ds', a') -> Both (lists ensured ds ds', Tasks (a, a'))
  | ( ( Platform _ | Action _ | Condition _ | Sequence _ | Parallel _ | Allocated _ | All_of _ | One_of _
      | Until _ | Idle _ | Confirm _ | During _ | Watch _ | Repeat _ | Made _ | Recruit _
      | Fresh _ | Ensure _ ),
      _ ) -> Settled (Int.compare (rank_task t) (rank_task t'))

(* [Settled], or the pairs of parts. *)
let value_parts x y =
  match x, y with
  | Boolean a, Boolean b -> Settled (Bool.compare a b)
  | Integer a, Integer b -> Settled (Int.compare a b)
  | Number a, Number b -> Settled (Float.compare a b)
  | String a, String b | Symbol a, Symbol b | Host a, Host b -> Settled (String.compare a b)
  | List a, List b -> items a b
  | Map a, Map b -> lists entry a b
  | Range (a, b), Range (a', b') -> Settled (Order.both (Int.compare a a') (fun () -> Int.compare b b'))
  | Position a, Position b -> Settled (Position.compare a b)
  | Area a, Area b -> Settled (Area.compare a b)
  | Vehicles a, Vehicles b -> Settled (List.compare String.compare a b)
  | Task a, Task b -> Tasks (a, b)
  | Closure a, Closure b -> Code (a, b)
  | Settings a, Settings b -> lists setting a b
  | Unknown a, Unknown b ->
    Settled (Order.both (String.compare a.sensor b.sensor) (fun () -> String.compare a.of_vehicle b.of_vehicle))
  | Reading a, Reading b ->
    Settled (Order.both (Stdlib.compare a.quantity b.quantity) (fun () -> String.compare a.text b.text))
  | ( ( Null | Boolean _ | Integer _ | Number _ | String _ | Wildcard | Symbol _ | List _ | Map _ | Range _
      | Position _ | Area _ | Vehicles _ | Task _ | Closure _ | Host _ | Settings _ | Reading _ | Unknown _ ),
      _ ) -> Settled (Int.compare (rank x) (rank y))

(* The index of the first elements from [i] on that are not the same at a glance. *)
let rec past_same m xs ys i =
  if i = Vector.length xs then i
  else
    let same =
      match Vector.get xs i, Vector.get ys i with
      | Integer a, Integer b -> a = b
      | String a, String b -> String.equal a b
      | x, y -> x == y
    in
    if same then begin
      m.steps <- m.steps + 1;
      past_same m xs ys (i + 1)
    end
    else i

(* The first difference. [parts] gives the parts of two values; [rest] is what comes after the pair. *)
let rec order parts m pair rest =
  match pair with
  | Settled 0 -> following parts m rest
  | Settled n -> n
  | Values (x, y) ->
    m.steps <- m.steps + 1;
    if x == y then following parts m rest
    else (
      match parts x y with
      | Settled 0 -> following parts m rest
      | Settled n -> n
      | (Items _ | Several _) as inner ->
        if is_known m.values x y then following parts m rest
        else order parts m inner (Equal_since (m.steps, pair) :: rest)
      | (Values _ | Tasks _ | Code _ | Both _ | Equal_since _) as inner -> order parts m inner rest)
  | Items (xs, ys, i) ->
    let i = past_same m xs ys i in
    if i = Vector.length xs then following parts m rest
    else order parts m (Values (Vector.get xs i, Vector.get ys i)) (Items (xs, ys, i + 1) :: rest)
  | Tasks (t, t') ->
    m.steps <- m.steps + 1;
    if t == t' || is_known m.tasks t t' then following parts m rest
    else order parts m (task_parts t t') (Equal_since (m.steps, pair) :: rest)
  | Code (c, c') -> order parts m (code c c') rest
  | Both (one, other) -> order parts m one (other :: rest)
  | Several pairs -> (
      match pairs () with
      | Seq.Nil -> following parts m rest
      | Seq.Cons (pair, pairs) -> order parts m pair (Several pairs :: rest))
  | Equal_since (before, pair) ->
    remember m before pair;
    following parts m rest

and following parts m = function [] -> 0 | pair :: rest -> order parts m pair rest

let compare_pair pair = order value_parts (memory ()) pair []

let compare x y = if x == y then 0 else compare_pair (Values (x, y))
let compare_task t t' = if t == t' then 0 else compare_pair (Tasks (t, t'))
let compare_ensured d d' = compare_pair (ensured d d')
let compare_closure c c' = if c == c' then 0 else compare_pair (Code (c, c'))

(* The number of parts of a value that are hashed: it may share its parts with itself many times over. *)
let hashed_parts = 10_000

(* The number of pieces of code: each may hold a task that holds the next one twice. *)
let hashed_code = 100

(* How many more of these are hashed. *)
type hashing = { mutable parts : int; mutable code : int }

(* The number of levels of a task. *)
let hashed_depth = 6

let rec hash_value left x =
  left.parts <- left.parts - 1;
  if left.parts < 0 then 0
  else
    match x with
    | Null | Wildcard -> rank x
    | Boolean b -> Order.mix 1 (Bool.to_int b)
    | Integer i -> Order.mix 2 i
    | Number n -> Order.mix 3 (Hashtbl.hash n)
    | String s | Symbol s | Host s -> Order.mix (rank x) (Hashtbl.hash s)
    | List xs -> hash_values left (Order.mix 7 (Vector.length xs)) xs
    | Map entries ->
      List.fold_left (fun h (k, x) -> Order.mix (Order.mix h (Hashtbl.hash k)) (hash_value left x)) 8 entries
    | Range (a, b) -> Order.mix (Order.mix 9 a) b
    | Position p -> Order.mix 10 (Hashtbl.hash p)
    | Area a -> Order.mix 11 (Area.hash a)
    | Vehicles vs -> List.fold_left (fun h v -> Order.mix h (Hashtbl.hash v)) 12 vs
    | Task t -> Order.mix 13 (hash_task left hashed_depth t)
    | Closure c -> Order.mix 14 (hash_code left c)
    | Settings settings -> Order.mix 16 (List.length settings)
    | Reading r -> Order.mix 17 (Hashtbl.hash r.text)
    | Unknown u -> Order.mix 18 (Hashtbl.hash u.of_vehicle)

and hash_values left h xs =
  let rec from i h =
    if i = Vector.length xs || left.parts < 0 then h else from (i + 1) (Order.mix h (hash_value left (Vector.get xs i)))
  in
  from 0 h

and hash_code left c =
  left.code <- left.code - 1;
  if left.code < 0 then c.lambda.id else hash_values left c.lambda.id (Vector.of_array c.captured)

and hash_task left depth t =
  let part = hash_task left (depth - 1) in
  if depth = 0 then 0
  else
    match t with
    | Platform p -> Hashtbl.hash p.name
    | Action c | Condition c | Made c | Fresh c | Recruit { code = c; _ } -> Order.mix (rank_task t) (hash_code left c)
    | Sequence (a, b) | Parallel (a, b) -> Order.mix (Order.mix (rank_task t) (part a)) (part b)
    | Allocated (a, vs) -> Order.mix (part a) (Hashtbl.hash vs)
    | All_of bs | One_of bs ->
      List.fold_left (fun h b -> Order.mix (Order.mix h (hash_code left b.guard)) (part b.body)) (rank_task t) bs
    | Until (_, c, a) | Watch (a, c) -> Order.mix (Order.mix (rank_task t) (hash_code left c)) (part a)
    | Idle { seconds; _ } -> Order.mix 9 (Hashtbl.hash seconds)
    | Confirm { prompt; _ } -> Order.mix 14 (Hashtbl.hash prompt)
    | During (_, _, a) -> Order.mix 10 (part a)
    | Repeat { rounds; body; _ } -> Order.mix (Order.mix 12 (Option.value rounds ~default:0)) (part body)
    | Ensure (ds, a) -> List.fold_left (fun h d -> Order.mix h (hash_given left d)) (part a) ds

and hash_given left = function
  | Pair (k, x) -> Order.mix (Hashtbl.hash k) (hash_value left x)
  | Variable (i, _, x) -> Order.mix i (hash_value left x)
  | Taken -> 17

let hashing () = { parts = hashed_parts; code = hashed_code }
let hash x = hash_value (hashing ()) x
let hash_closure c = hash_code (hashing ()) c
let hash_ensured d = hash_given (hashing ()) d

let canonical_number x =
  match x with
  | Number n when Float.is_integer n && Float.abs n < 0x1p62 -> Integer (int_of_float n)
  | x -> x

let by_key (k, _) (k', _) = String.compare k k'

let rec canonical x =
  match x with
  | Number _ -> canonical_number x
  | List xs -> List (Vector.map canonical xs)
  | Map entries -> Map (List.map (fun (k, x) -> (k, canonical x)) entries)
  | Null | Boolean _ | Integer _ | String _ | Wildcard | Symbol _ | Range _ | Position _ | Area _ | Vehicles _ | Task _
  | Closure _ | Host _ | Settings _ | Reading _ | Unknown _ -> x

let rec normal x =
  match x with
  | Number _ -> canonical_number x
  | List xs -> List (Vector.map normal xs)
  | Map entries -> Map (List.sort by_key (List.map (fun (k, x) -> (k, normal x)) entries))
  | Vehicles vs -> Vehicles (List.sort String.compare vs)
  | Null | Boolean _ | Integer _ | String _ | Wildcard | Symbol _ | Range _ | Position _ | Area _ | Task _ | Closure _
  | Host _ | Settings _ | Reading _ | Unknown _ -> x

let rec is_alone x =
  match x with
  | Vehicles (_ :: _ :: _) | Map (_ :: _ :: _) -> false
  | List xs -> Vector.for_all is_alone xs
  | Map entries -> List.for_all (fun (_, x) -> is_alone x) entries
  | Null | Boolean _ | Integer _ | Number _ | String _ | Wildcard | Symbol _ | Range _ | Position _ | Area _
  | Vehicles _ | Task _ | Closure _ | Host _ | Settings _ | Reading _ | Unknown _ -> true

let normal_parts x y =
  match x, y with
  | (Integer _ | Number _), (Integer _ | Number _) -> Settled (compare (canonical_number x) (canonical_number y))
  | List a, List b -> items a b
  | Map a, Map b ->
    first (List.compare_lengths a b) (lists entry (List.sort by_key a) (List.sort by_key b))
  | Vehicles a, Vehicles b ->
    Settled (List.compare String.compare (List.sort String.compare a) (List.sort String.compare b))
  | ( ( Null | Boolean _ | Integer _ | Number _ | String _ | Wildcard | Symbol _ | List _ | Map _ | Range _
      | Position _ | Area _ | Vehicles _ | Task _ | Closure _ | Host _ | Settings _ | Reading _ | Unknown _ ),
      _ ) -> Settled (compare x y)

(* As [compare (normal x) (normal y) = 0], but what both share is not gone through. *)
let equals x y = order normal_parts (memory ()) (Values (x, y)) [] = 0

type excess = Parts | Depth

let deepest = 10_000

let excess ~most x =
  let left = ref most and found = ref None in
  let exceeds what = found := Some what; false in
  let rec fits depth x =
    decr left;
    if !left < 0 then exceeds Parts
    else if depth > deepest then exceeds Depth
    else
      match x with
      | List xs -> Vector.for_all (fits (depth + 1)) xs
      | Map entries -> List.for_all (fun (_, x) -> fits (depth + 1) x) entries
      | Null | Boolean _ | Integer _ | Number _ | String _ | Wildcard | Symbol _ | Range _ | Position _ | Area _
      | Vehicles _ | Task _ | Closure _ | Host _ | Settings _ | Reading _ | Unknown _ -> true
  in
  ignore (fits 0 x : bool);
  !found

let has_at_most n x = excess ~most:n x = None

let have_characters_at_most n xs =
  let left = ref n in
  let rec fits x =
    match x with
    | String s -> left := !left - String.length s; !left >= 0
    | List xs -> Vector.for_all fits xs
    | Map entries -> List.for_all (fun (k, x) -> fits (String k) && fits x) entries
    | Null | Boolean _ | Integer _ | Number _ | Wildcard | Symbol _ | Range _ | Position _ | Area _ | Vehicles _
    | Task _ | Closure _ | Host _ | Settings _ | Reading _ | Unknown _ -> true
  in
  List.for_all fits xs

let rec made_at site x =
  match x with
  | Task (Platform p) -> Task (Platform { p with task_site = site })
  | List xs -> List (Vector.map (made_at site) xs)
  | Map entries -> Map (List.map (fun (k, x) -> (k, made_at site x)) entries)
  | Null | Boolean _ | Integer _ | Number _ | String _ | Wildcard | Symbol _ | Range _ | Position _ | Area _
  | Vehicles _ | Task _ | Closure _ | Host _ | Settings _ | Reading _ | Unknown _ -> x

let truth = function
  | Null -> false
  | Boolean b -> b
  | Integer i -> i <> 0
  | Number n -> n <> 0.
  | String s -> s <> ""
  | List xs -> Vector.length xs > 0
  | Map entries -> entries <> []
  | Vehicles vs -> vs <> []
  | Unknown _ -> false
  | Wildcard | Symbol _ | Range _ | Position _ | Area _ | Task _ | Closure _ | Host _ | Settings _ | Reading _ -> true

let kind = function
  | Null -> "null"
  | Boolean _ -> "a truth value"
  | Integer _ | Number _ -> "a number"
  | String _ -> "a string"
  | Wildcard -> "the wildcard _"
  | Symbol _ -> "a unit"
  | List _ -> "a list"
  | Map _ -> "a map"
  | Range _ -> "a range"
  | Position _ -> "a position"
  | Area _ -> "an area"
  | Vehicles _ -> "a vehicle set"
  | Task _ -> "a task"
  | Closure _ -> "a closure"
  | Host _ -> "a host object"
  | Settings _ -> "a block of settings"
  | Reading { quantity = Amount; _ } -> "a number"
  | Reading { quantity = Place; _ } -> "a position"
  | Reading { quantity = Region; _ } -> "an area"
  | Reading { quantity = Words; _ } -> "a string"
  | Unknown _ -> "an unknown value"

let to_number = function
  | Integer i -> Some (float_of_int i)
  | Number n -> Some n
  | Null | Boolean _ | String _ | Wildcard | Symbol _ | List _ | Map _ | Range _ | Position _ | Area _ | Vehicles _
  | Task _ | Closure _ | Host _ | Settings _ | Reading _ | Unknown _ -> None


(* As [Operators.range] makes them. *)
let vehicle_at vs i = Vehicles [ List.nth vs i ]
let range_length first last = abs (last - first) + 1
let range_item first last i = if first <= last then first + i else first - i

(* The UTF-8 characters of a string. *)
let characters s =
  let continues i = i < String.length s && Char.code s.[i] land 0xC0 = 0x80 in
  let rec from i characters =
    if i >= String.length s then List.rev characters
    else
      let rec stop j = if continues j then stop (j + 1) else j in
      let j = stop (i + 1) in
      from j (String (String.sub s i (j - i)) :: characters)
  in
  Array.of_list (from 0 [])

let most_items = 1_000_000

let items = function
  | List xs -> Some (Vector.to_array xs)
  | Range (first, last) when not (0 < range_length first last && range_length first last <= most_items) -> None
  | Range (first, last) ->
    Some (Array.init (range_length first last) (fun i -> Integer (range_item first last i)))
  | Vehicles vs -> Some (Array.of_list (List.map (fun v -> Vehicles [ v ]) vs))
  | Map entries ->
    Some (Array.of_list (List.map (fun (k, x) -> Map [ ("key", String k); ("value", x) ]) entries))
  | String s -> Some (characters s)
  | Null | Boolean _ | Integer _ | Number _ | Wildcard | Symbol _ | Position _ | Area _ | Task _ | Closure _
  | Host _ | Settings _ | Reading _ | Unknown _ -> None

let length = function
  | List xs -> Some (Vector.length xs)
  | Range (first, last) -> Some (range_length first last)
  | Vehicles vs -> Some (List.length vs)
  | Map entries -> Some (List.length entries)
  | String s -> Some (Array.length (characters s))
  | Null | Boolean _ | Integer _ | Number _ | Wildcard | Symbol _ | Position _ | Area _ | Task _ | Closure _
  | Host _ | Settings _ | Reading _ | Unknown _ -> None

(* With [digits], or as few more as read back as the same number. *)
let rec shortest digits n =
  let text = Printf.sprintf "%.*g" digits n in
  if digits >= 17 || float_of_string text = n then text else shortest (digits + 1) n

let amount n = shortest 6 n

(* The shortest decimal text that reads back as the same number. *)
let text_of_number n =
  if Float.is_nan n then "NaN"
  else if n = 0. then "0.0" (* -0.0 is the same number *)
  else if Float.is_integer n && Float.abs n < 1e15 then Printf.sprintf "%.1f" n
  else shortest 15 n

let quoted s =
  let b = Buffer.create (String.length s + 2) in
  Buffer.add_char b '\'';
  String.iter
    (function
      | '\'' -> Buffer.add_string b "\\'"
      | '\\' -> Buffer.add_string b "\\\\"
      | '\n' -> Buffer.add_string b "\\n"
      | c -> Buffer.add_char b c)
    s;
  Buffer.add_char b '\'';
  Buffer.contents b

(* Only the first parts of a long task are shown. *)
let shown_parts = 100

let comma ppf () = Format.pp_print_string ppf ", "

let rec print ~bare ppf x =
  let text = Format.pp_print_string ppf in
  let inside = print ~bare in
  match x with
  | Null -> text "null"
  | Boolean b -> text (string_of_bool b)
  | Integer i -> text (string_of_int i)
  | Number n -> text (text_of_number n)
  | String s -> text (if bare then s else quoted s)
  | Wildcard -> text "_"
  | Symbol s -> text s
  | List xs -> Format.fprintf ppf "[%a]" (Format.pp_print_list ~pp_sep:comma inside) (Vector.to_list xs)
  | Map [] -> text "[:]"
  | Map entries ->
    let entry ppf (k, x) = Format.fprintf ppf "%s:%a" k inside x in
    Format.fprintf ppf "[%a]" (Format.pp_print_list ~pp_sep:comma entry) entries
  | Range (first, last) -> Format.fprintf ppf "%d..%d" first last
  | Position p -> Position.pp ppf p
  | Area a -> Area.pp ppf a
  | Vehicles [ v ] -> text v
  | Vehicles vs -> Format.fprintf ppf "[%s]" (String.concat ", " vs)
  | Task t -> pp_task ppf t
  | Closure c -> Format.fprintf ppf "{ %s }" c.lambda.label
  | Host name -> Format.fprintf ppf "host object %s" name
  | Settings _ -> text "{ ... }"
  | Reading r -> text r.text
  | Unknown _ -> text "unknown"

and until = function Completes _ -> "until" | Fails _ -> "assure"
and during = function Completes _ -> "during" | Fails _ -> "within"

and pp_task ppf t =
  let left = ref shown_parts in
  print_task left 0 ppf t

(* Loosest first: [|], [>>], [/], operands. [left] is how many more parts are shown. *)
and print_task left level ppf t =
  decr left;
  let print format = Format.fprintf ppf format in
  let parenthesised needed body = if level > needed then print "(%t)" body else body ppf in
  let task level ppf t = print_task left level ppf t in
  let branch ppf b = Format.fprintf ppf "when { ... } then %a" (task 1) b.body in
  let prefixed text a = parenthesised 0 (fun ppf -> Format.fprintf ppf "%s run %a" text (task 1) a) in
  if !left < 0 then print "..."
  else
    match t with
    | Platform p -> print "task(%s)" (quoted p.name)
    | Action c -> print "action { %s }" c.lambda.label
    | Condition c -> print "condition { %s }" c.lambda.label
    | Parallel (a, b) -> parenthesised 0 (fun ppf -> Format.fprintf ppf "%a | %a" (task 0) a (task 1) b)
    | Sequence (a, b) -> parenthesised 1 (fun ppf -> Format.fprintf ppf "%a >> %a" (task 1) a (task 2) b)
    | Allocated (a, vs) -> print "%a[%s]" (task 3) a (String.concat " + " vs)
    | All_of bs -> print "allOf { %a }" (Format.pp_print_list ~pp_sep:comma branch) bs
    | One_of bs -> print "oneOf { %a }" (Format.pp_print_list ~pp_sep:comma branch) bs
    | Until (e, _, a) -> prefixed (until e ^ " { ... }") a
    | Idle { seconds; _ } -> print "idle(%s.seconds)" (amount seconds)
    | Confirm { prompt; _ } -> print "confirm(%s)" (quoted prompt)
    | During (e, Seconds d, a) -> prefixed (Printf.sprintf "%s %s.seconds" (during e) (amount d)) a
    | During (e, Given_by _, a) -> prefixed (during e ^ " { ... }") a
    | Watch (a, _) -> parenthesised 0 (fun ppf -> Format.fprintf ppf "watch %a onError { ... }" (task 1) a)
    | Repeat { rounds; until; body; _ } ->
      let first = Option.fold rounds ~none:"" ~some:(Printf.sprintf "%d, ") in
      let last = if until = None then "" else " until { ... }" in
      parenthesised 0 (fun ppf -> Format.fprintf ppf "repeat %s%a%s" first (task 1) body last)
    | Made c -> print "{ %s }" c.lambda.label
    | Fresh c -> print "fresh { %s }" c.lambda.label
    | Ensure (ds, a) -> print "%a ensure { %a }" (task 3) a pp_ensured ds
    | Recruit _ -> parenthesised 0 (fun ppf -> Format.fprintf ppf "recruit { ... } then { ... }")

and pp_ensured ppf ds =
  let one ppf = function
    | Pair (k, x) -> Format.fprintf ppf "post %s: %a" k (print ~bare:false) x
    | Variable (_, name, x) -> Format.fprintf ppf "%s = %a" name (print ~bare:false) x
    | Taken -> Format.pp_print_string ppf "giveBack()"
  in
  Format.pp_print_list ~pp_sep:(fun ppf () -> Format.pp_print_string ppf "; ") one ppf ds

let to_string x = Format.asprintf "%a" (print ~bare:true) x
let pp ppf x = print ~bare:false ppf x
let pp_tuple ppf (k, x) = Format.fprintf ppf "%s:%a" k pp x
