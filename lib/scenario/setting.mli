(** Blocks of settings, whatever they describe: [{ type 'UUV'; speed 1.5 }]. *)

open Dolphin_syntax

type value = Literal.t Ast.located
(** A literal with its place in the text. *)

(** A setting of a ['draft], the description of the block as far as it has been read. *)
type 'draft t = {
  word : string;
  takes : string;  (** for messages: ["a time, as in joins 30.seconds"] *)
  again : bool;  (** whether it may stand more than once *)
  read : 'draft -> value list -> ('draft, Diagnostic.t) result option;
  (** [None]: these are not the values that it takes *)
}

val block :
  what:string -> 'draft t list -> 'draft -> Ast.statement list -> 'draft * string list * Diagnostic.t list
(** [block ~what settings draft body] is [draft] after the settings in [body], the words that stood in it, whether
    well used or not, and all that is wrong with it. [what] is the subject of the block, with an article. *)

(** {1:values Values} *)

val text : value -> (string, Diagnostic.t) result
(** A text that is not empty. *)

val number : value -> (float, Diagnostic.t) result
(** With any unit or none. *)

val time : value -> (float, Diagnostic.t) result
(** Seconds, at least 0. A number without a unit counts seconds. *)

val share : value -> (float, Diagnostic.t) result
(** From 0 to 1: [80.percent], [0.8]. *)

val per_hour : value -> (float, Diagnostic.t) result
(** A share, at least 0. *)

val speed : value -> (float, Diagnostic.t) result
(** Metres per second, more than 0. *)

val position : value list -> (Dolphin_geo.Position.t, Diagnostic.t) result option
(** [LATITUDE, LONGITUDE], the same with a height in metres, or a place. *)
