(** Dates that are as late, or as early, as bounds on their differences allow. *)

(** A bound on the difference of two dates, which are given by their numbers. *)
type 'a bound = {
  sooner : int;
  later : int;
  by : int;  (** the date [later] is at most this much after [sooner]; it may be negative *)
  due_to : 'a option;  (** why *)
}

val at_most : ?due_to:'a -> int -> after:int -> int -> 'a bound
(** [at_most later ~after:sooner by]. *)

val at_least : ?due_to:'a -> int -> after:int -> int -> 'a bound
(** [at_least later ~after:sooner by] is that [later] is [by] after [sooner] or more. *)

exception Contradiction
(** No dates meet the bounds. *)

val latest : int -> 'a bound list -> int option array * 'a bound option array
(** [latest n bounds] is the latest dates 0 to [n] that meet [bounds], date 0 being 0; [None] without latest ones. With
    each comes the last bound on a shortest way there. (Bellman and Ford)
    @raise Contradiction if no dates meet [bounds] *)

val earliest : int -> 'a bound list -> int option array
(** The earliest ones in the same way. *)

(** The intended time between two dates, by their numbers. *)
type span = Long of int * int | Short of int * int

val stretched : int -> 'a bound list -> span list -> int option array
(** [stretched n bounds spans] is dates that meet [bounds], in which each of [spans] in turn is as long, or as short, as
    those before it in the list allow. *)
