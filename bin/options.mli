(** The common part of the command lines. *)

open Cmdliner

(** Terms of several options, as one record:

    {[
      let+ path = program and+ fleet = fleet in
      { path; fleet }
    ]} *)
module Syntax : sig
  val ( let+ ) : 'a Term.t -> ('a -> 'b) -> 'b Term.t
  val ( and+ ) : 'a Term.t -> 'b Term.t -> ('a * 'b) Term.t
end

val program : string Term.t
(** The file of the program, the first argument. *)

val fleet : string option Term.t
(** [--fleet FLEET]. *)

val set : (string * string) list Term.t
(** [--set NAME=VALUE], each time that it is given. *)

val set_range : (string * string) list Term.t
(** The same for a command that takes a range of values too. *)

val whole : docv:string -> string -> int Arg.conv
(** [whole ~docv what] is the whole numbers from 1 on; the error for others is that they are [what]. *)

val between : docv:string -> least:int -> most:int -> string -> int Arg.conv
(** [between ~docv ~least ~most what] is the whole numbers from [least] to [most]; others are not [what]. *)

val drawing : Dolphin_app.Drawing.t Arg.conv
(** The name of a picture. *)

val layers : string list Term.t
(** [--layer]: the maps that pictures have below the ways of vehicles. *)

val number : docv:string -> string -> (float -> bool) -> float Arg.conv
(** [number ~docv what accepts] is the numbers that [accepts]; others are not [what]. *)

val positive : docv:string -> float Arg.conv
(** Finite numbers greater than 0. *)

val from : string -> string option Cmdliner.Term.t
(** [from doc] is [--from RUN]: [doc] says to which purpose, and more is said of runs and of programs that changed. *)

val workers : doc:string -> int Term.t
(** [--workers N]: processes, by default the number of cores. *)

(** {1 Sections of the manual in which commands stand, by need} *)

val s_write : string
val s_prove : string
val s_run : string
val s_runs : string
val s_others : string
val s_setup : string

(** {1 Parts of every manual page} *)

val exits : Exit_status.t list -> Cmd.Exit.info list
(** The meaning of each of them, for a manual page. *)

val see_also : Manpage.block list
(** The end of every manual page. *)
