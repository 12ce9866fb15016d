(** The functions of Derivations.v and Certificates.v as OCaml: proofs/reference/extracted. Types that are parameters of the calculus are
    those of lib/semantics. *)
From Dolphin Require Import Derivations Progress Certificates.
From Coq Require Extraction ExtrOcamlBasic ExtrOcamlZInt ExtrOcamlNatInt ExtrOcamlNativeString.
From Coq Require Import List NArith.

Extraction Language OCaml.
Set Extraction AccessOpaque.
Set Warnings "-extraction-opaque-accessed".  (* [deepest] *)

Extract Constant deepest => "100".
Extract Constant generation => "1_000_000".
Extract Inductive sum => "Either.t" [ "Either.Left" "Either.Right" ].

Extract Constant vehicle => "Dolphin_semantics.Core.vehicle".
Extract Constant plan => "Dolphin_semantics.Core.platform_task".
Extract Constant code => "Dolphin_semantics.Core.closure".
Extract Constant value => "Dolphin_semantics.Core.value".
Extract Constant key => "string".
Extract Constant seconds => "float".
Extract Constant prompt => "string".
Extract Constant message => "Dolphin_semantics.Fault.t".
Extract Constant site => "Dolphin_semantics.Core.site".
(* What a pick asks for, with its count and its timeout; of a recruit only the filter counts. *)
Extract Constant Metavariables.filter => "Dolphin_semantics.Settings.pick".
Extract Constant store => "Dolphin_semantics.Store.t".
Extract Constant tuples => "Dolphin_semantics.Tuples.t".
Extract Constant world => "Dolphin_semantics.World.t".
Extract Constant machine => "Dolphin_semantics.Machine.t".
Extract Constant assignment => "int * string * Dolphin_semantics.Core.value".
Extract Constant host_call => "Dolphin_semantics.Code.request".

Extraction "interpreter.ml" cderivations awaits program_accepts.
