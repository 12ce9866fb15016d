type t = int list

let make n = List.init n Fun.id
let is_empty (x : t) = x = make 0
let _ = is_empty
