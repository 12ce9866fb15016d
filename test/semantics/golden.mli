(** Prints the results of each program of the file that is named on the command line: its faults, warnings too, or
    its run. Programs stand below lines [==== title]. No value of its own. *)
