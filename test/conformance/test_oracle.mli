(** Tests of {!Dolphin_conformance.Oracle}: configurations written down and read again, hostile requests. No value of
    its own. *)
