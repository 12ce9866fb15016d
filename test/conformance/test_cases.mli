(** Tests of {!Dolphin_conformance.Case} and {!Dolphin_conformance.Match}. No value of its own. *)
