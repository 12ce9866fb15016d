(** A platform whose vehicles are kept to the fences of a program: it does not start a plan that breaks one, and stops
    a vehicle that does. Both are failures of the task, as a vehicle's own are. *)

open Dolphin_semantics

(** The platform [P] with fences. *)
module Make (P : Platform.S) : sig
  include Platform.S

  val make : Fence_guard.t -> untold:(Core.vehicle * string) list -> P.t -> t
  (** [make guard ~untold p] is [p], of which [guard] knows what is under way. The vehicles [untold] are stopped, and
      reported as failed. *)
end
