(** Residuals up to names: of vehicles, plans, timers, places in the text, texts for people, and of the order of what
    stands
    side by side. Whether two are alike is decided by comparing keys, which say all that can matter to a run. *)

open Dolphin_semantics
open Dolphin_environment

type context

val context : Environment.options -> Core.program -> context
val patterns : context -> Skeleton.context

(** {1:labels Labels} *)

(** Names that do not matter, but for which code a run reaches. *)
type label = Task of Core.site | Code of int  (** by the number of its lambda *)

val labels : Residual.t -> label list
(** In the order of the text. *)

val closures : Residual.t -> (bool * Core.closure) list
(** All code of the residual, each with whether it is a handler. *)

val pairs : context -> Residual.t -> int array
(** The pairs that its code names, by {!Skeleton.pair}, in the order of the text. *)

(** {1:keys Keys} *)

val key : context -> sorted:bool -> pair:(int -> string) -> label:(label -> string) -> Residual.t -> string
(** [key c ~sorted ~pair ~label r] is the same for residuals that are alike if pairs with the same [pair] and labels
    with the same
    [label] are. If it is [sorted], the order of what stands side by side does not matter. *)

val matched : context -> rename:(int -> int) -> Residual.t -> Residual.t -> (label * label) list option
(** [matched c ~rename r r'] is which label of [r] becomes which of [r'], if [r] becomes [r'] by renaming its pairs,
    its names, and
    by changing the order of what stands side by side; [None] if it does not. *)
