open Core

type t = {
  store : Store.t;
  allocation : platform_task Vehicle_map.t;
  bound : vehicle list;
  tuples : Tuples.t;
}

let initial program =
  { store = Store.empty; allocation = Vehicle_map.empty; bound = []; tuples = Tuples.empty program.ordered_keys }

let post k x s = { s with tuples = Tuples.post k (Value.canonical x) s.tuples }
let without_keys keys s =
  if keys = [] then s else { s with tuples = List.fold_left (fun n k -> Tuples.without k n) s.tuples keys }

let ensure ds s =
  let one s = function
    | Pair (k, x) -> post k x s
    | Variable (i, _, x) -> { s with store = Store.set i x s.store }
    | Taken -> s
  in
  List.fold_left one s ds

let without_fresh s =
  without_keys (List.filter Residual.is_key (Tuples.keys_with Residual.key_prefix s.tuples)) s

let compare_platform_task p p' = Value.compare_task (Platform p) (Platform p')

let compare s s' =
  if s == s' then 0
  else
    Order.both (Tuples.compare s.tuples s'.tuples) (fun () ->
        Order.both (Store.compare s.store s'.store) (fun () ->
            Order.both (List.compare String.compare s.bound s'.bound) (fun () ->
                Vehicle_map.compare compare_platform_task s.allocation s'.allocation)))

let equal s s' = compare s s' = 0

(* A is left out: it follows from the residual. *)
let hash s = Order.mix (Order.mix (Tuples.hash s.tuples) (Store.hash s.store)) (Hashtbl.hash s.bound) land max_int

let pp program ppf s =
  let comma = Fmt.any ", " in
  let variable ppf (i, x) = Format.fprintf ppf "%s = %a" program.global_names.(i) Value.pp x in
  let running ppf (v, p) = Format.fprintf ppf "%s -> %s" v p.name in
  Format.fprintf ppf "store {%a}; A {%a}; B {%a}; N %a"
    (Fmt.list ~sep:comma variable) (Store.bindings s.store)
    (Fmt.list ~sep:comma running) (Vehicle_map.bindings s.allocation)
    (Fmt.list ~sep:comma Fmt.string) s.bound Tuples.pp s.tuples
