include Tuple_space.Make (Value)
