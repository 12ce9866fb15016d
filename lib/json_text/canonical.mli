(** JSON in one way only: a value has one text. Members stay in the order in which they are given, without blanks,
    and numbers are as short as possible.

    {[
      open Dolphin_json_text

      let () =
        assert (Canonical.to_string (`Assoc [ ("b", `Int 1); ("a", `Float 0.1) ]) = {|{"b":1,"a":0.1}|});
        assert (Canonical.number 2. = `Int 2);
        assert (Canonical.to_string (`String "\xff") = "\"\u{fffd}\"");
        assert (Canonical.to_string (`String "\u{9b}") = {|"\u009b"|})
    ]} *)

type extended = [ Yojson.Safe.t | `Tuple of Yojson.Safe.t list | `Variant of string * Yojson.Safe.t option ]
(** JSON with the two constructors that Yojson 2 has and Yojson 3 has no more: a match on [(json :> extended)] is
    complete in both, and has no case too many. *)

val number : float -> Yojson.Safe.t
(** [number x] is [x], which is finite, as an integer if it is whole: [2.] and [2] are one number. *)

val write : Buffer.t -> Yojson.Safe.t -> unit
(** [write buffer json] adds the text of [json], which has no line breaks. A [`Float] differs from an [`Int] by its
    point or exponent, and has the fewest of 15, 16 or 17 digits that give it back; one that is not finite, which
    JSON does not have, is [null]. Of strings that are not UTF-8, {!Dolphin_utf8.Utf8.repaired} is written,
    and control characters are escaped. *)

val shortened : int -> Yojson.Safe.t -> string
(** [shortened n json] is the text of [json], for messages: cut after [n] bytes, with ["..."], if it is longer. *)

val to_string : Yojson.Safe.t -> string
(** On one line, the members in their order. *)

val to_lines : Yojson.Safe.t -> string
(** The same value on several lines, indented. *)
