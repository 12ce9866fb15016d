module Int_map = Map.Make (Int)

type t = Core.value Int_map.t

let empty = Int_map.empty
let find = Int_map.find_opt
let set = Int_map.add
let compare a b = if a == b then 0 else Int_map.compare Value.compare a b
let hash store = Int_map.fold (fun i x h -> (((h * 31) + i) * 65599) + Value.hash x) store 17
let bindings = Int_map.bindings
