(** Small mistakes in OCaml sources: found on the syntax tree, made in the text. The rest of a file stays as it is. *)

(** The kinds of mistakes; {!meaning} describes each. *)
type kind =
  | Drop_case
  | Other_case
  | Swap_cases
  | Drop_guard
  | Swap_branches
  | Fix_condition
  | Negate
  | Drop_pattern
  | Drop_operand
  | And_or
  | Comparison
  | Off_by_one
  | Drop_term
  | Sign
  | Drop_side
  | Drop_element
  | Drop_statement
  | Keep_field
  | All_some
  | Min_max
  | Some_none
  | Boolean
  | Exchange
  | Forget_call

val kinds : kind list
(** All of them. *)

val name : kind -> string
(** [name Drop_case] is ["drop-case"]: distinct for each kind. *)

val meaning : kind -> string
(** One line for people. *)

type t = {
  kind : kind;
  line : int;  (** of the first byte that changes *)
  first : int;  (** the first byte that is replaced *)
  after : int;  (** the first byte behind those that are replaced *)
  replacement : string;
}

val all : string -> t list
(** [all source] is every mutation of the implementation [source], in the order of their places. No two of them
    replace the same bytes by the same text. Printers (functions whose names begin with [pp]), messages (arguments of
    [failwith], [Printf.sprintf] and the like) and the sizes of new tables stay as they are. Not all mutations have a
    type: the compiler decides.

    {[
      let source = "let f x = Some x" in
      List.map (fun m -> Mutation.apply m source) (Mutation.all source) = [ "let f x = None" ]
    ]}

    @raise Syntaxerr.Error if [source] does not parse. *)

val apply : t -> string -> string
(** [apply m source] is [source] with the mistake [m], one of [all source]. *)

val difference : string -> string -> string
(** [difference before after] is the lines in which two texts differ, after ["- "] and ["+ "]. Lines that both texts have
    before the first and after the last difference are left out. *)
