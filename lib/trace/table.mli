(** A journal as a page of text: a column for the program and for each vehicle that it picked, time going down.

    {v
   time  program          noptilus-1     x8-02
   0:00  picks            picked
   0:00                   ┌ survey1
   4:11  posts ready:1    └ done
   4:11  consumes ready:1                ┌ rv1
    v} *)

val print : Format.formatter -> Entry.t list -> unit
(** [print ppf entries] prints a whole journal. With more vehicles than fit side by side there is one column for all,
    and one for the vehicle. *)

val most_columns : int
(** The number of vehicles that fit: 8. *)

val print_transitions : Format.formatter -> Entry.t -> unit
(** [print_transitions ppf entry] prints a transition in full, on one line: index, time, place, rules, label; other
    entries not at all. *)
