(** Formulas of linear temporal logic, over runs without end: sequences of positions.

    {[
      open Dolphin_ltl

      let () =
        assert (Formula.of_string "G (start -> F done)"
                = Ok (Globally (Implies (Proposition "start", Finally (Proposition "done")))));
        assert (Result.is_error (Formula.of_string "G (start"))
    ]} *)

type 'p t =
  | True
  | False
  | Proposition of 'p
  | Not of 'p t
  | And of 'p t * 'p t
  | Or of 'p t * 'p t
  | Implies of 'p t * 'p t
  | Equivalent of 'p t * 'p t
  | Next of 'p t  (** [X f]: [f] holds at the next position *)
  | Finally of 'p t  (** [F f]: now or later *)
  | Globally of 'p t  (** [G f]: from now on *)
  | Until of 'p t * 'p t  (** [f U g]: [g] some time, and [f] until then *)
  | Release of 'p t * 'p t  (** [f R g]: [g] up to where [f] holds too, or always *)
  | Weak_until of 'p t * 'p t  (** [f W g]: [f U g], or always [f] *)

val map : ('p -> 'q) -> 'p t -> 'q t
(** [map f formula] is [formula] with [f p] in the place of each proposition [p]. *)

val of_string : string -> (string t, string) result
(** [of_string text] is the formula that [text] spells, with propositions as they are written: a name, perhaps with
    arguments in parentheses, or anything in braces. [!], [X], [F], [G] bind tightest, then [U], [R] and [W], which
    group to the right, then [&], [|], [->] to the right, and [<->]; [&&], [||] and [not] are known too. *)

val pp : 'p Fmt.t -> 'p t Fmt.t
(** With all parentheses: [of_string] reads it back. *)
