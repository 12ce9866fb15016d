(** Prints what is said of each program of the file that is named on the command line: its faults, warnings too, or how
    it ran. Programs stand below lines [==== title]. No value of its own. *)
