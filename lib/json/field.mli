(** Members of JSON objects, read with a reason where they are not what they should be.

    {[
      open Dolphin_json

      let read json =
        let open Field in
        let* fields = members json in
        let* name = get text "name" fields in
        let* speed = optional number ~default:1.5 "speed" fields in
        Ok (name, speed)

      let () =
        assert (read (`Assoc [ ("name", `String "x8-02") ]) = Ok ("x8-02", 1.5));
        assert (Result.is_error (read (`Assoc [ ("name", `Int 8) ])))
    ]} *)

type members = (string * Yojson.Safe.t) list
(** The members of an object, in the order of its text. *)

val ( let* ) : ('a, 'e) result -> ('a -> ('b, 'e) result) -> ('b, 'e) result
(** [Result.bind], for those who open this module. *)

val get : (Yojson.Safe.t -> ('a, string) result) -> string -> members -> ('a, string) result
(** [get read name members] is [read] of member [name], which must exist. *)

val optional : (Yojson.Safe.t -> ('a, string) result) -> default:'a -> string -> members -> ('a, string) result
(** [optional read ~default name members] is the same, or [default] without a member [name]. *)

(** {1:readers What members may be} *)

val text : Yojson.Safe.t -> (string, string) result
(** A string. *)

val number : Yojson.Safe.t -> (float, string) result
(** A number, whole or not. *)

val whole : Yojson.Safe.t -> (int, string) result
(** A number written without a fraction, that fits an [int]. *)

val truth : Yojson.Safe.t -> (bool, string) result
(** [true] or [false]. *)

val members : Yojson.Safe.t -> (members, string) result
(** An object. *)

val list : (Yojson.Safe.t -> ('a, string) result) -> Yojson.Safe.t -> ('a list, string) result
(** [list read] is an array with each of its elements read by [read]; the error is that of the first that fails. *)

val nullable : (Yojson.Safe.t -> ('a, string) result) -> Yojson.Safe.t -> ('a option, string) result
(** [null] is [None]. *)

val any : Yojson.Safe.t -> (Yojson.Safe.t, string) result
(** Any value, as it is. *)

(** {1:writers And how they are written} *)

val texts : string list -> Yojson.Safe.t
(** An array of strings. *)

val unless_empty : string -> ('a list -> Yojson.Safe.t) -> 'a list -> members
(** [unless_empty name write xs] is the member [name], or none if [xs] is empty. *)

val of_option : ('a -> Yojson.Safe.t) -> 'a option -> Yojson.Safe.t
(** [of_option write] is the counterpart of {!nullable}: [null] for [None]. *)
