(** The branches of a [|], in their order. A branch is found by what it waits for: of many that have begun, by an
    index. Its cost is logarithmic, as is that of a change. *)

type 'a t

(** A property of branches by which they are found. *)
type mark =
  | Alone  (** may take a step by itself *)
  | Recruits  (** waits for some vehicle *)
  | End_on of string  (** waits for the end of a task of this vehicle *)
  | Number of int  (** waits for the timer, the answer or the vehicle of this number *)
  | Within  (** has an index of its own, of all but [Alone] *)

val compare_marks : mark -> mark -> int
(** A total order of marks. *)

val of_list : 'a list -> 'a t
(** [of_list rs] has the branches [rs], without an index. *)

val begun : marks:('a -> mark list) -> 'a list -> 'a t
(** [begun ~marks rs] has the branches [rs], with an index by [marks] if they are many. *)

val to_list : 'a t -> 'a list
(** The branches, from left to right. *)

val only : 'a t -> 'a option
(** [only bs] is the branch of [bs], if there is no other. *)

val is_indexed : 'a t -> bool
(** Whether it has an index: there are many branches, and they have begun. *)

(** {1:places Places} *)

type 'a place
(** The place of a branch among the others. *)

val places : 'a t -> ('a * 'a place) Seq.t
(** [places bs] is all branches of [bs] with their places, from left to right. *)

val marked : (mark -> 'a -> bool) -> mark -> 'a t -> ('a * 'a place) Seq.t
(** [marked has m bs] is those of [places bs] whose branches [has m]. An index replaces [has], except for branches with
    an index of their own. *)

val beside : 'a place -> 'a list
(** [beside p] is the other branches, from left to right. *)

val put : marks:('a -> mark list) -> 'a place -> 'a list -> 'a t
(** [put ~marks p rs] is the other branches with [rs] at [p], with an index by [marks] if they are many. All have
    begun. *)
