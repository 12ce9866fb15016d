(** What a simulated vehicle makes of requests. What the recording of a real vehicle shows is in {!Test_recording}. *)

val tests : unit Alcotest.test_case list
