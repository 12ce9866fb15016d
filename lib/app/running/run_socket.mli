(** The socket of a run, beside its journal: how other programs post to the run, follow it, stop it and replace
    its program. docs/socket.md has the protocol. Nothing else that clients do changes the run. *)

open Dolphin_semantics
open Dolphin_runtime

(** The permissions of clients. *)
type run = {
  program : unit -> Program_file.t;  (** that runs now *)
  inputs : Inputs.t;
  now : unit -> float;
  stop : unit -> unit;  (** as Ctrl-C does *)
  replace : ?set:(string * string) list -> ?hash:string -> string -> (float, Replacement.refusal) result Lwt.t;
  (** {!Replacement.replace} *)
}

type t

val open_ : run -> journal:string -> (t, string) result
(** [open_ run ~journal] serves clients from now on, of the user only: the socket has mode 0600. The journal is locked
    by this process. The error is a sentence: the run goes on without. *)

val journal_grew : t -> unit
(** Followers get a message. *)

val close : t -> unit Lwt.t
(** [close s] gives followers what is left of the journal, as far as they read on, and removes the socket. *)

(** {1:clients Clients} *)

type connection
(** A connection to the socket of a run that goes on. *)

val connect : journal:string -> (connection, string) result
(** [connect ~journal] is a connection to the run with this journal, or a sentence why there is none. *)

val ask : connection -> Socket_message.request -> (Socket_message.reply, string) result
(** [ask c request] is the reply to [request]; the error is its error text. *)

val status : connection -> (Socket_message.status, string) result
(** [status c] is what the run is. *)

val post : connection -> string -> Core.value -> (float, string) result
(** [post c key x] posts a pair: at which time of the run it was taken. *)

val replace : connection -> set:(string * string) list -> hash:string -> string -> (float, string) result
(** [replace c ~set ~hash path] makes the run go on with the program [path], an absolute path: at which time of the run
    it did. *)

val copy : connection -> out_channel -> unit
(** [copy c out] copies what comes, line by line, until the other end is done. *)
