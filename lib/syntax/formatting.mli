(** Programs and fleets in one layout: four spaces a level, one blank between words, at most {!width} columns.
    Comments, and a person's line ends between statements and arguments, are kept; of several empty lines, one is.

    {[
      open Dolphin_syntax

      let () =
        let source = "UUVs=pick{count 2}  // the survey's vehicles" in
        let layout = "UUVs = pick { count 2 } // the survey's vehicles\n" in
        assert (Formatting.program ~file:"a.dol" source = Ok layout)
    ]} *)

val width : int
(** 120. *)

val program : file:string -> string -> (string, Diagnostic.t list) result
(** [program ~file source] is [source] in this layout, or what is wrong with it. The result spells the same program.
    [program] of its result is that result. Only comments and strings may go beyond {!width}. *)

val arranged : file:string -> string -> (string, Diagnostic.t list) result
(** [arranged ~file source] is [program ~file source] before it is read again to see that it is the same program; for
    tests, which see that it is. *)
