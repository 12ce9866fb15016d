(** Shapes of executing configurations, and how a configuration of a shape is laid out in words. A shape is the machine
    that waits, and the families of the parts, in order. All else that tells configurations of one shape apart is a few
    small numbers: what is shared, and each part's number in its family. *)

open Dolphin_semantics

(** A machine that waits for a task. *)
type frame = {
  frame : int;
  machine : Machine.t;
  mutable over : int array;
  (** by shared number, for the use of {!Space}: the number of the configuration that follows the end of the task *)
}

type t = {
  number : int;  (** from 1 *)
  frame : frame;
  families : Parts.family array;
  mutable word : int array;  (** by position: the word that holds the part *)
  mutable shift : int array;  (** its lowest bit there *)
  mutable mask : int array;  (** all bits of its width, at the right *)
  without : t option array;  (** by position: the shape without that part, once it is known *)
  becoming : (int, t) Hashtbl.t;
  (** by position and serial number of a target: the shape after it, once it is known *)
}

(** {1:words Words}

    The first word starts with the shape's number, lowest bits first, then has the number of what is shared; the parts
    follow, none across the end of a word. Shape 0 stands for all other configurations, each with its own number above
    it. *)

val bits_of_word : int

type widths = { shape : int; shared : int }

val lay_out : widths -> t -> int
(** [lay_out widths s] lays [s] out anew, in the present widths of its families; the result is how many words it
    needs. *)
