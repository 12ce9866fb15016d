(** The common part of the lines of both directions: objects with a [kind]. *)

open Dolphin_json

val version : int
(** 1 *)

val longest : int
(** 1 MiB. *)

val read : 'a Codec.variant list -> string -> ('a option, string) result
(** [read variants text] is the line [text]; [None]: its kind is not among [variants]. The error is in words that follow
    the line's name: ["is not JSON: ..."], ["is not a valid 'done': ..."]. *)

(** {1:fields Members} *)

val seconds : float Codec.t
(** A number that is not negative. *)

val request : string Codec.t
(** A text of 1 to 64 bytes. *)

val protocol : unit -> int Codec.t
(** A version of the protocol, from 1. *)
