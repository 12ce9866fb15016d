(** What is kept of a run: its journal and its picture. *)

open Dolphin_trace

type settings = {
  journal : string option;  (** a file *)
  drawing : Drawing_file.t option;
  header : Header.t;
}

val header : Program_file.t -> Fleet_file.t -> seed:int -> speed:float option -> Header.t
(** Of a run that starts now on the simulated fleet. *)

val is_wanted : settings -> bool
(** Whether anything is to be kept. *)

type t

exception Broken of string
(** The journal cannot be written any more: why, in a sentence without a full stop. *)

val start : settings -> Dolphin_semantics.Core.program -> (t, string) result
(** [start s program] begins the journal. The error says why that is not possible. *)

val resume : settings -> Dolphin_semantics.Core.program -> source:Header.source -> Resumed.t -> (t, string) result
(** [resume s program ~source run] goes on with the journal of [run], in its own file, or if [s] names another one, in a
    copy. [source] is the program's file. The error says why that is not possible: another console writes it, perhaps.
*)

val note : t -> time:float -> vehicle:string -> Yojson.Safe.t -> unit
(** Keeps what the platform wants to find again of a vehicle. It may raise {!Broken}. *)

val sync : t -> (unit -> unit Lwt.t) option
(** Resolves once all that was kept before is on the disk, and may fail with {!Broken}; [None]: there is no journal. *)

val observer : t -> Dolphin_runtime.Observer.t
(** To be told of the run before anybody else. It may raise {!Broken}. *)

val finish : t -> time:float -> stuck:bool -> (unit, string) result
(** The run is over: ends the journal, and draws. The error says what could not be written. *)
