(** States as strings that are the same in every process, and tell all there is of a state: vectors of words have
    numbers, which each process gives out as it meets things. Parts, of which a program has few, are written by a codec,
    each once in a process. docs/successors.md has the format. *)

open Dolphin_semantics
open Dolphin_environment

exception Wrong of string
(** What is wrong, in a sentence without a full stop. *)

(** How parts are written: equal ones alike. *)
type 'a part = {
  write : 'a -> string;
  read : string -> 'a;  (** @raise Wrong *)
}

type codec = {
  machine : Machine.t part;
  residual : Residual.t part;
  shared : (Shared.t * Environment.t) part;  (** without A, which is in the residuals *)
  configuration : (Configuration.t * Environment.t) part;  (** one that executes nothing *)
}

type t

val create : codec -> Encoding.t -> Components.t -> t
(** There must be no symmetry. *)

val write : t -> int array -> string
(** [write t key] is the state [key]. What [codec] raises is raised, by {!read} too. *)

val read : t -> int array -> string -> (Configuration.t * Environment.t) option
(** [read t key text] puts the words of the state [text] into [key], or is its configuration if that is an end.
    @raise Wrong if it is not what {!write} gives for some state
    @raise Layouts.Outgrown *)

val place : t -> int array -> string
(** [place t key] is a digest, of 16 bytes, of the place of the script at which state [key] is. *)
