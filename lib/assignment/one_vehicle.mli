(** The problems that most programs have: if the branches exclude each other, and one vehicle each is possible, nothing
    needs fewer vehicles, and the rest is {!Matching}. *)

val solve : spent:int ref -> Part.t -> Part.outcome
(** [solve ~spent part] is the best allocation of [part], if its branches have no exclusion inside and can, all at once,
    be served by one vehicle each. It is [Impossible] if branches of a single row have too few vehicles, and otherwise
    [Undecided]. Adds its steps to [spent]. *)
