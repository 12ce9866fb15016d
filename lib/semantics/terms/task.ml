open Core

type mapper = {
  part : task -> task;
  code : closure -> closure;
  value : value -> value;
  vehicle : vehicle -> vehicle;
}

let map_ensured f = function
  | Pair (k, x) -> Pair (k, f x)
  | Variable (i, name, x) -> Variable (i, name, f x)
  | Taken -> Taken

(* From left to right: a function may number what it meets. *)
let map m t =
  let branch b =
    let guard = m.code b.guard in
    { guard; body = m.part b.body }
  in
  match t with
  | Platform _ | Idle _ | Confirm _ -> t
  | Action c -> Action (m.code c)
  | Condition c -> Condition (m.code c)
  | Sequence (a, b) ->
    let a = m.part a in
    Sequence (a, m.part b)
  | Parallel (a, b) ->
    let a = m.part a in
    Parallel (a, m.part b)
  | Allocated (a, vs) ->
    let vs = List.map m.vehicle vs in
    Allocated (m.part a, vs)
  | All_of bs -> All_of (List.map branch bs)
  | One_of bs -> One_of (List.map branch bs)
  | Until (on_cut, c, a) ->
    let c = m.code c in
    Until (on_cut, c, m.part a)
  | During (on_cut, d, a) ->
    let d = match d with Seconds s -> Seconds s | Given_by c -> Given_by (m.code c) in
    During (on_cut, d, m.part a)
  | Watch (a, c) ->
    let a = m.part a in
    Watch (a, m.code c)
  | Repeat x ->
    let until = Option.map m.code x.until in
    Repeat { x with until; body = m.part x.body }
  | Made c -> Made (m.code c)
  | Fresh c -> Fresh (m.code c)
  | Ensure (ds, a) ->
    let ds = List.map (map_ensured m.value) ds in
    Ensure (ds, m.part a)
  | Recruit x -> Recruit { x with code = m.code x.code }

let parts t =
  let found = ref [] in
  let part a =
    found := a :: !found;
    a
  in
  ignore (map { part; code = Fun.id; value = Fun.id; vehicle = Fun.id } t);
  List.rev !found
