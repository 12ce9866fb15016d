(** State graphs of programs, for other tools, and graphs compared. *)

(** The world in which a program is explored, and the limits. *)
type world = {
  set : (string * string) list;  (** parameters of the program *)
  fleet : string option;  (** the file; [None]: the one beside the program, or the built-in one *)
  answers : string list;  (** the possible answers; [[]]: those of the fleet *)
  faults : Dolphin_environment.Faults.t;
  workers : int;  (** processes that search *)
  max_states : int;
  max_memory : int option;  (** bytes *)
  timeout : float option;  (** seconds *)
}

val load :
  world -> interrupted:(unit -> bool) -> progress:(Dolphin_checker.Limits.progress -> unit) -> string ->
  (Dolphin_lts.Graph.t, Error.t) result
(** [load w ~interrupted ~progress path] is the graph in the file [path], if its name ends in [.aut] or [.json], and
    else the labelled transition system of the program in it: its states are configurations, its labels those of
    [docs/semantics.md]. The error is {!Error.Inconclusive} if a bound is met. [interrupted] and [progress] are as in
    {!Dolphin_checker.Limits}. *)

(** Aldebaran's, Graphviz's, and {!Dolphin_lts_json.Graph_json}. *)
type format = Aut | Dot | Json

val write : format -> out_channel -> Dolphin_lts.Graph.t -> unit
(** [write f channel g] writes [g] in format [f]. *)

(** {1:exploring Exploring} *)

val explored :
  limit:int -> Dolphin_environment.Environment.options -> Program_file.t -> Dolphin_semantics.World.t ->
  (Dolphin_explore.Reference.t, Error.t) result
(** [explored ~limit o program world] is all states of [program], at most [limit], without reduction. *)
