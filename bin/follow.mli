(** [dolphin exec --follow]: a recorded run, once more. *)

val run : Program_file.t -> Dolphin_scenario.Scenario.t -> string -> Exit_status.t
(** [run program scenario path] takes the steps that the file [path] records and prints the log of what happens, with
    the numbers of the steps where times would be. *)
