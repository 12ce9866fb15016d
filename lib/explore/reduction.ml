type t = Whole | Partial_order
