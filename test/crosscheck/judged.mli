(** TLC's verdict on a program, by the properties of the specification, beside the explorer's. *)

type t =
  | Not_translated of string  (** why *)
  | Judged of {
      tlc : string;  (** the first violated property, or ["all hold"] *)
      explorer : string;  (** all that is violated, or ["all hold"] *)
      agree : bool;  (** TLC's is one of the explorer's *)
    }

val verdicts :
  ?specification:(string * string) list -> Dolphin_tlc.Installation.t -> Case.t -> (t, string) result
(** Starts TLC, as [dolphin tla --run --strict] does, with the modules of [specification] in the place of those with
    their names. An error is TLC's error; also a property of the specification alone that does not hold. *)
