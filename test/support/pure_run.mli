(** Runs of programs without any platform: every event that is awaited may come at once. *)

open Dolphin_semantics

(** {1:compile From text} *)

val read : file:string -> string -> (Dolphin_syntax.Ast.program, Dolphin_syntax.Diagnostic.t list) result
(** [read ~file source] is the program that [source] spells, which may include the prelude. *)

val compile : ?place:Dolphin_geo.Position.t -> string -> (Core.program, Dolphin_syntax.Diagnostic.t list) result
(** [compile ~place source] is the core program of [source], whose file is called ["test.dol"]; or the errors. *)

val compile_exn : ?place:Dolphin_geo.Position.t -> string -> Core.program
(** [compile_exn source] is as {!compile}.

    @raise Failure with the errors as the user sees them. *)

val explain : string -> Dolphin_syntax.Diagnostic.t list -> string
(** [explain source ds] is [ds] as the user sees them. *)

(** {1:worlds Worlds} *)

val vehicle :
  ?kind:string -> ?payload:string list -> ?battery:float -> ?north:float -> ?readings:(string * float) list -> string ->
  World.vehicle_state
(** [vehicle id] is a connected vehicle, [north] metres north of a place off Leixoes. *)

val world : World.vehicle_state list -> World.t

val fleet : World.t
(** Three UUVs, noptilus-1 to noptilus-3, and the UAV x8-02. *)

(** {1:runs Runs} *)

val successors :
  ?answers:string list ->
  Core.program ->
  World.t ->
  Configuration.t ->
  Transition.t list * Transition.t list
(** [successors p w c] is the possible steps in [c]: its own, and those on the events it awaits (vehicles succeed).
    An [ask] gets the first of [answers]. *)

val run : ?limit:int -> ?answers:string list -> ?world:World.t -> Core.program -> Transition.t list
(** [run p] is the run in which the program's own steps come first, leftmost first, then the first event that is
    awaited; at most [limit] transitions. *)

val labels : Transition.t list -> string list

val last : Transition.t list -> Configuration.t option
(** [last run] is the end of [run]. *)

val rules : Transition.t -> string
(** [rules t] is the derivation of [t]: ["DONE, SEQ-2"]. *)

val said : Transition.t list -> string list
(** [said run] is the program's messages, in order, from the script or from inside of a task. *)

val ending : Transition.t list -> string
(** [ending run] is how [run] ended: ["completed"], ["halted: M"], ["failed: M"], ["interrupted"]; ["goes on"] if it
    did not. *)
