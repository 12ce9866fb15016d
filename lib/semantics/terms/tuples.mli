(** N for the values of the language; they are kept {!Value.canonical}. *)

include Tuple_space.S with type value = Core.value
