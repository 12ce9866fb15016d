(** Building nodes: the common part of the grammar's actions. *)

open Ast

val located : Lexing.position * Lexing.position -> 'a -> 'a located
(** [located place x] is [x] at [place], its first and last position. *)

(** The rest of a task in the postfix forms [T during D], [T within D], [T until { C }], [T assure { C }] and
    [T ensure { a }]. *)
type limit = During_limit of on_cut * expression | Until_limit of on_cut * closure | Ensure_limit of closure

(** An expression, and the limits written after it, outermost first. *)
type item = { base : expression; limits : (limit * Lexing.position) list }

val item : expression -> item
(** [item e] is [e] without limits. *)

val limit : item -> limit -> Lexing.position -> item
(** [limit i l stop] is [i] with [l], which ends at [stop], after it. *)

val settle : item -> expression
(** [settle i] is the base of [i] within its limits. *)

(** An argument as it is read: alone, [name: item] or [[key]: item]. *)
type argument_item =
  | Positional_item of item
  | Named_item of string located * item
  | Keyed_item of expression * item

val argument : argument_item -> argument
(** [argument a] is [a], settled. *)

val command : Lexing.position * Lexing.position -> expression -> argument_item list -> item
(** [command place callee arguments] is a call without parentheses, [arguments] in reverse. The limits after
    its last argument are those of the whole call ([task 't' during 2.seconds]), unless it is [execute]: a
    limit is for tasks. *)

val trailing : Lexing.position * Lexing.position -> expression -> expression -> expression
(** [trailing place call closure] is [call] with one more argument, a closure after the parentheses. *)

val give_back : string
(** The procedure that posts the pairs of a guard again: ["giveBack"]. *)

val using : Lexing.position * Lexing.position -> argument_item list -> expression -> expression
(** [using place arguments t] is [using K: X run T], [arguments] in reverse: [waitFor { consume K: X } then (T ensure
    { giveBack() })]. *)
