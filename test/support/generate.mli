(** Random programs for property tests: always free of static errors, with few vehicles, keys and plans, so that their
    state spaces are small and their parts meet. *)

module Ast = Dolphin_syntax.Ast

val world : Dolphin_semantics.World.t
(** The world of these programs: the UUVs [a] and [b], and the UAV [c]. *)

val open_world : Dolphin_semantics.World.t
(** The same with open sensors: [a] has any value; [b] one of two charges, and any position; [c] any charge, and one
    of two positions; and the like for links, speeds and a measurement. *)

val answer : string
(** The possible answers to any [ask] of these programs. *)

(** {1:programs Programs} *)

val program : Ast.program QCheck2.Gen.t
(** A script that picks one to three vehicles and then executes tasks, posts, polls, asks, releases... It shrinks. *)

val stands_first : Ast.statement -> bool
(** Whether it stands before what a random program does: a variable's first value, a pick, a declaration. *)

val for_ever : Ast.program -> Ast.program
(** [for_ever p] does what [p] does after its picks again and again: for cycles. *)

val replicated : Ast.program QCheck2.Gen.t
(** A program that executes two or three copies of a random task side by side, each with names of its own, and perhaps
    other things
    of which there is a copy for each. Some are not quite copies. *)

val sensing_program : Ast.program QCheck2.Gen.t
(** The same with code that compares sensors, at once or later. *)

val source : string QCheck2.Gen.t
(** {!program} as text. *)

val has_rests : Ast.program -> bool
(** Whether it asks for the rest of a plan, or has the prelude's [withBreaks] or [onlyWhile]. *)

val without_rests : Ast.program QCheck2.Gen.t -> Ast.program QCheck2.Gen.t
(** Those programs of a generator that do not. *)

val print : Ast.program -> string
(** [print p] is the text of [p], which includes the prelude if [p] needs it. *)

val compile : Ast.program -> Dolphin_semantics.Core.program
(** [compile p] is the core program of [print p]. *)

(** {1:tasks Tasks} *)

val task : vehicles:string list -> depth:int -> Ast.expression QCheck2.Gen.t
(** [task ~vehicles ~depth] is a task of at most that depth, each of whose platform tasks names its vehicle, by one of
    these variables; branches of [|] name different ones. Without vehicles it has no platform tasks. Tasks that code
    makes may run on any vehicle. *)

val sensing_task : vehicles:string list -> depth:int -> Ast.expression QCheck2.Gen.t
(** The same with code as in {!sensing_program}; the global [h] must have a value. *)

val nested : vehicles:string list -> depth:int -> Ast.expression QCheck2.Gen.t
(** [nested ~vehicles ~depth] is as {!task}, of parts side by side, most of them inside of [until], [during], [watch],
    [allOf] ..., and so again [depth] times. *)

val sensing_nested : vehicles:string list -> depth:int -> Ast.expression QCheck2.Gen.t
(** The same with code as in {!sensing_program}. *)

val kept : Ast.statement
(** [h = battery(va)]. *)

val guard : Ast.closure QCheck2.Gen.t
(** Code of a [when], [waitFor], [condition] or [until]. *)

val guard_anywhere : Ast.closure QCheck2.Gen.t
(** A {!guard} that does not ask who is idle: it holds wherever it stands, or nowhere. *)

val maker : Ast.expression -> Ast.expression
(** [maker t] is code that gives [t]. *)

val vehicles : string list
(** The variables that {!executing} binds: [va], [vb], [vc]. *)

val executing : ?before:Ast.statement list -> Ast.expression -> Ast.program
(** [executing t] picks the three vehicles, runs the code [before], executes [t], and prints a message. *)

(** {1:builders Building syntax} *)

val variable : string -> Ast.expression
val code : Ast.statement list -> Ast.closure
val statement : Ast.expression -> Ast.statement
val call : string -> Ast.argument list -> Ast.expression
val binary : Ast.binary -> Ast.expression -> Ast.expression -> Ast.expression
val expression : Ast.expression_node -> Ast.expression
val post : string -> int -> Ast.expression
