(** The common part of the lines of both directions: objects with a [kind]. *)

val version : int
(** 1 *)

val longest : int
(** 1 MiB. *)

val make : string -> (string * Yojson.Safe.t) list -> Yojson.Safe.t
(** [make kind members] is the object of this kind; members that are [null] stay. *)

val read :
  (string * (Dolphin_json.Field.members -> ('a, string) result)) list -> string -> ('a option, string) result
(** [read kinds text] is the result of its kind's reader for the line [text]; [None]: its kind is not among [kinds]. The
    error is in words that follow the line's name: ["is not JSON: ..."], ["has no member 'why'"].
*)

(** {1:fields Members} *)

val text : string -> Yojson.Safe.t
(** A member of a text. *)

val count : Yojson.Safe.t -> (int, string) result
(** A whole number, at least 0. *)

val seconds : Yojson.Safe.t -> (float, string) result
(** A number that is not negative. *)

val request : Yojson.Safe.t -> (string, string) result
(** A text of 1 to 64 bytes. *)

val word : Yojson.Safe.t -> (string, string) result
(** A text that is not empty. *)
