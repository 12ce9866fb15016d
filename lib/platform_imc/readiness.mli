(** Whether a vehicle could be given a plan, by its own words. A link is something else: the vehicle is heard. *)

open Dolphin_imc

val obstacle :
  mode:(float * Message.Vehicle_state.Op_mode.t) option -> error:string -> Plan_report.t option -> string option
(** [obstacle ~mode ~error report] is why not, as a predicate: ["is in mode ERROR: leak"], ["runs plan survey"];
    [None]: it could. The later report counts, [mode] with its time by the vehicle's clock, or [report]: a vehicle is
    ready in mode SERVICE, or once it reports READY. [error] is the last error of its VehicleState, [""] if none.
    Before a report it could not be known later whether a plan was taken. *)
