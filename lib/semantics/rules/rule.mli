(* Made of lib/syntax/construct.ml: dune promote brings it up to date. *)

(** The names of the inference rules, as in docs/semantics.md. *)

type t =
  | Start | Done | Fail  (* platform task *)
  | Action | Action_err  (* action *)
  | Condition | Condition_err  (* condition *)
  | Assert_err  (* assert *)
  | Seq_1 | Seq_2 | Seq_err  (* sequence *)
  | Par_1 | Par_2 | Par_err  (* parallel *)
  | Allof_when | Allof_1 | Allof_2 | Allof_err  (* allOf *)
  | Oneof_when | Oneof_err  (* oneOf *)
  | Until_cut | Assure_cut | Until_1 | Until_2 | Until_err  (* until *)
  | Idle_end  (* idle *)
  | Confirm_yes | Confirm_no  (* confirm *)
  | During_set | During_cut | Within_cut | During_1 | During_2 | During_err  (* during *)
  | Watch_1 | Watch_2 | Watch_ignore | Watch_propagate | Watch_halt | Watch_retry | Watch_instead  (* watch *)
  | Repeat_1 | Repeat_2 | Repeat_until | Repeat_again | Repeat_err  (* repeat *)
  | Make | Make_err | Allocate | Allocate_err | Hold_1 | Hold_2 | Hold_err  (* made *)
  | Recruit | Recruit_1 | Recruit_2 | Recruit_err  (* recruit *)
  | Fresh_1 | Fresh_2 | Fresh_err  (* fresh *)
  | Ensure_1 | Ensure_2 | Ensure_err  (* ensure *)
  | Script  (* statements *)
  | Post  (* post *)
  | Consume  (* consume *)
  | Message  (* message *)
  | Release  (* release *)
  | Set_timeout  (* setConnectionTimeout *)
  | Pick | Pick_bind | Pick_err | Pick_else  (* pick *)
  | Ask | Answer | Answer_err  (* ask *)
  | Pause | Resume  (* pause *)
  | Call | Reply | Call_err  (* supplier *)
  | Execute | Execute_done | Execute_err | Alloc_err  (* execute *)
  | Input  (* input *)
  | End  (* end *)
  | Halt  (* halt *)
  | Fault  (* fault *)
  | Interrupt | On_interrupt  (* onInterrupt *)

val all : t list
(** Every rule, once. *)

val name : t -> string
(** [name r] is [r] as the documentation spells it: ["PAR-ERR"]. *)

val of_name : string -> t option
(** The rule that {!name} spells so. *)

val pp : Format.formatter -> t -> unit
(** {!name}. *)
