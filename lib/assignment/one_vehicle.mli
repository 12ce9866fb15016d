(** The problems that most programs have: if the branches exclude each other, and one vehicle each is possible, nothing
    needs fewer vehicles, and the rest is {!Matching}. *)

val solve :
  restricted:(int array -> Cotree.t) ->
  spent:int ref ->
  Part.candidates array ->
  int array ->
  ((int * int) list option, int list) result
(** [solve ~restricted ~spent candidates leaves] is the best allocation of [leaves], as {!Part.make} takes them: each
    leaf with its vehicle. It is [None] if that is not decided here: branches have an exclusion inside, or cannot all at
    once be served by one vehicle each. The error is the first leaves of branches that have too few vehicles, if the
    leaves of each are one, as for {!Part.make}. Adds its steps to [spent]. Memory is that of
    {!Costs.make} for branches and vehicles. *)
