(** Functions written in Dolphin that come with it, for programs that [include 'prelude']. *)

val name : string
(** ["prelude"], by which programs include it. *)

val file : string
(** ["<prelude>"], the file of its places. *)

val text : string
(** The text of the prelude, a program of declarations. *)

(** A function, as the comment above it describes it. *)
type entry = {
  name : string;
  form : string;  (** ["par(tasks)"] *)
  text : string;  (** its description: sentences *)
  example : string;  (** statements, in which [vs] is three vehicles and [p], [q] and [r] are tasks *)
  law : (string * string) option;  (** two tasks that are strongly bisimilar *)
  weak_law : (string * string) option;  (** two that are weakly so: in the behaviour of vehicles *)
}

val entries : unit -> entry list
(** In the order of the text. *)

val find : string -> entry option
(** The function of this name. *)

val manual : unit -> string
(** All of it as a page in Markdown. *)
