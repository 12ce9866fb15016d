(** Trees as numbers, which are equal for trees that differ only in names and in the order of unordered parts. Names
    that are alike are distinguished by their surroundings: that finds no canonical order in all cases, so that trees
    may have different numbers although they are equal but for names. *)

type numbers
(** Trees have numbers in one of these. *)

val numbers : Dolphin_checker.Numbering.t -> numbers
(** [numbers n] has given no number; its numbers are of the numberings [n]. *)

type tree
(** A tree with its number, in one table of {!numbers}. *)

val tree : numbers -> ?item:int -> ?names:int list -> ?ordered:bool -> int -> tree list -> tree
(** [tree ns ~item ~names ~ordered head parts] is a tree, by default without an item and without names, and in order.
    Heads that are equal have equally many names. Names below 0 stand for themselves. Each item is in the tree once. *)

type t = {
  number : int;
  items : int list;  (** those of the tree, in an order that trees with this number have in common *)
}

val make :
  numbers -> orbits:int array -> colors:int array -> colored:bool -> placed:(int * int) list -> int list -> tree -> t
(** [make ns ~orbits ~colors ~colored ~placed constants t] is the form of [t] with other data for equality:
    [constants], and names with a place each. Names are places in [orbits]; those of different orbits, which are
    below twice the number of names, are never taken for each other. Among parts that differ in names alone, the
    order is by the colors of items, which are part of the number if it is [colored]. *)
