(** Which leaves exclude each other: the tree of a problem, with its nodes by number, so that walks over it are loops
    and may be as deep as they like. The graph of exclusions is a cograph, and this is its cotree.

    Leaves are numbered from 0, left to right. *)

(** As {!Assignment.tree}. *)
type 'a tree = Leaf of 'a | Disjoint of 'a tree list | Shared of 'a tree list

type kind =
  | A_leaf of int  (** by its number *)
  | All_different  (** leaves in two branches exclude each other *)
  | Any  (** leaves in two branches may share *)

type t = private {
  parent : int array;  (** by node, -1 for the root, which is node 0 *)
  kind : kind array;  (** by node; each node comes after its parent and after its elder siblings *)
}

(** {1:make From trees, and parts of them} *)

val of_tree : 'a tree -> t * 'a array
(** [of_tree tree] is the cotree of [tree], and its leaves from left to right. *)

val restriction : t -> int array -> t
(** [restriction cotree] is a function that gives the cotree of some leaves alone, renumbered from 0 in the order of
    the array of them, which is ascending. In it every inner node has two children at least, of another kind. The
    function takes time by the leaves given to it and the nodes above them, not by all of [cotree]. *)

(** {1:walk Properties of leaves} *)

val bottom_up : t -> leaf:(int -> 'a) -> inner:(int -> kind -> 'a list -> 'a) -> 'a array
(** [bottom_up cotree ~leaf ~inner] is, by node, [leaf row] for leaf [row], and [inner node kind results] for others,
    from the [results] of their children, the eldest first. *)

val leaves : t -> int list array
(** [leaves cotree] is, by node, the leaves below, ascending. *)

val is_free : t -> bool array
(** [is_free cotree] is, by node, whether no node below, itself included, is [All_different]. *)

val simple_branches : t -> int list list option
(** [simple_branches cotree] is the leaves of each of the branches that exclude each other at the root, if no branch
    has an [All_different] inside. A root that is not [All_different] is one branch. *)

val exclusions : t -> int array array
(** [exclusions cotree] is, by leaf, the leaves that exclude it, ascending. *)

val cliques : t -> choice:int array -> int array array
(** [cliques cotree ~choice] is the leaves in parts, in each of which every two exclude each other; the first part is
    as large as can be. Leaves that [choice], by leaf, has less of come into the earlier parts. *)
