type mark = Alone | Recruits | End_on of string | Number of int | Within

module Numbers = Map.Make (Int)

let rank = function Alone -> 0 | Recruits -> 1 | End_on _ -> 2 | Number _ -> 3 | Within -> 4

let compare_marks m m' =
  match m, m' with
  | End_on v, End_on v' -> String.compare v v'
  | Number n, Number n' -> Int.compare n n'
  | (Alone | Recruits | End_on _ | Number _ | Within), _ -> Int.compare (rank m) (rank m')

module Index = Set.Make (struct
    type t = mark * int

    let compare (m, i) (m', i') = match compare_marks m m' with 0 -> Int.compare i i' | order -> order
  end)

(* The numbers of branches grow from left to right, with gaps for branches that come between them. *)
type 'a indexed = { branches : 'a Numbers.t; index : Index.t }

type 'a t = Listed of 'a list | Indexed of 'a indexed

(* Branches before the place are reversed. *)
type 'a place = Between of 'a list * 'a list | At of 'a indexed * int

(* As many are looked through as fast as an index is kept. *)
let few = 16

let gap = 1 lsl 40

let of_list rs = Listed rs

let to_list = function
  | Listed rs -> rs
  | Indexed { branches; _ } -> List.rev (Numbers.fold (fun _ r rs -> r :: rs) branches [])

let only = function
  | Listed [ r ] -> Some r
  | Listed _ -> None
  | Indexed { branches; _ } -> (
      match Numbers.min_binding_opt branches, Numbers.max_binding_opt branches with
      | Some (i, r), Some (j, _) when i = j -> Some r
      | (Some _ | None), _ -> None)

let is_indexed = function Listed _ -> false | Indexed _ -> true

(* {1 The index} *)

let add ~marks i r { branches; index } =
  { branches = Numbers.add i r branches; index = List.fold_left (fun x m -> Index.add (m, i) x) index (marks r) }

let remove ~marks i { branches; index } =
  let unmark r = List.fold_left (fun x m -> Index.remove (m, i) x) index (marks r) in
  { branches = Numbers.remove i branches; index = Option.fold (Numbers.find_opt i branches) ~none:index ~some:unmark }

let add_all ~marks first step rs b =
  fst (List.fold_left (fun (b, i) r -> (add ~marks i r b, i + step)) (b, first) rs)

let indexed ~marks rs = add_all ~marks 0 gap rs { branches = Numbers.empty; index = Index.empty }

let begun ~marks rs = if List.compare_length_with rs few <= 0 then Listed rs else Indexed (indexed ~marks rs)

(* The numbers of the branches with the mark [m], in order. *)
let numbers m { index; _ } =
  let rec those (found : Index.elt Seq.t) () =
    match found () with
    | Seq.Cons ((m', i), rest) when compare_marks m m' = 0 -> Seq.Cons (i, those rest)
    | Cons _ | Nil -> Seq.Nil
  in
  those (Index.to_seq_from (m, min_int) index)

(* {1 Places} *)

let rec between before rs () =
  match rs with
  | [] -> Seq.Nil
  | r :: after -> Seq.Cons ((r, Between (before, after)), between (r :: before) after)

let places = function
  | Listed rs -> between [] rs
  | Indexed b -> Seq.map (fun (i, r) -> (r, At (b, i))) (Numbers.to_seq b.branches)

let at b i = (Numbers.find i b.branches, At (b, i))

let marked has m = function
  | Listed rs -> Seq.filter (fun (r, _) -> has m r) (between [] rs)
  | Indexed b -> (
      let found = numbers m b in
      match m, numbers Within b () with
      | Alone, _ | _, Nil -> Seq.map (at b) found
      | (Recruits | End_on _ | Number _ | Within), Cons _ ->
        let within = Seq.filter (fun i -> has m (Numbers.find i b.branches)) (numbers Within b) in
        let all = List.sort_uniq Int.compare (List.of_seq (Seq.append found within)) in
        Seq.map (at b) (List.to_seq all))

let beside = function
  | Between (before, after) -> List.rev_append before after
  | At (b, i) -> to_list (Indexed { b with branches = Numbers.remove i b.branches })

(* Where no numbers are left between two branches, all get new ones. *)
let put_at ~marks b i rs =
  let others = remove ~marks i b in
  let count = List.length rs in
  let step =
    match Numbers.find_first_opt (fun j -> j > i) b.branches with
    | Some (j, _) -> (j - i) / max 1 count
    | None -> if i < max_int - (gap * (count + 1)) then gap else 0
  in
  if step > 0 then add_all ~marks i step rs others
  else
    let before, _, after = Numbers.split i b.branches in
    let listed branches = to_list (Indexed { b with branches }) in
    indexed ~marks (listed before @ rs @ listed after)

let put ~marks place rs =
  match place, rs with
  | Between (before, after), ([] | [ _ ]) -> Listed (List.rev_append before (rs @ after))
  | Between (before, after), _ -> begun ~marks (List.rev_append before (rs @ after))
  | At (b, i), _ -> Indexed (put_at ~marks b i rs)
