(** The checker of certificates that [proofs/Certificates.v] is about, extracted to OCaml. *)

open Dolphin_semantics
open Dolphin_environment
open Dolphin_app

(** What a certificate shows. *)
type verdict =
  | Certified of int option
  (** the states are those that the rules lead to, and the properties hold; with the most transitions of a run, if
      every run ends *)
  | Refuted of { state : int; why : string }  (** wrong at this state *)

val check :
  Environment.options -> Core.program -> World.t -> holds:Dolphin_explore.Property.t list ->
  State_certificate.edge list array -> verdict
(** [check o p w ~holds edges] compares [edges] with the rules: whether they are the transitions of all states of [p] in
    [w], where what [o] lets happen may happen, and whether [holds], of {!State_certificate.certifiable}, hold.
    @raise Environment.Unclear if the outcomes of a step cannot be listed *)
