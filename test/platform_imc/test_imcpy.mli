(** [dolphin exec --imc] commands a vehicle that is made with imcpy. *)

val tests : unit Alcotest.test
