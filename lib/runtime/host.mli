(** The host process: outside procedures that a program can name, as [getSupplier()]. It is a child process
    ([--supplier CMD]) that reads requests on its standard input and writes replies on its standard output, each one
    line of JSON in UTF-8. Its standard error is the user's.

    {1:protocol The protocol, version 1}

    The environment variable [DOLPHIN_SUPPLIER_PROTOCOL] holds the version, [1]. A request is one of
    {v
{"id": 1, "call": "getSupplier", "arguments": []}              a procedure of the host itself
{"id": 2, "object": "supplier", "get": "queue"}                a property of one of its objects
{"id": 3, "object": "queue", "call": "await", "arguments": [20, "minutes"]}    a method
    v}
    The host replies with the request's [id], which is a whole number, and either a value or the reason why there is
    none, which ends the program:
    {v
{"id": 1, "value": {"object": "supplier"}}
{"id": 3, "error": "the queue is closed"}
    v}
    Values are as in {!Dolphin_json.Host_value}. An object is known by a name that the host chooses; it lives as long as
    the host likes. There is one request at a time; a reply may take as long as the program is to wait. A reply is at
    most 1 MiB long. The host writes nothing unasked. It should ignore fields of requests that it does not know, and end
    when its input ends; otherwise it is terminated at the end of the run.

    Requests are numbered from 1. Those of a run that is resumed are numbered on: the host sees that it is not the first
    one, and a call that no reply is known of is made again with its number.

    {1:host Hosts} *)

open Dolphin_semantics

type t

val start : ?timeout:float -> ?calls:int -> string -> (t, string) result
(** [start ~timeout ~calls command] starts [command], for [/bin/sh], as host process of a run in which hosts have
    replied to [calls] calls before, by default none. Each of its replies may take [timeout] seconds; by default, any
    time. The error is the reason why there is no process. From then on SIGPIPE is ignored. *)

val call :
  t ->
  site:Core.site ->
  subject:string option ->
  member:string ->
  arguments:Core.value list option ->
  (Core.value, string) result Lwt.t
(** [call h ~site ~subject ~member ~arguments] is the reply to a call of [member] with [arguments], or with [None] the
    value of the property [member]; of object [subject], or without it of the host itself. Tasks in the reply come from
    [site]. Or the reason why there is none: the host's own reason; it ended, closed its output, or took too long; its
    reply is too long, or not JSON, or of another request, or not a value of programs. After any of these but the host's
    own reason no more requests are sent: later calls fail with the same reason.

    One call at a time. It may be cancelled, which counts as a reason. *)

val close : t -> unit Lwt.t
(** [close h] ends the process, by force if need be, and waits until it is gone: at most about a second and a half
    for a process that can be killed. Later calls fail. *)
