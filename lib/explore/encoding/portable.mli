(** States as strings that are the same in every process and complete: vectors of words contain numbers that each
    process assigns in the order of its search. Parts, of which a program has few, are written by a codec, each once
    in a process; a state has their names, which are digests of their texts. docs/successors.md has the format. *)

open Dolphin_semantics
open Dolphin_environment

exception Wrong of string
(** The error, in a sentence without a full stop. *)

exception Ambiguous
(** Two parts have the same name. *)

(** How parts are written: equal ones alike. *)
type 'a part = {
  write : 'a -> string;
  read : string -> 'a;  (** @raise Wrong *)
}

(** The writers and readers of all parts of states. *)
type codec = {
  machine : Machine.t part;
  residual : Residual.t part;
  shared : (Shared.t * Environment.t) part;  (** without A, which is in the residuals *)
  configuration : (Configuration.t * Environment.t) part;  (** one that executes nothing *)
}

type t

val create : ?digest:(string -> string) -> codec -> Encoding.t -> Components.t -> t
(** [create codec e components] knows no part. The space must have no symmetry. [digest] is of 8 bytes at least, by
    default [Digest.string]. *)

(** {1:parts Parts} *)

val give : t -> string -> unit
(** [give t text] makes [t] know the part [text].
    @raise Ambiguous *)

val news : t -> string list
(** [news t] is the parts that {!write} has named since the last call, and that [t] had neither written nor been given
    before. *)

(** {1:states States} *)

val write : t -> int array -> string
(** [write t key] is the state [key]. Exceptions of [codec] pass through, in {!read} too.
    @raise Ambiguous *)

val read : t -> int array -> string -> (Configuration.t * Environment.t) option
(** [read t key text] puts the words of the state [text] into [key], or is its configuration if that is an end. The
    parts that it names are known.
    @raise Wrong if it is not what {!write} gives for some state, or names a part that is not known
    @raise Layouts.Outgrown *)

val place : t -> int array -> string
(** [place t key] is a digest, of 16 bytes, of the place of the script at which state [key] is. *)
