(** Lines of text from a file descriptor, as they come. No line takes more memory than its limit, and waiting for one
    can be cancelled without losing what was read. *)

type t

type line =
  | Line of string  (** without its end, which is LF or CR LF *)
  | Too_long  (** the line has more bytes than the limit; the next one comes after its end *)
  | End_of_input  (** the end of the input, or the descriptor cannot be read *)

val make : limit:int -> Lwt_unix.file_descr -> t
(** [make ~limit input] reads [input], which has no other reader, in lines of at most [limit] bytes. *)

val next : t -> line Lwt.t
(** [next t] is the next line. A last line without an end counts as a line. *)
