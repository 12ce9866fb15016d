(** Errors in a vehicle's log book, each reported once. A vehicle may repeat an error every few seconds, whether or
    not it has to do with the plan: errors from before the plan are not reported, and no more than {!most} are. *)

open Dolphin_imc

type t

val none : t
(** Nothing was heard. *)

val hear : at_work:bool -> Message.Log_book_entry.t -> t -> string option * t
(** [hear ~at_work entry x] is the report on [entry], and [x] that has heard it. Nothing is reported unless
    [at_work], the vehicle running a plan of ours; nor are replies to requests: these are the words of a failure. *)

val most : int
(** 50. *)
