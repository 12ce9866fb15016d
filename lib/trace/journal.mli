(** Journals, read line by line. No line takes more memory than {!longest}.

    {[
      open Dolphin_trace

      let header =
        { Header.program = Header.source ~path:"a.dol" "halt 'no'"; fleet = None; platform = "sim"; order = By_hearing;
          seed = 1; speed = None; started = "2026-03-01T12:00:00Z"; run = None; fences = []; place = None;
          begins = None }

      let journal =
        let line = Journal.line (Journal.numbering ~notes:0) in
        let ending = { Request.how = "completed"; message = None } in
        line (Header header) ^ "\n" ^ line (End { time = 2.; transitions = 0; ending }) ^ "\n{\"torn"

      let () =
        let lines = Journal.of_string journal in
        assert (Journal.next lines = Line { number = 1; entry = Header header });
        (match Journal.next lines with Line { entry = End { time = 2.; _ }; _ } -> () | _ -> assert false);
        assert (Journal.next lines = Torn 3)
    ]} *)

type t

val of_channel : in_channel -> t
(** The channel is in binary mode, and has no other reader. Reading may raise [Sys_error]. *)

val of_string : string -> t
(** Reads the journal that the text is. *)

(** The next line of a journal, or its end. *)
type item =
  | Line of { number : int;  (** from 1 *) entry : Entry.t }
  | Torn of int  (** the last line, of this number, was not written to its end: the console died *)
  | End_of_file
  | Wrong of { number : int; why : string }  (** a line that is not a line of a journal *)

val next : t -> item
(** The first line is a header, and no other one is: else it is [Wrong]. *)

val peek : t -> item
(** [peek r] is [next r], and {!next} gives it once more. *)

val whole : t -> int
(** [whole r] is the number of bytes of the lines read so far, without a torn last one. *)

val notes : t -> int
(** [notes r] is the number of [platform] lines read so far. A line whose member [notes] is another number is
    [Wrong]: lines before it are missing, and with them commands to vehicles. *)

val breaks_off : in_channel -> bool
(** [breaks_off channel] is whether the rest of [channel] is the journal of a run that took at least one transition
    and has not ended. It reads [channel] to its end. A file that is not a journal does not break off. *)

val longest : int
(** 16 MiB. *)

(** {1 Writing} *)

type numbering
(** How many [platform] lines a journal has. *)

val numbering : notes:int -> numbering
(** of a journal that has [notes] of them *)

val line : numbering -> Entry.t -> string
(** The next line, without its end. It has the number of [platform] lines before it, as [notes], if it is one or the
    first line after some. *)
