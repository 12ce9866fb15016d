(** A copy of the tree, where mistakes are built and judged. *)

type t

val with_copy : (t -> 'a) -> 'a
(** [with_copy f] copies the tree of the working directory, without what is built, and removes the copy afterwards. The
    variable [COPY] names a folder where the copy is made, and kept for the next time: then little has to be built. *)

type verdict =
  | Noticed of string  (** by this test: it failed, or ran out of time or memory *)
  | Passed  (** by all tests that pass without the mistake *)
  | Not_built

val judge : t -> file:string -> string -> tests:string list -> verdict
(** [judge copy ~file text ~tests] is the verdict of [tests], in this order until one notices it, on the tree in which
    [file] has the contents [text]. A test that notices a mistake runs without it too, once; if it fails there, it is
    reported on standard output and judges nothing. Unused values are no errors in the copy. *)

val source : t -> string -> string
(** [source copy file] is the contents of [file] in the copy. *)

val read : string -> string
(** The contents of a file. *)
