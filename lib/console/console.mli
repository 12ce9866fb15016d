(** The server of [dolphin console]: runs of programs of a folder, for pages in browsers and for programs, by the
    interface that [docs/api.md] describes. It has no logic of missions: it calls the libraries that the other commands
    call. *)

open Dolphin_app

(** The options of a console. *)
type settings = {
  folder : Folder.t;
  run : Run.settings;  (** of all runs: the platforms, the supplier *)
  fleet : string option;  (** a path; [None]: of each program the one beside it *)
  dolphin : string;  (** the command of worker processes *)
  page : Page.t;
  tiles : string option;  (** where the map has tiles from, {!Access.check_tiles}; [None]: it has none *)
  listen : Unix.inet_addr option;  (** the address that is served, with tokens; [None]: 127.0.0.1, without *)
  certificate : Certificate.t option;  (** connections are encrypted *)
  operators : Operators.operator list;  (** who may use it if it listens for other machines or a proxy *)
  proxy_header : string option;  (** {!Access.check_proxy_header}: a proxy on this machine names the operators *)
  version : string;  (** of Dolphin *)
  workers : Worker_pool.limits;  (** of the processes that compute for requests *)
}

type t

val start : settings -> port:int -> (t, string) result
(** [start s ~port] serves from now on; port 0 is any free one. *)

val port : t -> int
(** The port that is served: a free one if 0 was asked for. *)

val name : Unix.inet_addr option -> string
(** [name listen] is the host name or address in the links of a console that listens there. *)

val links : t -> (string * string) list
(** Where pages find it: the address; or, without a proxy, one for each operator, with ["steers"], ["watches"], or
    ["ana, who steers"]. *)

val busy : t -> bool
(** Whether a run goes on. *)

val close : t -> unit Lwt.t
(** Stops the run, if one goes on, waits until its vehicles are released, and ends. *)

val workers : t -> int list
(** The processes that compute for requests. *)
