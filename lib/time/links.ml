open Dolphin_semantics

type t = {
  at_first : Core.vehicle list;
  late : Core.vehicle list;
  changes : (Core.vehicle * int) array;
  silent : Core.vehicle list array;  (* before each change, and after the last *)
}

let none = { at_first = []; late = []; changes = [||]; silent = [| [] |] }

let is_in v vs = List.exists (String.equal v) vs

let make vehicles at_first changes =
  let toggle silent (v, _) =
    let is_silent w = is_in w silent <> String.equal v w in
    List.filter is_silent vehicles
  in
  let add found change = toggle (List.hd found) change :: found in
  let note found (v, _) = if is_in v at_first && not (is_in v found) then v :: found else found in
  let heard = List.rev (List.fold_left note [] changes) in
  { at_first; changes = Array.of_list changes;
    late = heard @ List.filter (fun v -> not (is_in v heard)) at_first;
    silent = Array.of_list (List.rev (List.fold_left add [ at_first ] changes)) }

(* The changes of each vehicle, the next ones first, with the place of the one before. *)
let rec in_order found n queues =
  let first (_, (date, since), _) (_, (date', since'), _) = Stdlib.compare (date, since) (date', since') in
  match List.stable_sort first queues with
  | [] -> List.rev found
  | (v, (date, _), later) :: others ->
    let rest = match later with next :: later -> [ (v, (next, n), later) ] | [] -> [] in
    in_order ((v, date) :: found) (n + 1) (others @ rest)

(* In whole milliseconds, without what is shorter. *)
let dates (v, spans) =
  let date seconds = Option.value (Bounds.milliseconds seconds) ~default:max_int in
  let of_span (from, until) = if date from < date until then [ date from; date until ] else [] in
  (v, List.filter (fun ms -> ms < max_int) (List.concat_map of_span spans))

let of_silences silences =
  let all = List.map dates silences in
  let is_silent = function v, 0 :: _ -> Some v | _ -> None in
  let queue (v, dates) =
    match List.filter (fun ms -> ms > 0) dates with
    | next :: later -> Some (v, (next, -1), later)
    | [] -> None
  in
  make (List.map fst all) (List.filter_map is_silent all) (in_order [] 0 (List.filter_map queue all))

let only_first l =
  let add found (v, date) =
    if is_in v l.at_first && not (List.mem_assoc v found) then (v, date) :: found else found in
  make l.at_first l.at_first (List.rev (Array.fold_left add [] l.changes))

let late l = l.late
let count l = Array.length l.changes
let change l k = l.changes.(k)
let changes l = Array.to_list l.changes
let silent l k = l.silent.(k)
let is_silent l k v = is_in v l.silent.(k)

let may_go l v =
  let goes k (w, _) = String.equal v w && is_silent l (k + 1) v in
  Array.exists Fun.id (Array.mapi goes l.changes)

let words l k =
  let v, _ = l.changes.(k) in
  let is_first = not (Array.exists (fun (w, _) -> String.equal v w) (Array.sub l.changes 0 k)) in
  match is_silent l k v, is_first with
  | true, true -> v ^ " joins"
  | true, false -> v ^ "'s link is back"
  | false, _ -> v ^ "'s link goes"

let rec next l k ~matters = if k < count l && not (matters (fst l.changes.(k))) then next l (k + 1) ~matters else k
