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

open Dolphin_semantics

type t

val start : name:string -> t
(** [start ~name] knows no program yet. [name] is its name for itself. *)

(** Two functions of {!Dolphin_semantics.Transition}, or others in their place. *)
type transitions = {
  internal : Core.program -> World.t -> Configuration.t -> Transition.t Seq.t;
  accept : Core.program -> World.t -> Configuration.t -> Transition.event -> (Transition.t, Transition.refusal) result;
}

val start_with : transitions -> name:string -> t
(** [start_with ts ~name] is [start ~name], with the transitions that [ts] gives. *)

val version : int
(** Of the protocol. *)

val answer : t -> Yojson.Safe.t -> t * Yojson.Safe.t
(** [answer o request] is the reply to [request], and the oracle afterwards. A request that cannot be answered has a
    reply with an [error]. *)

val answer_line : t -> string -> t * string
(** The same on lines of text, without their ends. *)
