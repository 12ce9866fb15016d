(** Who is out there, listed on standard output: a table that changes on a terminal, else lines. *)

type t = {
  head : unit -> string;  (** above the table, on a terminal *)
  lines : json:bool -> string list;  (** what is known now *)
  patience : float;  (** so many seconds after the start everybody was heard of *)
}

val show : t -> Interruption.t -> as_json:bool -> once:bool -> seconds:float option -> unit Lwt.t
(** [show l interruption ~as_json ~once ~seconds] lists for [seconds], or until [interruption] happens. On a terminal
    it shows a table that changes, with [as_json] it prints a line each second; with [once], or elsewhere, it prints
    once, at the end. *)
