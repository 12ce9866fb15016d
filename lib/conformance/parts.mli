(** Configurations in parts, each as one text that is the same in every process: equal parts have equal texts. *)

open Dolphin_semantics

exception Too_large
(** A part is too large to be written, as a task is that a loop doubles again and again. *)

type 'a t = {
  write : 'a -> string;  (** @raise Too_large *)
  read : string -> ('a, string) result;  (** the error is a sentence without a full stop *)
}

val machine : Nodes.t -> Machine.t t
(** The script's machine. *)

val residual : Nodes.t -> Residual.t t
(** An executing task. *)

val shared : Nodes.t -> Core.program -> Shared.t t
(** The shared part. *)

val configuration : Nodes.t -> Core.program -> Configuration.t t
(** For an end by an error, the kind of error is left out, as in {!Configuration.compare_ending}. *)
