(** The files of [templates/mission], as texts: the build makes this module of them. *)

val program : string
(** The program. *)

val fleet : string
(** Its fleet. *)

val readme : string
(** The README. *)

val check : string
(** The script that checks the program. *)

val workflow : string
(** The workflow of GitHub that calls the script. *)
