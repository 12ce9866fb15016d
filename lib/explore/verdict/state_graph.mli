(** The state graph of a program, as far as it has been searched. *)

open Dolphin_semantics
open Dolphin_environment

include module type of Dolphin_checker.Breadth_first.Make (Space)

(** {1:dolphin States of Dolphin}

    These are {!Space}'s, of states by their numbers. *)

val all : t -> int list
(** The numbers of all states. *)

val state : t -> int -> Configuration.t * Environment.t
(** [state t i] is {!Space.state} of state [i]. *)

val view : t -> int -> Space.view
(** [view t i] is {!Space.view} of state [i]. *)

val shared : t -> int -> int option
(** [shared t i] is {!Space.shared} of state [i]. *)

val breadth : t -> int -> int
(** [breadth t i] is {!Space.breadth} of state [i]. *)

val broken_by : t -> int -> Property.t option
(** [broken_by t i] is the property that reaching state [i] breaks. *)

val is_exact : t -> int -> bool
(** Whether state [i] stands for itself alone. *)
