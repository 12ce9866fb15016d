(** The person at the console: hears the program's messages and answers its questions. *)

type t = {
  say : string -> unit;  (** shows a message of the program *)
  ask : string -> (string, string) result Lwt.t;
  (** [ask prompt] is what the person types after [prompt], or why nobody answers. It may be cancelled. *)
  refused : string -> unit;  (** says why an answer was no good; the question is asked again *)
}

val scripted : ?input:Lwt_unix.file_descr -> ?output:(string -> unit) -> answers:string list -> unit -> t
(** [scripted ~input ~output ~answers ()] gives [answers] in turn, shown as if they were typed, and then the lines of
    [input] (by default standard input). At the end of [input], the reason why nobody answers is ["end of input"].
    [output] shows text at once; by default on standard output. *)
