(** Another program, run to its end. *)

type ending =
  | Exited of int  (** its status *)
  | Killed of int  (** by this signal, as OCaml numbers signals *)
  | Not_started of string  (** why *)

val run : ?directory:string -> interrupted:(unit -> bool) -> (string -> unit) -> string list -> ending
(** [run ~directory ~interrupted line (program :: arguments)] runs it in [directory], by default the current one,
    without input, and calls [line] for each line that it prints on standard output or standard error. When
    [interrupted ()], which is asked a few times a second, it gets a request to terminate, and is killed if it has
    not after three seconds. It is also killed if [line] raises. *)
