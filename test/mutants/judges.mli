(** The tests that judge mistakes in a folder of lib/, and how many of the drawn mistakes are made there. *)

type t = {
  folder : string;  (** from the root; with all below it, but for folders that have a row of their own *)
  weight : int;
  tests : string list;
  (** quickest first: executables without [.exe], from the folder [test], or aliases of dune, which begin with [@] *)
}

val all : t list
(** A folder comes before the folders that contain it. *)

val of_file : string -> t option
(** [of_file "lib/time/zone.ml"] is the row of [lib/time]. *)
