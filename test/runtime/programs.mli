(** Core programs built by hand, for tests. *)

open Dolphin_semantics.Core

val constant : value -> expression
val string : string -> expression
val number : float -> expression
val apply : operation -> expression list -> expression
val call : builtin -> expression list -> expression
val global : int -> expression
val set_global : int -> expression -> expression
val block : expression list -> expression
val loop : expression -> expression -> expression
val method_of : expression -> string -> expression list -> expression
val property : expression -> string -> expression

val code : expression -> expression
(** [{ e }], a closure without parameters. *)

val handler : expression -> expression
(** The code of an [onError]. *)

val task : string -> expression
val sequence : expression -> expression -> expression
val parallel : expression -> expression -> expression

val repeat : int -> (int -> 'a) -> 'a list
(** [repeat n f] is [[f 1; ...; f n]]. *)

val below : expression -> expression -> expression
(** [e < e']. *)

val pick_all : ?timeout:float -> unit -> expression
val pick : int -> expression

val program : ?reads_sensors:bool -> ?reads_now:bool -> ?globals:int -> expression list -> program
(** The program with this script. *)

val on_interrupt : expression -> program -> program
(** [on_interrupt t p] is [p], which executes [t] when it is interrupted. *)
