(** The reachable vehicles, listed on standard output: a table that changes on a terminal, else lines. *)

type t = {
  head : unit -> string;  (** above the table, on a terminal *)
  lines : json:bool -> string list;  (** the present list *)
  patience : float;  (** the seconds from the start after which every vehicle was heard *)
}

val show : t -> Interruption.t -> as_json:bool -> once:bool -> seconds:float option -> unit Lwt.t
(** [show l interruption ~as_json ~once ~seconds] lists for [seconds], or until [interruption] happens. On a terminal
    it shows a table that changes, with [as_json] it prints a line each second; with [once], or elsewhere, it prints
    once, at the end. *)
