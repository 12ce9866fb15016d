(** The holdings of a console, as it announces them to other consoles: the vehicles that its program has picked. IMC
    has no message for this. EntityParameters named {!name} is ignored by vehicles and by consoles that did not ask
    for parameters. *)

open Dolphin_semantics
open Dolphin_imc

type t = {
  program : string;  (** the file's name; [""] if not known *)
  run : string;  (** which run of the program: the identity in its journal, which copies share; [""] if none *)
  resuming : bool;
  (** it was resumed or slept, listens whether the run lives elsewhere, and commands nothing meanwhile *)
  vehicles : Core.vehicle list;
}

val name : string
(** ["dolphin.holds"]. *)

val patience : float
(** 5 s: a console that has not repeated its claim for this time is gone. Claims are repeated every second. *)

val to_message : t -> Message.t
(** The message that announces it. *)

val of_message : Message.Entity_parameters.t -> t option
(** [None] if it is not a claim. *)

val obstacle : console:string -> t -> string
(** Why others cannot be given a plan: ["is held by the program rendezvous.dol of ccu-7"]. *)
