type t = Whole | Partial_order | Symmetry | All

let by_order = function Whole | Symmetry -> false | Partial_order | All -> true
let by_symmetry = function Whole | Partial_order -> false | Symmetry | All -> true
let without_symmetry = function Whole | Symmetry -> Whole | Partial_order | All -> Partial_order

let names = function
  | Whole -> []
  | Partial_order -> [ "partial order" ]
  | Symmetry -> [ "symmetry" ]
  | All -> [ "partial order"; "symmetry" ]
