(** A fault of a program, for the person who wrote it.

    {[
      open Dolphin_syntax

      let source = "execute task('survey1' >> task('home')"

      let () =
        match Parse.program ~file:"a.dol" source with
        | Error [ fault ] ->
          let text = Format.asprintf "%a" (Diagnostic.pp ~source) fault in
          assert (List.hd (String.split_on_char '\n' text) = "a.dol:1:13: error: this '(' is never closed");
          assert (Diagnostic.code_name fault.code = "syntax")
        | _ -> assert false

      let () = assert (Diagnostic.suggest "exectue" [ "execute"; "message" ] = Some "execute")
    ]} *)

(** An [Error] keeps a program from running, a [Warning] does not. *)
type severity = Error | Warning

(** The kind of a fault, for programs that read diagnostics and for tests that must outlive their wording. *)
type code =
  | Syntax  (** the text is not a program *)
  | Unknown_name | Unknown_unit | Unknown_setting | Unknown_argument
  | Wrong_arity  (** a number of arguments *)
  | Wrong_kind  (** a task where a number is needed, and the like *)
  | Wrong_value  (** of the right kind: a negative time, and the like *)
  | Wrong_parameters  (** of the code of a guard or handler *)
  | No_pairs  (** [post], [consume] and [poll] take pairs *)
  | No_value  (** the name of a procedure, or of an object with members only, in place of a value *)
  | Waits_in_task  (** code of a task would wait, or does what belongs to the script *)
  | Handler_only  (** [ignore()] or [propagate()] outside of [onError] *)
  | Captured_local  (** assigned in a closure, which has a copy of it *)
  | Not_assignable | Defined_twice
  | Reserved_name  (** a name of the language, defined by the program *)
  | Wildcard_value  (** [_] where a value is needed *)
  | Misplaced_jump  (** [break], [continue], [return] *)
  | Misplaced_when | Misplaced_setting | Misplaced_function | Misplaced_input
  | Misplaced_parameter | Misplaced_interrupt
  | Bad_map  (** a file that [map] names cannot be read, or a feature of it cannot be used *)
  | Bad_fence  (** [fence] with a value that is unknown, or is not a fence; or out of place *)
  | Broken_fence  (** a plan that breaks a fence wherever its vehicle is *)
  | No_place  (** a plan without a place, where neither program nor fleet has one for it *)
  | No_way  (** the rest of a plan whose way is not known *)
  | Deed_in_answer  (** an answer may only compute *)
  | Deed_in_maker  (** so may code that makes a task *)
  | Vehicle_twice  (** one vehicle, needed twice at once *)
  | Unused_task  (** a warning *)
  | No_effect  (** a warning: a statement whose value is not used *)
  | Assigned_condition  (** a warning: a condition whose value is that of an assignment *)
  | Never_holds  (** a warning: a condition whose value is always null *)
  | Wide_value  (** a warning: the value of a pair has a condition in it that may be meant to stand beside it *)
  | Unknown_plan  (** a warning: the fleet has no entry for it *)
  | Unread_input  (** a warning: pairs that the outside posts with this key are never read *)
  | Other_meaning  (** a warning: the original language means something else *)
  | Partial_map  (** a warning: features of a map are flawed, left out or repaired *)
  | No_end  (** a warning: a repeat without an end of its own beside a task that ends *)
  | No_time  (** a warning: a loop whose rounds take no time *)
  | Ends_here  (** code fails in every run, or as a warning in each run of the fleet in which all goes well *)

val codes : (code * string) list
(** Every code with its name, which does not change: ["unknown-name"]. *)

val code_name : code -> string
(** Its name in {!codes}. *)

type t = {
  at : Location.t;
  message : string;      (** The fault. *)
  hint : string option;  (** The remedy. *)
  severity : severity;
  code : code;
}

val error : ?hint:string -> ?code:code -> Location.t -> string -> t
(** [error ~hint ~code at message] is an error at [at]; [code] is [Syntax] by default. *)

val warning : ?hint:string -> code -> Location.t -> string -> t
(** [warning ~hint code at message] is a warning at [at]. *)

val compare : t -> t -> int
(** [compare a b] orders by place in the text, then by message. *)

val pp : source:string -> Format.formatter -> t -> unit
(** [pp ~source ppf d] prints [d] with the line of [source] it points at, and a caret below the place:
    {v
FILE:LINE:COLUMN: error: message
  12 | the source line
     |      ^^^^
     hint: what would be right
    v}
    Columns count characters. A very long line is cut around the caret. A diagnostic without a place is its
    message and hint. *)

val suggest : string -> string list -> string option
(** [suggest x xs] is the member of [xs] that [x] is most likely a misspelling of, if one is near enough:
    letter case, swapped neighbours and a few wrong letters are forgiven. *)
