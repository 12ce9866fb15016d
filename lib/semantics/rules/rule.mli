(** The names of the inference rules, as in docs/semantics.md. *)

type t =
  (* Platform tasks *)
  | Start | Done | Fail
  (* Code *)
  | Action | Action_err | Condition | Condition_err | Assert_err
  (* Composition *)
  | Seq_1 | Seq_2 | Seq_err
  | Par_1 | Par_2 | Par_err
  | Allof_when | Allof_1 | Allof_2 | Allof_err
  | Oneof_when | Oneof_err
  | Until_cut | Assure_cut | Until_1 | Until_2 | Until_err
  | Idle_end
  | Confirm_yes | Confirm_no
  | During_set | During_cut | Within_cut | During_1 | During_2 | During_err
  | Watch_1 | Watch_2 | Watch_ignore | Watch_propagate | Watch_halt
  | Watch_retry | Watch_instead
  | Repeat_1 | Repeat_2 | Repeat_until | Repeat_again | Repeat_err
  (* Tasks made at their turn *)
  | Make | Make_err | Allocate | Allocate_err | Hold_1 | Hold_2 | Hold_err
  | Recruit | Recruit_1 | Recruit_2 | Recruit_err
  | Fresh_1 | Fresh_2 | Fresh_err
  | Ensure_1 | Ensure_2 | Ensure_err
  (* The program *)
  | Script | Post | Consume | Message | Release | Set_timeout
  | Pick | Pick_bind | Pick_err | Pick_else
  | Ask | Answer | Answer_err
  | Pause | Resume
  | Call | Reply | Call_err
  | Execute | Execute_done | Execute_err | Alloc_err
  | Input
  | End | Halt | Fault | Interrupt | On_interrupt

val all : t list
(** Every rule, once. *)

val name : t -> string
(** [name r] is [r] as the documentation spells it: ["PAR-ERR"]. *)

val of_name : string -> t option
(** The rule that {!name} spells so. *)

val pp : Format.formatter -> t -> unit
(** {!name}. *)
