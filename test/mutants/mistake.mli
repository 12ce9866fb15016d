(** A mistake in the code: the text that it replaces, and the test that must notice it. *)

type t = {
  name : string;
  file : string;  (** from the root *)
  find : string;  (** occurs once in the file *)
  replace : string;
  noticed_by : string;  (** a test's executable without [.exe], from the folder [test] *)
}

val all : t list
