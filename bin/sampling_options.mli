(** [dolphin exec --runs]: many simulated runs instead of one. *)

open Cmdliner
open Dolphin_app

type t

val wanted : t option Term.t
(** [--runs], [--until], [--runs-from], [--jobs], [--json], [--each]; [None] unless one of the first three is given. *)

val s_many : string
(** The section of the manual that has these options. *)

val run :
  t -> drawing:Drawing.t option -> seed:int option -> answers:string list -> Program_file.t -> Fleet_file.t ->
  (Exit_status.t, Error.t) result
(** Makes the runs, or reads them, prints the report, and draws when they are over. *)
