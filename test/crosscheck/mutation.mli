(** Does the comparison notice mistakes? Each of {!Mutant}'s is made in a copy of the specification, one at a time. *)

val all_apply : unit -> bool
(** Whether each mistake can be made: its pattern stands once in the text. If not, which do not is printed. *)

val run :
  Dolphin_tlc.Installation.t -> only:string -> limit:int -> batch:int -> small:Case.t list -> random:Case.t list ->
  dated:Dated.prepared list -> bool
(** [run i ~only ~limit ~batch ~small ~random ~dated] is whether each mistake with [only] in its name is noticed, of
    which a line is printed: first by the small programs, [batch] at a time, those with the fewest states first, then
    by random ones. Mistakes in checked properties rather than in compared graphs are looked for by TLC's own
    verdicts, those in [Timed.tla] by the dates of [dated]. *)
