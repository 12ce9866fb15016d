(** What the editor of a page asks about a text: {!Dolphin_service.Service} in JSON. Places are bytes here, and on the
    wire code units of UTF-16, as browsers count. *)

open Dolphin_service

val service :
  file:string -> fleet:Service.fleet option -> may_read:(string -> (unit, string) result) -> string -> Service.t
(** As {!Service.read}. *)

val diagnostics : Service.t -> Yojson.Safe.t
(** A list; each has [from], [to], [line], [column], [severity], [message], [code], perhaps [hint]. *)

val of_error : file:string -> source:string -> Dolphin_app.Error.t -> Yojson.Safe.t
(** Likewise what a use case says of the text [source] of [file]; what is wrong in another one has its [file], seen from
    the folder of that. *)

val complete : Service.t -> int -> Yojson.Safe.t
(** [complete d offset] is {!Service.complete}: an object with the place, [from] and [to], and the [items]. *)

val hover : Service.t -> int -> Yojson.Safe.t
(** [hover d offset] is {!Service.hover}: an object with [from], [to] and the [text], or [null]. *)

val signature : Service.t -> int -> Yojson.Safe.t
(** [signature d offset] is {!Service.signature}: an object with [form] and [text], or [null]. *)

val definition : path:(string -> Yojson.Safe.t) -> Service.t -> int -> Yojson.Safe.t
(** [path] is the name of a file in requests and replies. *)

val format : Service.t -> (Yojson.Safe.t, string) result
(** {!Service.format}: an object with the [text]; the error is a sentence. *)

val shapes : Service.t -> (Yojson.Safe.t, string) result
(** {!Service.shapes}: an object with the [shapes] and the place of the first statement, [first]; the error is a
    sentence. *)
