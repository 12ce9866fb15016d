(** What is found out about a program on behalf of pages, without running it: by another command of [dolphin] in a
    process of its own, so that nothing else waits for it. *)

open Dolphin_app
open Dolphin_json
open Exchange

(** The commands [dolphin explore], [dolphin time], [dolphin lts]; and [dolphin explore --from], of another program for
    the run that goes on. *)
type subject = Exploration | Timing | Graph | Replacement

val subject_name : subject -> string
(** ["exploration"], ["timing"], ["graph"], ["replacement"]. *)

(** An analysis that a page has asked for. *)
type order = {
  subject : subject;
  seconds : int;  (** at most *)
  arguments : string list;  (** the command, and its options but for [--timeout] and [--trace] *)
  inputs : string list;  (** {!inputs} *)
  program : string;  (** its path in the folder *)
  fleet : string option;  (** its path *)
  set : (string * string) list;
  hash : string;  (** of the program's file *)
}

val json_of_order : order -> json
(** The order for another process, which reads it by {!order_of_json}. *)

val order_of_json : json -> (order, refusal) result
(** [order_of_json (json_of_order o)] is [o]. *)

type t

val inputs : Program_file.t -> Fleet_file.t -> string list
(** [inputs program fleet] is the arguments that name both, with the program's parameters, to any command of [dolphin]:
    its last ones. *)

val start :
  dolphin:string -> changed:(unit -> unit) ->
  conclude:(text:string -> witness:string option -> (string, string) result Lwt.t) -> order -> t
(** [start ~dolphin ~changed ~conclude order] runs the command [dolphin]. [changed] is called whenever {!to_text} has
    changed. At the end, [conclude ~text ~witness] makes an object in JSON of the command's output and of the file with
    the run that it shows, or returns the reason why there is no result: neither is parsed in this process. *)

val order : t -> order
(** The order of {!start}. *)

val goes_on : t -> bool
(** Whether its command is still running. *)

val cancel : t -> unit
(** Ends its command, and the analysis has no result; without effect on one that is over. *)

val shown : t -> string option
(** The run that it shows, a counterexample perhaps: the contents of a {!Dolphin_app.Witness_file}. *)

val progress : t -> Field.members
(** [state] and [progress]. *)

val to_text : t -> string
(** An object in JSON: {!progress}, the [program] and the [hash] of its file; when it is over, the members that
    [conclude] gave, or the [error]. *)
