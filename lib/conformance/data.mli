(** The common part of the writers and readers of configurations. Readers raise {!Wrong}, which [Snapshot] catches;
    public functions give results. *)

type json = Yojson.Safe.t
(** JSON of any shape. *)

exception Wrong of string
(** The fault, in a sentence without a full stop. *)

exception Too_large
(** The value has more parts than fit a line. *)

type budget
(** How much may still be written. A task that shares its parts with itself may be small in memory and huge as text. *)

val budget : unit -> budget
(** The limit of one line. *)

val part : budget -> (unit -> json) -> json
(** [part budget write] is [write ()], one part of the whole, with its own parts inside.

    @raise Too_large if there are too many parts, or they nest so deep that readers might refuse them. *)

val wrong : string -> json -> 'a
(** [wrong what json] raises {!Wrong}: [json] is not [what]. *)

val tagged : string -> json list -> json
(** [tagged name parts] is the list of [name] and [parts]. *)

val whole : json -> int
(** These read a number, a text, a truth value, a list whose elements [read] reads, a list of two.
    @raise Wrong if it is something else; so do the others. *)

val text : json -> string
(** A text. *)

val truth : json -> bool
(** [true] or [false]. *)

val list : (json -> 'a) -> json -> 'a list
(** [list read] is an array, each element read by [read]. *)

val pair : (json -> 'a) -> (json -> 'b) -> json -> 'a * 'b
(** [pair read read'] is an array of two, the first read by [read] and the second by [read']. *)

val of_list : ('a -> json) -> 'a list -> json
(** These write what the readers of that name read. *)

val of_pair : ('a -> json) -> ('b -> json) -> 'a * 'b -> json
(** An array of two. *)

val of_option : ('a -> json) -> 'a option -> json
(** [null] for [None]. *)

val option : (json -> 'a) -> json -> 'a option
(** [null] is [None]: not for values that may be [null] themselves. *)

val of_float : float -> json
(** With all of its digits; a number that JSON lacks is ["nan"], ["inf"] or ["-inf"]. *)

val float : json -> float
(** The number that {!of_float} wrote. *)
