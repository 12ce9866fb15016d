(* The core language: programs after elaboration, and the values they compute. A types-only module: it has no interface
   of its own. [Value] and [Machine] work on these types, which refer to one another: a task holds closures, a closure
   holds values, a value may be a task.

   Metavariables, as in docs/semantics.md: [e] expression, [t] task, [v] vehicle, [k] and [x] key and value of a tuple,
   [g] guard, [r] residual, [c] configuration, [l] label. *)

type vehicle = string
(** A vehicle, by its identifier in the network. *)

type site = int
(** A place in the program: an index into {!type-program}'s [locations]. *)

(** {1 Values} *)

type value =
  | Null
  | Boolean of bool
  | Integer of int
  | Number of float
  | String of string
  | Wildcard                                    (* [_] *)
  | Symbol of string                            (* [Speed.Units.METERS_PS], by its full name *)
  | List of value Vector.t                      (* never mutated *)
  | Map of (string * value) list                (* keys in order of insertion, none twice *)
  | Range of int * int                          (* both ends included; counts down if first > last *)
  | Position of Dolphin_geo.Position.t
  | Area of Dolphin_geo.Area.t
  | Vehicles of vehicle list                    (* a set, in pick order *)
  | Task of task
  | Closure of closure
  | Host of string                              (* an object of the host process, by its name there *)
  | Settings of setting list                    (* a block of settings being read, latest first *)
  | Reading of reading                          (* in open worlds: a sensor's value *)
  | Unknown of unknown                          (* a value that a vehicle has not reported *)

(** A value that an open world leaves open: it may be anything of its quantity. It is known by its text, which
    describes how the value was computed, or which variable keeps it from one step to the next. *)
and reading = { quantity : quantity; text : string }

(** The value of [sensor] of [of_vehicle]: ["battery"]. *)
and unknown = { sensor : string; of_vehicle : vehicle }

(** The reports of a vehicle, beside its place; [Progress] in the plan that it was given last; [Measurement] of a
    quantity that it measures. *)
and sensor = Battery | Speed | Connected | Progress | Measurement of string

and quantity = Amount | Place | Region | Words  (* a number, a position, an area, a string *)

(** One line of a block of settings: [name positional, k: named]. *)
and setting = {
  setting : string;
  positional : value list;
  named : (string * value) list;
  setting_site : site;
}

and closure = { lambda : lambda; captured : value array }

(** {1 Tasks} *)

and task =
  | Platform of platform_task
  | Action of closure
  | Condition of closure
  | Sequence of task * task                     (* [T >> T'] *)
  | Parallel of task * task                     (* [T | T'] *)
  | Allocated of task * vehicle list            (* [T[V]] *)
  | All_of of branch list
  | One_of of branch list                       (* [waitFor { C } then T] is a [One_of] with one branch *)
  | Until of on_cut * closure * task
  | Idle of { seconds : float; site : site }
  | Confirm of { prompt : string; site : site } (* a question that takes yes or no *)
  | During of on_cut * duration * task
  | Watch of task * closure
  | Repeat of { rounds : int option; until : closure option; body : task; site : site }
  (* [None]: no number of rounds, no condition; never one round *)
  | Made of closure                             (* the task that this code gives, once its turn comes *)
  | Recruit of { asked : Vehicle_filter.t; code : closure; site : site }
  (* waits for such a vehicle; the task that the code gives of it *)
  | Fresh of closure                            (* the task that this code gives of keys of its own *)
  | Ensure of ensured list * task               (* the end of the task does these *)

and branch = { guard : closure; body : task }

(** A deed of the end of a task. Its values are known from the start, so it cannot fail. *)
and ensured =
  | Pair of string * value                      (* posts it; the value is canonical *)
  | Variable of int * string * value            (* assigns a global, by its index and its name *)
  | Taken                                       (* posts the pairs that the guard of the branch takes *)

(** The state of a task that is cut off: done, by [until] and [during]; failed, by [assure] and [within]. The place in
    the program is that of the whole expression. A failure has it, so tasks that fail at other places differ; the
    places of [Completes] and [Idle] are for people only: no step depends on them, and tasks are compared without. *)
and on_cut = Completes of site | Fails of site

and duration = Seconds of float | Given_by of closure

and platform_task = {
  name : string;                                (* the plan's identifier *)
  plan : Dolphin_plans.Inline_plan.t option;    (* [None]: the vehicle knows the plan by name *)
  task_site : site;
}

(** {1 Expressions} *)

and expression = { node : node; site : site }

and node =
  | Constant of value
  | Local of int
  | Global of int
  | Set_local of int * expression
  | Set_global of int * expression
  | Apply of operation * expression list        (* arguments left to right, then the operation *)
  | Make_closure of lambda * int list           (* with the local slots it captures *)
  | If of expression * expression * expression
  | Block of expression list
  | While of expression * expression
  | For of int * expression * expression        (* slot of the variable, range, body *)
  | Return of expression
  | Break
  | Continue

(** The operation once the arguments are values. *)
and operation =
  | Unary of Dolphin_syntax.Ast.unary
  | Binary of Dolphin_syntax.Ast.binary
  | Make_list
  | Make_map of string option list              (* a key each; [None]: the key is an argument before its value *)
  | Make_range of bool                          (* inclusive *)
  | Concatenate                                 (* a template's parts *)
  | Element                                     (* [xs[i]], [m[k]], [T[V]] *)
  | Replace_element                             (* [xs[i] = e], on the value of [xs] *)
  | Replace_member of string                    (* [m.k = e] *)
  | Property of string                          (* [e.x] *)
  | Call of string option list                  (* the closure first; names of named arguments *)
  | Method of string * string option list       (* receiver first; names of named arguments *)
  | Builtin of builtin
  | Add_setting of string * string option list  (* the settings so far first, then arguments *)
  | Build of Dolphin_syntax.Ast.builder * string (* from the settings; the name of an unnamed plan *)
  | Pick_if_any                                 (* [Build (Pick, _)] that gives null where there are too few *)
  | Make_branch                                 (* [when]: settings so far, guard, body *)
  | Make_recruit                                (* from the settings, and the code *)

and builtin =
  | Platform_task                               (* [task], [imcPlan] of a name *)
  | Make_action
  | Make_condition
  | Make_wait_for
  | Make_until of Dolphin_syntax.Ast.on_cut
  | Make_idle                                   (* of a time; of a vehicle set: the free ones of it *)
  | Make_confirm
  | Make_during of Dolphin_syntax.Ast.on_cut
  | Make_watch
  | Make_fresh
  | Make_ensure of ensured_form list            (* the task first, then keys and values *)
  | Make_repeat of { counted : bool; asked : bool }  (* how many rounds, the task, the condition *)
  | Execute
  | Execute_for of string list                  (* [execute v1: T1, ...]; names for messages, ["_"] no vehicles *)
  | Release
  | Set_connection_timeout                      (* one number, or vehicles and a number *)
  | Ask
  | Message
  | Pause
  | Halt
  | Post of string option list                  (* a key each; [None]: an argument before its value; [[]]: a map *)
  | Consume of string option list
  | Poll of string option list                  (* [[]]: [poll 'k'] *)
  | Values_of                                   (* made by elaboration: of the pairs of a key, as a list *)
  | Position_of
  | Sensor_of of sensor
  | Is_running                                  (* whether A has the vehicle *)
  | Reading_of
  | Now                                         (* whole seconds since the start *)
  | Time_of_day                                 (* of the date; of a text: the seconds from midnight until then *)
  | Eta
  | Location_of
  | Area_of
  | Assert                                      (* made by elaboration: the text of an assertion that fails *)
  | Fail
  | Ignore
  | Propagate
  | Retry
  | Dismiss
  | Get_supplier
  | Interrupted                                 (* made by elaboration: the end of the task of [onInterrupt] *)
  | Is_there                                    (* made by elaboration: whether [a ?: b] is [a] *)
  | Is_a of form                                (* [isNumber x], and so on *)
  | Is_host                                     (* made by elaboration, for updates of values that may be host
                                                   objects *)
  | Math of string
  | Geometry of string * string option list     (* [along] and the like; names of named arguments *)

(** What a value may be. *)
and form = A_number | A_string | A_list | A_map

(** [None]: the key is an argument before the value. *)
and ensured_form = Pair_of of string option | Variable_of of int * string | Taken_pairs

(** The code of a closure. The mutable fields are set once, by elaboration: functions may refer to themselves. *)
and lambda = {
  id : int;                                     (* unique in the program *)
  label : string;                               (* the function's name, or what the closure is for *)
  parameters : int;
  implicit : bool;                              (* no arrow: called with or without [it] *)
  mutable captures : int array;                 (* the slots that captured values go to *)
  mutable slots : int;                          (* all locals, parameters first *)
  mutable code : expression;
  lambda_site : site;
}

(** {1 Programs} *)

type program = {
  source_name : string;
  locations : Dolphin_syntax.Location.t array;  (* by site *)
  global_names : string array;
  functions : (string * lambda) list;
  main : lambda;
  ordered_keys : Tuple_space.order;             (* keys that some [_] or pattern of [consume] takes the oldest of *)
  inputs : string list;                         (* keys of the pairs that the outside may post *)
  vehicle_inputs : string list;                 (* those of them whose values are single vehicles *)
  on_interrupt : lambda option;                 (* of the bound vehicles: the task executed on an interruption *)
  recruits : bool;                              (* some task may recruit *)
  goes_round : bool;                            (* some task may begin rounds without a number *)
  reads_sensors : bool;                         (* some code may read sensors, places included *)
  reads_now : bool;                             (* some code may read the date *)
  reads_time_of_day : bool;                     (* some code may read the date as a time of day; so [reads_now] *)
  asks_running : bool;                          (* some code may ask which vehicles run a task *)
  fences : Dolphin_plans.Fences.t;              (* the limits that platforms enforce on vehicles: no rule asks *)
  place : Dolphin_geo.Position.t option;        (* of inline plans without a [locate] *)
  begins : Calendar.t option;                   (* the date 0, if that is known *)
}
