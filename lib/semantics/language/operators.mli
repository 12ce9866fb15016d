(** The language's operators on values. Pure; an [Error] is a sentence with the fault, without a full stop. The two
    operators that run code of the program, [V | { v -> C }] and calls, belong to {!Machine}. *)

open Core

val unary : Dolphin_syntax.Ast.unary -> value -> (value, string) result
(** [unary op x] is [op x], or why it has no value. *)

val binary : Dolphin_syntax.Ast.binary -> value -> value -> (value, string) result
(** [binary op x y] is [x op y]. Whole numbers stay whole where the result is; [/] is exact, so that [7 / 2] is 3.5;
    a result beyond the range of integers is a number. *)

val element : value -> value -> (value, string) result
(** [element x i] is [x[i]]: an element of a list, counted from the end if [i < 0]; the value of a key, null without
    it; a vehicle of a set; and [T[V]], task [x] allocated to the vehicles [i]. *)

val replace_element : value -> value -> value -> (value, string) result
(** [replace_element x i y] is [x] after [x[i] = y]. *)

val range : inclusive:bool -> value -> value -> (value, string) result
(** [range ~inclusive first last] is [first..last], or with [~inclusive:false] [first..<last]. *)

val unit_factor : string -> float option
(** [unit_factor name] is the factor of [n.name], as in [2.km]: results are in metres, degrees, seconds, or shares of
    1. *)

val unit_names : string list
(** All names that {!unit_factor} knows. *)

val unit_hint : string -> string
(** [unit_hint name] is the right spelling if [name] is not a unit. *)

val in_unit : value -> string -> (value, string) result
(** [in_unit n name] is [n.name]. *)

val too_large : Value.excess -> string
(** Why a value with this excess cannot be written or kept. *)

val member : value -> value -> (value, string) result
(** [member x y] is [x in y]. *)

val key : value -> (string, string) result
(** [key x] is the key that [x] is in a map: its text. An error if [x] is {!too_large}. *)

val too_long : string -> ('any, string) result
(** [too_long what] is the error of a list or string, [what], of more than {!Value.most_items} elements. *)

val instead_of : string -> value -> string
(** [instead_of what x] is "expected [what], found [kind and text of x]". *)

val expected : string -> value -> ('any, string) result
(** [expected what x] is the error {!instead_of}[ what x]. *)

val of_geometry : ('a, Dolphin_geo.Area.error) result -> ('a, string) result
(** The result of geometry, or the reason why it has none, in words. *)

val area : (Dolphin_geo.Area.t, Dolphin_geo.Area.error) result -> (value, string) result
(** {!of_geometry}, as a value. *)
