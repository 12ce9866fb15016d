(** The constructs of the language, one row each. The lists of words and of rules in the scanner, the formatter, the
    language service, the editors, docs/language.md, [Rule] and spec/DolphinChecking.tla are made of this table. *)

(** How a word stands in a program. *)
type place =
  | Begins  (** a task that extends as far as possible: [repeat T] *)
  | Limits  (** the task before it: [T ensure { a }] *)
  | Begins_or_limits  (** [until { C } run T], [T until { C }] *)
  | Joins  (** parts of one construct: [then], [run] *)
  | Control  (** of statements *)
  | Defines  (** a name *)
  | Declares  (** the same; elsewhere the word is a name *)
  | Constant
  | Procedure  (** is a name, and gives no task *)
  | Task_procedure  (** is a name, and gives a task *)
  | Block  (** is a name before a block of settings *)

(** A word, and its documentation. *)
type word = {
  spelling : string;
  place : place;
  form : string;  (** How it is written: ["during D run T"]. *)
  text : string;  (** Its meaning, in a sentence or two. *)
}

(** The kind of a part. *)
type kind =
  | Guard  (** code that gives true or false *)
  | Code
  | Handler  (** code that errors come to *)
  | Maker  (** code that gives a task *)
  | Task  (** runs, or may run, as soon as the whole does *)
  | Later  (** a task that begins after another part *)
  | Duration  (** seconds, or code that gives them; it takes a timer *)
  | Number
  | Text
  | Pairs
  | Vehicles
  | Settings

(** A part of a construct. *)
type part = { name : string; kind : kind; many : bool  (** Whether there may be several, or none. *) }

(** A row. *)
type t = {
  name : string;
  words : word list;
  parts : part list;
  rules : string list;  (** The names of its rules in docs/semantics.md. *)
  example : string;  (** A task or statement; [""] for rules that no text stands for. *)
}

val tasks : t list
(** The constructs of tasks. *)

val all : t list
(** Every construct, in the order of docs/semantics.md. *)

val words : word list
(** The words of {!all}. *)

val is_reserved : word -> bool
(** Whether the word is not a name elsewhere. *)

val rules : string list
(** The names of all rules. *)

val kind_name : kind -> string
(** ["guard"]. *)
