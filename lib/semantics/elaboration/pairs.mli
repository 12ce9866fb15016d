(** Pairs of N: [post], [consume], [poll] and [count]. The matches of a pattern [{ x -> ... }] are found with the
    values of its key ({!Core.Values_of}), so patterns need no rule of their own. *)

val elaborate :
  Checks.env -> Dolphin_syntax.Location.t -> string -> Builtins.pairs -> Dolphin_syntax.Ast.argument list ->
  Core.expression
(** [elaborate env at name construct arguments] is the call of [construct], which the program spells [name]. *)

val check_key_of : Checks.env -> Dolphin_syntax.Ast.argument -> unit
(** [check_key_of env a] reports the key of the pair [a], if it cannot be one. *)

val check_own : Checks.env -> string -> Dolphin_syntax.Location.t -> unit
(** [check_own env k at] reports the key [k], spelled out at [at], if it is a key of [fresh]. *)
