(** The command lines that start TLC. *)

(** How many threads search. *)
type workers = Automatic  (** one for each core *) | Workers of int

(** How TLC runs: in one process, or as the server of others. *)
type mode =
  | Local of workers
  | Server of { host : string; port : int }
  (** the server of TLC's distributed mode: [host] is the address under which workers on other machines find it, and
      [port] that of its registry. It computes no states itself. *)

val command :
  ?short:bool -> ?coverage:bool -> Installation.t -> mode -> directory:string -> main:string -> configuration:string ->
  string list
(** [command i m ~directory ~main ~configuration] explores the module [main] in [directory] under the file
    [configuration] in it. It is to be run in [directory], whose path must be absolute. The files of TLC (the queue,
    fingerprints, modules unpacked from its archive) go below [directory] too. Java reads files as UTF-8 and prints
    numbers as the English do, whatever the locale, and has room for deep recursion. With [short], false by default,
    Java spends less time on making code fast: for runs of some seconds. With [coverage], false by default, TLC
    counts what {!Action_counts} reads. *)

val worker : Installation.t -> host:string -> port:int -> string list
(** [worker i ~host ~port] works for the server there, with a thread for each core. *)
