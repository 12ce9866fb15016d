(** Values and task terms, as programs see them.

    {[
      open Dolphin_semantics

      let one = Core.Integer 1 and one_point = Core.Number 1.0

      let () =
        assert (Value.equals one one_point);
        assert (Value.compare one one_point <> 0);
        assert (Value.compare (Value.normal one) (Value.normal one_point) = 0);
        assert (Value.to_string (Core.Map [ ("depth", one) ]) = "[depth:1]")
    ]} *)

type t = Core.value

(** {1:order Order and equality of configurations} *)

val compare : t -> t -> int
(** A total order that distinguishes values that programs can distinguish, [1] and [1.0] among them. Closures are
    compared by the piece of program they come from and by their captured values. *)

val compare_task : Core.task -> Core.task -> int
(** As {!compare}; so is {!compare_closure}. *)

val compare_closure : Core.closure -> Core.closure -> int
(** A total order: by the piece of program, then by the captured values. *)

val compare_ensured : Core.ensured -> Core.ensured -> int
(** A total order of deeds of ends of tasks. *)

val compare_on_cut : Core.on_cut -> Core.on_cut -> int
(** A total order. *)

val hash : t -> int
(** Equal values have equal hashes. *)

val hash_closure : Core.closure -> int
(** Closures that are equal by {!compare_closure} have equal hashes. *)

val hash_ensured : Core.ensured -> int
(** Deeds that are equal by {!compare_ensured} have equal hashes. *)

(** {1:language As the language has it} *)

val vehicle_at : Core.vehicle list -> int -> t
(** [vehicle_at vs i] is the set of the [i]-th vehicle of [vs], from 0, which is less than their number. *)

val range_length : int -> int -> int
(** [range_length a b] is how many numbers the range from [a] to [b] has. *)

val equals : t -> t -> bool
(** [equals x y] is [x == y] in a program: numbers by their value, so that [1 == 1.0]; vehicle sets without regard to
    the order of picks, maps to that of keys. Parts that [x] and [y] share take no time, and repeated parts of each
    are compared once. *)

val canonical_number : t -> t
(** [canonical_number x] is the integer that [x] is, if [x] is a whole number, else [x]. *)

val canonical : t -> t
(** [canonical x] is [x] with numbers that are whole as integers. Tuples hold such values. *)

val normal : t -> t
(** [normal x] is the same for all [y] with [equals x y]: as {!canonical}, with vehicles and keys in alphabetical order.
    [equals x y] is [compare (normal x) (normal y) = 0]. *)

val is_alone : t -> bool
(** [is_alone x] is whether no other value with the same {!canonical} numbers equals [x]. *)

val truth : t -> bool
(** [truth x] is [x] as a condition: false are [null], [false], 0, and empty values. *)

val kind : t -> string
(** [kind x] is the kind of [x], with an article: ["a number"], ["a vehicle set"]. *)

val to_number : t -> float option
(** [to_number x] is [Some] for integers and numbers. *)

val items : t -> t array option
(** [items x] is the items of a loop over [x]: elements, numbers of a range, single vehicles, entries of a map (each
    a map with [key] and [value]), characters; [None] if [x] has no items, or is a range of more than {!most_items}
    numbers. *)

val made_at : Core.site -> t -> t
(** [made_at site x] is [x] with its platform tasks, those in lists and maps too, from [site]: as a host replies [x] to
    a call there. *)

val most_items : int
(** How long lists and strings may become, and a range that is made into a list: one million. A program that doubles a
    list in a loop must end in a fault, not without memory. *)

(** Of which a value has too much. *)
type excess = Parts | Depth

val deepest : int
(** The most lists and maps inside of each other, so that functions that recur over values have the stack for it. *)

val excess : most:int -> t -> excess option
(** [excess ~most x] is [None] if [x] has at most [most] parts, in all of its lists and maps, each counted as often as
    it stands there, and is nested at most {!deepest} deep. It takes [most] steps at most. *)

val has_at_most : int -> t -> bool
(** [has_at_most n x] is [excess ~most:n x = None]. It takes [n] steps at most. *)

val have_characters_at_most : int -> t list -> bool
(** [have_characters_at_most n xs] is whether the strings in [xs], in all of their lists and maps, have at most [n]
    bytes together, each counted as often as it stands there. *)

val length : t -> int option
(** [length x] is the number of items of [x]. *)

(** {1:text Text} *)

val to_string : t -> string
(** [to_string x] is [x] as [message] shows it: strings bare, [[1, 2]], [[k:v]], vehicle sets as [[a, b]]. *)

val amount : float -> string
(** A number of seconds as labels have it: six digits at most, as C's [%g] writes them, or as few more as read back as
    the same number. Whole ones have no point. *)

val pp : Format.formatter -> t -> unit
(** As a literal: strings in quotes, else as {!to_string}. *)

val until : Core.on_cut -> string
(** [until e] is ["until"] or ["assure"]. *)

val during : Core.on_cut -> string
(** [during e] is ["during"] or ["within"]. *)

val pp_ensured : Format.formatter -> Core.ensured list -> unit
(** As the statements between the braces of [ensure]. *)

val pp_tuple : Format.formatter -> string * t -> unit
(** ["k:x"]. *)
