(** The attendance of a pick, with late or missing vehicles: each possible result, by as few late and missing
    vehicles as can be, and nothing twice. docs/explorer.md shows why this is enough. *)

open Dolphin_semantics

type t = {
  coming : Core.vehicle list;  (** those that come after all others, in this order *)
  missing : Core.vehicle list;
}

type company
(** The vehicles that a pick may look for. *)

val company :
  ?alike:(Core.vehicle -> Core.vehicle option) ->
  ?only:Core.vehicle list ->
  Faults.t ->
  may_be_late:(Core.vehicle -> bool) ->
  lost:Core.vehicle list ->
  late:Core.vehicle list ->
  bound:Core.vehicle list ->
  World.t ->
  Settings.pick ->
  company
(** [company ~alike ~only faults ~may_be_late ~lost ~late ~bound w q] is those that [q] may look for in [w] while
    [bound] are in B. The [lost] may be missing, others only as [faults] has it; [late] are those that were late before.
    Two vehicles for which [alike] is the same [Some] may be exchanged: of attendances that differ only in these, one is
    given, with as few that are late as can be. They are of the same kind, may both be late, neither is lost or was
    late, and no other stands between them in [w]. With [only], attendances in which other vehicles than [only] are
    bound are left out, but for those that stand outside of the region where they may be seen. *)

val unsure : company -> Core.vehicle list
(** Those that are not lost, and may be late or missing. *)

val first_always : company -> int -> Core.vehicle list option
(** [first_always c n] is the first [n] of those that the pick would take wherever they may be seen; [None] if there are
    fewer. *)

val number_of_new : company -> Core.vehicle list -> int
(** [number_of_new c vs] is how many of [vs] count if they are late or missing: the {!unsure} that never were before. *)

val costs : company -> int Seq.t
(** How many of these there may be, from 0 on. *)

(** {1:ways Ways to attend}

    Each with exactly [n] that count, computed on demand. *)

val with_latecomers : company -> int -> int -> (Core.vehicle list * Core.vehicle list) Seq.t
(** [with_latecomers c count n] is the vehicles that a pick of [count] vehicles may bind with some of them late:
    first those that come in the order of the fleet, then the late ones, at least one. *)

val too_few : company -> int -> Core.vehicle list Seq.t
(** [too_few c count] is the missing vehicles if fewer than [count] come: each choice of those that count, as few as
    can be; none if more would have to miss than may. *)

val of_all : company -> int -> t Seq.t
(** [of_all c n] is the ways to attend a pick of all vehicles. *)
