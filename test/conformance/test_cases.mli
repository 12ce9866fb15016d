(** Tests of {!Dolphin_conformance.Case} and {!Dolphin_conformance.Likeness}. No value of its own. *)
