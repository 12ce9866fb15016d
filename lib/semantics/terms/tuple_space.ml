type order = { named : string list; prefixes : string list }

let keys named = { named = List.sort_uniq String.compare named; prefixes = [] }
let no_key = keys []
let with_prefix prefix order = { order with prefixes = List.sort_uniq String.compare (prefix :: order.prefixes) }
let every_key = with_prefix "" no_key

let keeps_order order k =
  List.exists (String.equal k) order.named || List.exists (fun prefix -> String.starts_with ~prefix k) order.prefixes

module type VALUE = sig
  type t

  val compare : t -> t -> int

  val hash : t -> int

  val normal : t -> t

  val pp : Format.formatter -> t -> unit
end

module type S = sig
  type value

  type t

  val empty : order -> t

  val is_empty : t -> bool

  val cardinal : t -> int

  val is_ordered : string -> t -> bool

  val post : string -> value -> t -> t

  val consume : string -> value -> t -> t option

  val consume_oldest : string -> t -> (value * t) option

  val without : string -> t -> t

  val keys_with : string -> t -> string list

  val poll : string -> value -> t -> bool

  val poll_any : string -> t -> bool

  val values : string -> t -> value list

  val bindings : t -> (string * value list) list

  val kept : string -> value -> t -> value

  val changed : before:t -> after:t -> (string * value list) list * (string * value list) list

  val equal : t -> t -> bool

  val compare : t -> t -> int

  val hash : t -> int

  val pp : Format.formatter -> t -> unit
end

module By_key = Map.Make (String)
module By_arrival = Map.Make (Int)

