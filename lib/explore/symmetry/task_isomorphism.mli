(** Isomorphism of residuals: equality up to names on which no step depends (of vehicles, plans, timers, places in
    the text, texts for people), up to the order of parallel parts, and up to a renaming of pairs of N. It is decided
    by comparing keys, which spell out all the rest. *)

open Dolphin_semantics
open Dolphin_environment

type context
(** The data that comparisons of one program's tasks share. Mutable. *)

val context : Dolphin_checker.Numbering.t -> Environment.options -> Core.program -> context
(** [context n o p] is for tasks of [p] in the environment [o]; its numbers are of the numberings [n]. *)

val skeletons : context -> Skeleton.context
(** The skeletons of the program's code. *)

(** {1:labels Labels} *)

(** A name on which no step depends; it only identifies the code that a run reaches. *)
type label = Task of Core.site | Code of int  (** by the number of its lambda *)

val labels : Residual.t -> label list
(** In the order of the text. *)

val closures : Residual.t -> (bool * Core.closure) list
(** All code of the residual, each with whether it is an error handler. *)

val pairs : context -> Residual.t -> int array
(** The pairs that its code names ({!Skeleton.pair}), in the order of the text. *)

(** {1:keys Keys} *)

val key : context -> sorted:bool -> pair:(int -> string) -> label:(label -> string) -> Residual.t -> string
(** [key c ~sorted ~pair ~label r] is the same for residuals that are equal but for names, if pairs count as equal
    when [pair] is, and labels when [label] is. If it is [sorted], the order of parallel parts does not count. *)

val matched : context -> rename:(int -> int) -> Residual.t -> Residual.t -> (label * label) list option
(** [matched c ~rename r r'] is an isomorphism from [r] to [r'] that renames pairs by [rename], given as the images
    of the labels of [r]; [None] if there is none. *)
