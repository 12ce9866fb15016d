(** Simulated vehicles over sockets on the loopback interface, with a small console. Each case lasts some seconds at
    most. *)

val tests : unit Alcotest.test_case list