module Make (Value : VALUE) = struct
  module By_value = Map.Make (Value)

  type value = Value.t

  (* The pairs of one key, at least one. Numbers of arrival matter only relative to each other. *)
  type pairs =
    | Counted of int By_value.t  (* how often each value is there, at least once *)
    | Queued of value By_arrival.t

  type t = { ordered : order; cardinal : int; pairs : pairs By_key.t }

  let empty ordered = { ordered; cardinal = 0; pairs = By_key.empty }

  let is_empty n = n.cardinal = 0

  let cardinal n = n.cardinal

  let is_ordered k n = keeps_order n.ordered k

  let post k x n =
    let pairs =
      match By_key.find_opt k n.pairs with
      | Some (Counted counts) ->
        let more count = Some (1 + Option.value count ~default:0) in
        Counted (By_value.update (Value.normal x) more counts)
      | Some (Queued queue) -> Queued (By_arrival.add (1 + fst (By_arrival.max_binding queue)) x queue)
      | None ->
        if is_ordered k n then Queued (By_arrival.singleton 0 x) else Counted (By_value.singleton (Value.normal x) 1)
    in
    { n with cardinal = n.cardinal + 1; pairs = By_key.add k pairs n.pairs }

  (* [n] with one pair less, namely with [pairs] for [k]. *)
  let shrunk k pairs n =
    let is_over =
      match pairs with
      | Counted counts -> By_value.is_empty counts
      | Queued queue -> By_arrival.is_empty queue
    in
    let pairs = if is_over then By_key.remove k n.pairs else By_key.add k pairs n.pairs in
    { n with cardinal = n.cardinal - 1; pairs }

  let arrival x queue =
    let x = Value.normal x in
    let rec look seq =
      match seq () with
      | Seq.Nil -> None
      | Seq.Cons ((number, y), rest) -> if Value.compare x (Value.normal y) = 0 then Some number else look rest
    in
    look (By_arrival.to_seq queue)

  let consume k x n =
    match By_key.find_opt k n.pairs with
    | None -> None
    | Some (Counted counts) -> (
        let x = Value.normal x in
        match By_value.find_opt x counts with
        | None -> None
        | Some 1 -> Some (shrunk k (Counted (By_value.remove x counts)) n)
        | Some count -> Some (shrunk k (Counted (By_value.add x (count - 1) counts)) n))
    | Some (Queued queue) ->
      Option.map (fun number -> shrunk k (Queued (By_arrival.remove number queue)) n) (arrival x queue)

  let consume_oldest k n =
    if not (is_ordered k n) then Fmt.invalid_arg "Tuple_space.consume_oldest: key %s is not ordered" k;
    match By_key.find_opt k n.pairs with
    | None | Some (Counted _) -> None
    | Some (Queued queue) ->
      let number, x = By_arrival.min_binding queue in
      Some (x, shrunk k (Queued (By_arrival.remove number queue)) n)

  let without k n =
    match By_key.find_opt k n.pairs with
    | None -> n
    | Some pairs ->
      let count =
        match pairs with
        | Counted counts -> By_value.fold (fun _ count sum -> count + sum) counts 0
        | Queued queue -> By_arrival.cardinal queue
      in
      { n with cardinal = n.cardinal - count; pairs = By_key.remove k n.pairs }

  let keys_with prefix n =
    let rec from seq =
      match seq () with
      | Seq.Cons ((k, _), rest) when String.starts_with ~prefix k -> k :: from rest
      | Seq.Cons _ | Seq.Nil -> []
    in
    from (By_key.to_seq_from prefix n.pairs)

  let poll k x n =
    match By_key.find_opt k n.pairs with
    | None -> false
    | Some (Counted counts) -> By_value.mem (Value.normal x) counts
    | Some (Queued queue) -> Option.is_some (arrival x queue)

  let poll_any k n = By_key.mem k n.pairs

  let values = function
    | Counted counts ->
      let rec add x count values = if count = 0 then values else add x (count - 1) (x :: values) in
      List.rev (By_value.fold add counts [])
    | Queued queue -> List.rev (By_arrival.fold (fun _ x values -> x :: values) queue [])

  let bindings n = List.map (fun (k, pairs) -> (k, values pairs)) (By_key.bindings n.pairs)

  let kept k x n = if is_ordered k n then x else Value.normal x

  let changed ~before ~after =
    let change _ old_pairs new_pairs =
      match old_pairs, new_pairs with
      | Some pairs, Some pairs' when pairs == pairs' -> None
      | pairs, pairs' -> Some (Option.fold ~none:[] ~some:values pairs, Option.fold ~none:[] ~some:values pairs')
    in
    let keys = By_key.bindings (By_key.merge change before.pairs after.pairs) in
    List.split (List.map (fun (k, (gone, come)) -> ((k, gone), (k, come))) keys)

  let values k n = match By_key.find_opt k n.pairs with Some pairs -> values pairs | None -> []

  (* [compare_seq compare_element a b] orders sequences lexicographically. *)
  let rec compare_seq compare_element a b =
    match (a (), b ()) with
    | Seq.Nil, Seq.Nil -> 0
    | Seq.Nil, Seq.Cons _ -> -1
    | Seq.Cons _, Seq.Nil -> 1
    | Seq.Cons (x, a), Seq.Cons (y, b) -> (
        match compare_element x y with 0 -> compare_seq compare_element a b | order -> order)

  let compare_pairs a b =
    match (a, b) with
    | Counted a, Counted b -> By_value.compare Int.compare a b
    | Queued a, Queued b ->
      compare_seq (fun (_, x) (_, y) -> Value.compare x y) (By_arrival.to_seq a) (By_arrival.to_seq b)
    | Counted _, Queued _ -> -1
    | Queued _, Counted _ -> 1

  let compare_ordered a b =
    match List.compare String.compare a.named b.named with
    | 0 -> List.compare String.compare a.prefixes b.prefixes
    | order -> order

  let compare n n' =
    if n == n' then 0
    else
      match Int.compare n.cardinal n'.cardinal with
      | 0 -> (
          match By_key.compare compare_pairs n.pairs n'.pairs with
          | 0 -> if n.ordered == n'.ordered then 0 else compare_ordered n.ordered n'.ordered
          | order -> order)
      | order -> order

  let equal n n' = compare n n' = 0

  let mix hash part = (hash * 1_000_003) lxor part

  let hash n =
    let hash_pairs pairs hash =
      match pairs with
      | Counted counts -> By_value.fold (fun x count hash -> mix (mix hash (Value.hash x)) count) counts hash
      | Queued queue -> By_arrival.fold (fun _ x hash -> mix hash (Value.hash x)) queue hash
    in
    By_key.fold (fun k pairs hash -> hash_pairs pairs (mix hash (Hashtbl.hash k))) n.pairs n.cardinal land max_int

  let pp ppf n =
    let flat = List.concat_map (fun (k, values) -> List.map (fun x -> (k, x)) values) (bindings n) in
    let pp_pair ppf (k, x) = Fmt.pf ppf "%s:%a" k Value.pp x in
    Fmt.pf ppf "@[<hov 1>{%a}@]" (Fmt.list ~sep:Fmt.comma pp_pair) flat
end
