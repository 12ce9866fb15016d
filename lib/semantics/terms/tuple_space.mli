(** N, the tuple space: a multiset of pairs key:value. Values are equal here if they are for programs.

    Only [consume k:_], which takes the oldest pair with key [k], depends on the order of posts. So a space gets, when
    it is made, the keys that are consumed like that, and remembers an order for these alone: two spaces that no program
    can distinguish are equal, with any histories.

    Spaces are immutable plain data, without functions inside. Compare and hash them with {!S.compare}, {!S.equal}
    and {!S.hash}, never with the polymorphic operations: equal spaces may be laid out differently in memory.

    {[
      open Dolphin_semantics

      let post key number = Tuples.post key (Core.Integer number)
      let space = Tuples.empty Tuple_space.(keys [ "ready" ]) |> post "ready" 2 |> post "ready" 1

      let () =
        assert (Tuples.poll "ready" (Integer 1) space);
        match Tuples.consume_oldest "ready" space with
        | Some (value, rest) -> assert (value = Integer 2 && Tuples.cardinal rest = 1)
        | None -> assert false
    ]} *)

(** Which keys keep their pairs in order of arrival: the named ones, and those that begin with one of the prefixes. *)
type order = private { named : string list; prefixes : string list }

val no_key : order
(** Selects no key. *)

val keys : string list -> order
(** [keys ks] selects [ks]. Repetitions and the order of [ks] do not matter. *)

val every_key : order
(** For programs that compute the key of a [consume k:_]. *)

val with_prefix : string -> order -> order
(** [with_prefix p order] selects the keys of [order], and all that begin with [p]. *)

val keeps_order : order -> string -> bool
(** [keeps_order order k] is whether [order] selects [k]: pairs with key [k] are taken in order of arrival. *)

(** The operations that values must offer. *)
module type VALUE = sig
  type t

  val compare : t -> t -> int
  (** A total order. *)

  val hash : t -> int
  (** Equal for equal values. *)

  val normal : t -> t
  (** [normal x] is the same for all values that programs take for equal. *)

  val pp : Format.formatter -> t -> unit
  (** A value as messages show it. *)
end

(** Metavariables: [k] is a key, [x] a value, [n] a space. Costs: [p] is the number of pairs with key [k]. *)
module type S = sig
  type value
  (** The values of pairs. *)

  type t

  val empty : order -> t
  (** [empty order] is the space without pairs, in which [order] selects the ordered keys. *)

  val is_empty : t -> bool
  (** [is_empty n] is [cardinal n = 0]. *)

  val cardinal : t -> int
  (** The number of pairs, each as often as it is there; in constant time. *)

  val is_ordered : string -> t -> bool
  (** [is_ordered k n] is whether [n] remembers the order of its pairs with key [k]. *)

  val post : string -> value -> t -> t
  (** [post k x n] is [n] with one pair [k:x] more, the youngest. Time: log p. *)

  val consume : string -> value -> t -> t option
  (** [consume k x n] is [n] without its oldest pair [k:x], or [None] if it has none. Time: log p; p for ordered
      keys. *)

  val consume_oldest : string -> t -> (value * t) option
  (** [consume_oldest k n] is the value of the oldest pair with key [k], and [n] without that pair; [None] without such
      a pair. Time: log p.

      @raise Invalid_argument if [k] is not ordered, since its order was not kept. *)

  val without : string -> t -> t
  (** [without k n] is [n] without its pairs with key [k]. *)

  val keys_with : string -> t -> string list
  (** [keys_with prefix n] is the keys of [n] that begin with [prefix], ascending. Time: log p for each. *)

  val poll : string -> value -> t -> bool
  (** [poll k x n] is whether [n] has a pair [k:x]. Time: log p; p for ordered keys. *)

  val poll_any : string -> t -> bool
  (** [poll_any k n] is whether [n] has a pair with key [k]. *)

  val values : string -> t -> value list
  (** [values k n] is the values of the pairs of [k]: oldest first if [k] is ordered, else in their order. *)

  val bindings : t -> (string * value list) list
  (** The keys that have pairs, ascending, each with its values, as often as they are there: the oldest first, as
      they were posted, if the key is ordered; ascending and normal if not. *)

  val kept : string -> value -> t -> value
  (** [kept k x n] is [x] as {!bindings} of [post k x n] has it: normal, unless [k] is ordered. *)

  val changed : before:t -> after:t -> (string * value list) list * (string * value list) list
  (** [changed ~before ~after] is the {!bindings} of [before] and of [after] for the keys whose pairs are not physically
      the same in both, with [[]] for a key without pairs: fast if [after] was made from [before] by few changes. *)

  val equal : t -> t -> bool
  (** [equal n n'] is whether [n] and [n'] order the same keys and have the same {!bindings}. *)

  val compare : t -> t -> int
  (** A total order in agreement with {!equal}. *)

  val hash : t -> int
  (** Equal for equal spaces. *)

  val pp : Format.formatter -> t -> unit
  (** ["{k:x, k:x', k':x}"], in the order of {!bindings}. *)
end

(** Spaces of these values. *)
module Make (Value : VALUE) : S with type value = Value.t
