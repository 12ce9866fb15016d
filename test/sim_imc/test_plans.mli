(** The reaction of a simulated vehicle to requests. {!Test_recording} compares it with a real vehicle. *)

val tests : unit Alcotest.test_case list
