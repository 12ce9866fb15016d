(** A mistake in the code that no kind of {!Mutation} makes: the text that it replaces, and the test that must notice
    it. *)

type t = {
  name : string;
  file : string;  (** from the root *)
  find : string;  (** occurs once in the file; as short as can be *)
  replace : string;
  noticed_by : string;  (** a test's executable without [.exe], from the folder [test] *)
}

val all : t list
