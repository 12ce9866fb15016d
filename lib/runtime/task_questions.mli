(** The questions of tasks that stand. People are asked one at a time; programs may answer any. *)

open Dolphin_semantics

type 'news t
(** ['news] is the type into which an answer of people is read. *)

val create : unit -> 'news t
(** No question stands. *)

val put : 'news t -> Residual.timer -> string -> unit
(** [put t q prompt] adds the question [q], after the others. *)

val withdraw : 'news t -> Residual.timer -> unit
(** [withdraw t q]: it was answered, or needs no answer any more. If it is shown, the promise of its answer is
    cancelled. *)

val standing : 'news t -> (Residual.timer * string) list
(** Each with its prompt, the first one first. *)

val were_put : 'news t -> bool
(** Whether there ever was a question. *)

val show : 'news t -> ask:(Residual.timer -> string -> 'news Lwt.t) -> unit
(** [show t ~ask] asks people the first question, unless one is shown. *)

val shown : 'news t -> 'news Lwt.t option
(** The answer of people to the question that is shown. *)

val forget : 'news t -> 'news Lwt.t -> unit
(** [forget t promise]: if [promise] is {!shown}, it has been read, and the next question may be shown. *)

val leave : 'news t -> Residual.timer -> unit
(** [leave t q]: no person answers [q], which is shown. Others are not shown as long as it stands. *)

val answered_by : 'news t -> Inputs.item -> (Residual.timer * bool) option
(** [answered_by t item] is the first question whose prompt [item] posts to, and its answer, if that is yes or no. *)
