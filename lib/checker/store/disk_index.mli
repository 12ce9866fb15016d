(** The places of a file's states, by their hash: a hash table in a file, which is made part by part in memory. *)

type t

val create :
  directory:string -> states:int -> memory:(int, Bigarray.int_elt, Bigarray.c_layout) Bigarray.Array1.t ->
  ((int -> int -> unit) -> unit) -> t
(** [create ~directory ~states ~memory each] is for [states] states: [each f] calls [f i h] for each state [i] with its
    hash [h]. The length of [memory], which is written over, is a power of 2.
    @raise Disk_file.Failed *)

val find : t -> int -> (int -> bool) -> int
(** [find t h is_it] is the first state of hash [h] for which [is_it i], or [-1]. *)

val close : t -> unit
(** Closes its file, which is gone then. *)
