(** Reads the fields of one payload, and never past its end.

    Every function takes the bytes of one value off the reader, or raises {!Fault}; {!Packet} and {!Dynamic} turn
    that into a result. Allocation is in proportion to the bytes read. *)

type t

exception Fault of { at : int; fault : Error.fault }
(** [at] counts from the start of the payload. *)

val make : Byte_order.t -> string -> pos:int -> len:int -> t
(** [make order s ~pos ~len] reads the [len] bytes of [s] from [pos]. They must be there. *)

val finish : t -> unit
(** @raise Fault if bytes are left. *)

(** {1:numbers Numbers} [uN], [iN]: unsigned, signed of [N] bits. *)

val u8 : t -> int
(** From 0 to 255. *)

val u16 : t -> int
(** From 0 to 65,535. *)

val u32 : t -> int
(** From 0 to 2^32 - 1. *)

val i8 : t -> int
(** From -128 to 127. *)

val i16 : t -> int
(** From -32,768 to 32,767. *)

val i32 : t -> int
(** From -2^31 to 2^31 - 1. *)

val i64 : t -> int64
(** All 64 bits, which an [int] does not hold. *)

val f32 : t -> float
(** Exact, as every [f32] is an [f64]; only a signalling NaN becomes a quiet one. *)

val f64 : t -> float
(** Bit by bit as it was sent. *)

val text : t -> string
(** A [u16] length, and that many bytes. *)

(** {1:messages Messages}

    [read r id] reads the fields of the message [id]. *)

val inline : t -> (t -> int -> 'a) -> 'a option
(** [inline r read] is an id and the message that [read] makes of it, or [None] for the id 65535. *)

val list : t -> (t -> int -> 'a) -> 'a list
(** [list r read] is a [u16] count and that many messages. *)

val only : string -> int -> (t -> 'a) -> t -> int -> 'a
(** [only name id read] reads the message [id] and faults on all others; [name] is for the fault. *)

val unknown : t -> int -> 'a
(** @raise Fault with {!Error.Unknown_message}. *)

val misplaced : t -> int -> string -> 'a
(** @raise Fault with {!Error.Misplaced}. *)
