(** The optional software and settings of this machine. *)

type finding = {
  subject : string;  (** ["TLC"] *)
  found : string;  (** the installed version, or the fault *)
  advice : string option;  (** the remedy, if it is missing *)
  is_needed : bool;  (** whether programs cannot be run without it *)
}

val examine : page:string option -> finding list
(** Looks at the clocks, sockets, multicasts, the user's folder of runs, the built page of the console, which [page]
    is the folder of, and TLC. Sends nothing, and leaves nothing behind. *)
