(* The abstract syntax of programs and of fleets, as the parser reads it. A types-only module: it has
   no interface of its own.

   Metavariables: [e] expression, [s] statement, [x] name, [k] key. *)

type 'a located = { it : 'a; at : Location.t }

type unary = Negate | Not

type binary =
  | Divide                                      (* [/]; also [T / { C }] *)
  | Multiply | Remainder
  | Power                                       (* [**] *)
  | Add | Subtract
  | Sequence                                    (* [>>] *)
  | Append                                      (* [<<] *)
  | Less | Less_equal | Greater | Greater_equal
  | Equal | Not_equal
  | Member_of                                   (* [x in xs] *)
  | Intersect                                   (* [&] *)
  | Around                                      (* [centre ^ radius] *)
  | Parallel                                    (* [|] *)
  | And | Or

(** The constructors of blocks of settings: [pick { type 'UUV' }]. *)
type builder =
  | Pick
  | Imc_plan
  | Mission
  | Pos
  | All_of
  | One_of                                      (* also spelt [choose] *)
  | Recruit                                     (* the settings of {!constructor-Recruit} *)

(** The state of a task that is cut off: done, by [until] and [during], or failed, by [assure] and [within]. *)
type on_cut = Completes | Fails

type expression = expression_node located

and expression_node =
  | Null
  | Boolean of bool
  | Integer of int
  | Number of float
  | String of string                            (* after unescaping *)
  | Template of template_part list              (* ["a ${e} b"], at least one [Hole] *)
  | Variable of string
  | Wildcard                                    (* [_] *)
  | List of expression list
  | Map of (key located * expression) list      (* [[:]] is the empty one *)
  | Range of { first : expression; last : expression; inclusive : bool }  (* [1..3], [0..<n] *)
  | Closure of closure
  | Unary of unary * expression
  | Binary of binary * expression * expression
  | Conditional of expression * expression * expression
  | Elvis of expression * expression            (* [a ?: b] *)
  | Increment of { target : expression; by : int; prefix : bool }  (* [x++], [--x]; [by] is 1 or -1 *)
  | Call of { callee : expression; arguments : argument list }
  (* [f(a, k: b) { ... }], [f a, b], [f { ... }]; a method's callee is a [Member]. *)
  | Member of { subject : expression; name : string located; safe : bool }  (* [e.x], [e?.x]; [2.km] *)
  | Index of expression * expression            (* [e[e']]: element, or allocation [T[V]] *)
  | Builder of builder * statement list
  | Pick_else of statement list * statement list  (* [pick { ... } else { ... }] *)
  | Recruit of statement list * closure         (* [recruit { ... } then { v -> T }] *)
  | When of closure * expression                (* [when { C } then T], in [allOf] and [oneOf] *)
  | Wait_for of closure * expression            (* [waitFor { C } then T], also [.. run T] *)
  | Until of on_cut * closure * expression      (* [until { C } run T]; [assure { C } run T] *)
  | During of on_cut * expression * expression  (* [during D run T], [T during D]; [within D run T], [T within D] *)
  | Watch of expression * closure               (* [watch T onError { ... }] *)
  | Ensure of expression * closure              (* [T ensure { ... }]; [using K: X run T] is read by it *)
  | Repeat of { rounds : expression option; body : expression; until : closure option }
  (* [repeat T], [repeat N, T], [repeat T until { C }] *)

and template_part = Literal of string | Hole of expression

and key =
  | Name of string                              (* [k: e], ['k': e] *)
  | Computed of expression                      (* [(e): e'], [1: e'] *)

and argument =
  | Positional of expression
  | Named of string located * expression        (* [k: e]; the key [_] is spelt ["_"] *)
  | Keyed of expression * expression            (* [(e): e'], ["r$i": e'], of pairs of N *)

and closure = {
  parameters : string located list option;      (* [None]: no arrow, so the parameter is [it] *)
  body : statement list;
}

and statement = statement_node located

and statement_node =
  | Expression of expression
  | Assign of { target : expression; operator : binary option; value : expression }
  (* [x = e], [xs[i] = e], [m.k = e]; [operator] is [Some Add] in [x += e]. *)
  | Define of string located * expression option        (* [def x = e] *)
  | Function of { name : string located; parameters : string located list; body : statement list }
  | Parameter of { name : string located; value : expression; description : string located option }
  (* [parameter n = 3, 'how many'] *)
  | If of expression * statement list * statement list
  | While of expression * statement list
  | For of string located * expression * statement list  (* [for (x in e) { ... }] *)
  | Return of expression option
  | Break
  | Continue
  | Block of statement list
  | Setting of string located * expression      (* [type: 'UAV'], in a block of settings *)

type program = statement list
