type t = Whole | Vehicles | Partial_order | Symmetry | All

let by_order = function Whole | Vehicles | Symmetry -> false | Partial_order | All -> true
let by_symmetry = function Whole | Partial_order -> false | Vehicles | Symmetry | All -> true
let without_symmetry = function Whole | Vehicles | Symmetry -> Whole | Partial_order | All -> Partial_order

let names = function
  | Whole | Vehicles -> []
  | Partial_order -> [ "partial order" ]
  | Symmetry -> [ "symmetry" ]
  | All -> [ "partial order"; "symmetry" ]
