(** The general case: a search for any allocation, then for the fewest vehicles, then for the least cost, then for the
    first in pick order. *)

val solve :
  restricted:(int array -> Cotree.t) ->
  spent:int ref ->
  budget:int ->
  Part.candidates array ->
  Part.t ->
  (int array * bool, int list) result
(** [solve ~restricted ~spent ~budget candidates part] is an allocation of [part], the column of each row, and
    whether it is proven to be the best; or leaves that cannot all be served. Finding an allocation, or that none
    exists, is unlimited; improving it, or finding fewer leaves to blame, takes about [budget] steps. [restricted]
    and [candidates] are those that [part] was made from, by {!Part.make}. Adds its steps to [spent]. *)
