open Dolphin_semantics
open Dolphin_environment

type execution = { task : Residual.t; constant : Shared.t }
type t = { vehicles : Vehicle_orbits.t; tasks : (execution * Tuples.t) list option }

exception Broken of t

let none = { vehicles = Vehicle_orbits.none; tasks = None }

(* A state of a task up to symmetry does not determine the running task of each vehicle: a [recruit] may take an idle
   one. *)
let find options program ~asked ?named world =
  if Environment.may_leave options program then none
  else
    let posts = options.Environment.inputs <> [] in
    let is_exact = posts || Environment.endings_remember options || program.recruits in
    let tasks = if is_exact then None else Some [] in
    { vehicles = Vehicle_orbits.find options program ~asked ?named world; tasks }

let without_tasks s = { s with tasks = None }
