(** The general case: a search for any allocation, then for the fewest vehicles, then for the least cost, then for the
    first in pick order. *)

val solve :
  restricted:(int array -> Cotree.t) ->
  spent:int ref ->
  budget:int ->
  Part.candidates array ->
  Part.t ->
  (int array * bool, int list) result
(** [solve ~restricted ~spent ~budget candidates part] is an allocation of [part], the column of each row, and whether
    it is proven to be the best; or leaves that cannot all be served. To find an allocation, or that there is none,
    takes as many steps as it takes; to better it, or to find fewer leaves to blame, about [budget]. [restricted] and
    [candidates] are those that [part] was made from, by {!Part.make}. Adds its steps to [spent]. *)
