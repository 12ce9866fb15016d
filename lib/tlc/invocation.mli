(** The command lines that start TLC. *)

(** How many threads search. *)
type workers = Automatic  (** one for each core *) | Workers of int

type mode =
  | Local of workers
  | Server of { host : string; port : int }
  (** the server of TLC's distributed mode: [host] is the address under which workers on other machines find it, and
      [port] that of its registry. It computes no states itself. *)

val main_module : string
(** ["MC"]: the module that TLC is given, in its file ["MC.tla"]. *)

val command : Installation.t -> mode -> directory:string -> configuration:string -> coverage:bool -> string list
(** [command i m ~directory ~configuration ~coverage] explores the model in [directory] under the file [configuration]
    in it. What TLC writes (the queue, fingerprints, modules unpacked from its archive) goes below [directory] too.
    Java reads files as UTF-8 and prints numbers as the English do, whatever the locale, and has room for deep
    recursion. *)

val worker : Installation.t -> host:string -> port:int -> string list
(** [worker i ~host ~port] works for the server there, with a thread for each core. *)
