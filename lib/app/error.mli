(** Why a use case has no result. Only the command knows of exit statuses, and only it writes on standard error. *)

type t =
  | Bad_input of string  (** The input cannot be read, or is inconsistent; one sentence. *)
  | Bad_text of { source : string; found : Dolphin_syntax.Diagnostic.t list }
  (** A program, a fleet or a definition of IMC is wrong in these places of its text [source]. *)
  | Incompatible of { path : string; differences : string list }
  (** The definition of IMC in the file [path] is not the one that Dolphin speaks. *)
  | Unavailable of string  (** A failure around the program: the platform, a disk; one sentence. *)
  | Interrupted of string  (** A person ended it before there was a result; one sentence. *)
  | Inconclusive of string  (** A bound was met before there was a result; one sentence. *)
  | Unsettled of { source : string; fault : Dolphin_syntax.Diagnostic.t }
  (** The explorer cannot list what may happen at this place of the program [source]. *)

val pp : Format.formatter -> t -> unit
(** A sentence without a full stop, or each diagnostic with the line of the source that it points at, in the order of
    the text. *)

val sentences : t -> string list
(** [sentences e] is the sentences of [e] without places, each item without a full stop; [[]] if it has places in a
    text. *)

val diagnostics : t -> Dolphin_syntax.Diagnostic.t list
(** [diagnostics e] is the diagnostics of [e] with places in a text; [[]] without places. *)
