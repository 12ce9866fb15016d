(** The person at the console: hears the program's messages and answers its questions. *)

type t = {
  say : string -> unit;  (** shows a message of the program *)
  ask : string -> (string, string) result Lwt.t;
  (** [ask prompt] is the text typed after [prompt], or the reason why there is no answer. It may be cancelled. *)
  refused : string -> unit;  (** reports why an answer was refused; the question is asked again *)
}

val scripted : ?input:Lwt_unix.file_descr -> ?output:(string -> unit) -> answers:string list -> unit -> t
(** [scripted ~input ~output ~answers ()] gives [answers] in turn, shown as if they were typed, and then the lines of
    [input] (by default standard input). At the end of [input], the reason is ["end of input"]. [output] shows text
    at once; by default on standard output. *)
