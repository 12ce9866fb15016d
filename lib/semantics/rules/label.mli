(** The label of a transition: the part of it that an observer of the program and its vehicles can see.

    {[
      open Dolphin_semantics

      let () =
        assert (Format.asprintf "%a" Label.pp (Fail ("x8-02", "survey1", "engine")) = "fail(x8-02, survey1, engine)");
        assert (not (Label.equal Time_out Silent))
    ]} *)

open Core

type t =
  | Start of vehicle * string  (** of the plan with this name *)
  | Done of vehicle * string
  | Fail of vehicle * string * string  (** why *)
  | Check of Code.deed list  (** a guard or condition that held, with the deeds of its code *)
  | Act of Code.deed list
  | Cut of Code.deed list  (** by an [until] or [assure] *)
  | Time_out  (** of [during], [within] or [idle] *)
  | Set_time of float  (** seconds that [during] or [within] starts with, given by code *)
  | Make  (** code gave a task *)
  | Allocate of vehicle list  (** these free vehicles, to a task that was made *)
  | Recruit of vehicle  (** it was recruited *)
  | Broken of string  (** code inside of a task that failed *)
  | Did of Code.deed  (** by the script *)
  | Silent
  | Pick of string  (** the subject of the search *)
  | Bind of vehicle list
  | No_vehicles of string
  | Ask of string
  | Answer of string
  | No_answer
  | Pause of float  (** seconds *)
  | Resume
  | Call of string
  | Reply of string
  | No_reply of string
  | Execute
  | Cannot_execute of string
  | End
  | Halt of string
  | Fault of string
  | Input of string * value  (** a pair that the outside posted *)
  | Interrupt

val compare : t -> t -> int
(** A total order; values of tuples are compared by their texts. *)

val equal : t -> t -> bool
(** [equal l m] is [compare l m = 0]. *)

val pp : Format.formatter -> t -> unit
(** ["start(noptilus-1, survey1)"], ["check(consume ready:1)"]. *)
