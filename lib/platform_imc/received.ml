open Dolphin_imc
module Numbers = Map.Make (Int)

type entry = { count : int; order : Byte_order.t; payload : string }
type t = entry Numbers.t Numbers.t

let most_kinds = 1000
let nothing = Numbers.empty
let kinds id x = Option.value (Numbers.find_opt id x) ~default:Numbers.empty

let add (h : Header.t) bytes x =
  let known = kinds h.src x in
  match Numbers.find_opt h.id known with
  | None when Numbers.cardinal known >= most_kinds -> x
  | before ->
    let count = 1 + Option.fold ~none:0 ~some:(fun e -> e.count) before in
    let entry = { count; order = h.order; payload = String.sub bytes Header.size h.size } in
    Numbers.add h.src (Numbers.add h.id entry known) x

let forget = Numbers.remove
let of_system id x = Numbers.bindings (kinds id x)
