(** Whatever comes over the network: no exception, and no change from what is broken, or does not come from where the
    vehicle is. *)

val tests : unit Alcotest.test
