(** What this machine has of what Dolphin may want. *)

type finding = {
  subject : string;  (** ["TLC"] *)
  found : string;  (** what is there, or what is wrong *)
  advice : string option;  (** what to do, if something is missing *)
  is_needed : bool;  (** whether programs cannot be run without it *)
}

val examine : page:string option -> finding list
(** Looks at the clocks, sockets, multicasts, the user's folder of runs, the built page of the console, which [page]
    is the folder of, and TLC. Sends nothing, and leaves nothing behind. *)
