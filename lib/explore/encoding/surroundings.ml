open Dolphin_semantics
open Dolphin_environment

type t = { shared : Shared.t; outside : Environment.t }

let make (shared : Shared.t) outside = { shared = { shared with allocation = Vehicle_map.empty }; outside }
let equal a b = Environment.compare a.outside b.outside = 0 && Shared.equal a.shared b.shared
let hash s = Order.mix (Shared.hash s.shared) (Environment.hash s.outside) land max_int

module Numbers = Dolphin_checker.Interner.Make (struct
    type nonrec t = t

    let equal = equal
    let hash = hash
  end)
