(** The oracle answers questions about the transitions of a configuration, one at a time, in JSON. It remembers only
    the latest program: an answer depends on that program and on the question alone. [conformance/INTERPRETING.md]
    describes the protocol member by member.

    {[
      open Dolphin_conformance

      let oracle = Oracle.start ~name:"example"

      let () =
        let _, reply = Oracle.answer oracle (`Assoc [ ("id", `Int 1); ("request", `String "hello") ]) in
        assert (Yojson.Safe.Util.(member "implementation" reply) = `String "example");
        let _, reply = Oracle.answer oracle (`Assoc [ ("id", `Int 2); ("request", `String "dance") ]) in
        assert (Yojson.Safe.Util.member "error" reply <> `Null)
    ]} *)

type t

val start : name:string -> t
(** [start ~name] knows no program yet. [name] is its name for itself. *)

val version : int
(** Of the protocol. *)

val answer : t -> Yojson.Safe.t -> t * Yojson.Safe.t
(** [answer o request] is the reply to [request], and the oracle afterwards. A request that cannot be answered has a
    reply with an [error]. *)

val answer_line : t -> string -> t * string
(** The same on lines of text, without their ends. *)
