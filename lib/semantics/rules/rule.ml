(* Made of lib/syntax/construct.ml: dune promote brings it up to date. *)

type t =
  | Start | Done | Fail
  | Action | Action_err
  | Condition | Condition_err
  | Assert_err
  | Seq_1 | Seq_2 | Seq_err
  | Par_1 | Par_2 | Par_err
  | Allof_when | Allof_1 | Allof_2 | Allof_err
  | Oneof_when | Oneof_err
  | Until_cut | Assure_cut | Until_1 | Until_2 | Until_err
  | Idle_end
  | Confirm_yes | Confirm_no
  | During_set | During_cut | Within_cut | During_1 | During_2 | During_err
  | Watch_1 | Watch_2 | Watch_ignore | Watch_propagate | Watch_halt | Watch_retry | Watch_instead
  | Repeat_1 | Repeat_2 | Repeat_until | Repeat_again | Repeat_err
  | Make | Make_err | Allocate | Allocate_err | Hold_1 | Hold_2 | Hold_err
  | Recruit | Recruit_1 | Recruit_2 | Recruit_err
  | Fresh_1 | Fresh_2 | Fresh_err
  | Ensure_1 | Ensure_2 | Ensure_err
  | Script
  | Post
  | Consume
  | Message
  | Release
  | Set_timeout
  | Pick | Pick_bind | Pick_err | Pick_else
  | Ask | Answer | Answer_err
  | Pause | Resume
  | Call | Reply | Call_err
  | Execute | Execute_done | Execute_err | Alloc_err
  | Input
  | End
  | Halt
  | Fault
  | Interrupt | On_interrupt

let all =
  [ Start; Done; Fail; Action; Action_err; Condition; Condition_err; Assert_err; Seq_1; Seq_2; Seq_err; Par_1; Par_2;
    Par_err; Allof_when; Allof_1; Allof_2; Allof_err; Oneof_when; Oneof_err; Until_cut; Assure_cut; Until_1; Until_2;
    Until_err; Idle_end; Confirm_yes; Confirm_no; During_set; During_cut; Within_cut; During_1; During_2; During_err;
    Watch_1; Watch_2; Watch_ignore; Watch_propagate; Watch_halt; Watch_retry; Watch_instead; Repeat_1; Repeat_2;
    Repeat_until; Repeat_again; Repeat_err; Make; Make_err; Allocate; Allocate_err; Hold_1; Hold_2; Hold_err;
    Recruit; Recruit_1; Recruit_2; Recruit_err; Fresh_1; Fresh_2; Fresh_err; Ensure_1; Ensure_2; Ensure_err; Script;
    Post; Consume; Message; Release; Set_timeout; Pick; Pick_bind; Pick_err; Pick_else; Ask; Answer; Answer_err;
    Pause; Resume; Call; Reply; Call_err; Execute; Execute_done; Execute_err; Alloc_err; Input; End; Halt; Fault;
    Interrupt; On_interrupt ]

let name = function
  | Start -> "START" | Done -> "DONE" | Fail -> "FAIL"
  | Action -> "ACTION" | Action_err -> "ACTION-ERR"
  | Condition -> "CONDITION" | Condition_err -> "CONDITION-ERR"
  | Assert_err -> "ASSERT-ERR"
  | Seq_1 -> "SEQ-1" | Seq_2 -> "SEQ-2" | Seq_err -> "SEQ-ERR"
  | Par_1 -> "PAR-1" | Par_2 -> "PAR-2" | Par_err -> "PAR-ERR"
  | Allof_when -> "ALLOF-WHEN" | Allof_1 -> "ALLOF-1" | Allof_2 -> "ALLOF-2" | Allof_err -> "ALLOF-ERR"
  | Oneof_when -> "ONEOF-WHEN" | Oneof_err -> "ONEOF-ERR"
  | Until_cut -> "UNTIL-CUT" | Assure_cut -> "ASSURE-CUT" | Until_1 -> "UNTIL-1" | Until_2 -> "UNTIL-2"
  | Until_err -> "UNTIL-ERR"
  | Idle_end -> "IDLE-END"
  | Confirm_yes -> "CONFIRM-YES" | Confirm_no -> "CONFIRM-NO"
  | During_set -> "DURING-SET" | During_cut -> "DURING-CUT" | Within_cut -> "WITHIN-CUT" | During_1 -> "DURING-1"
  | During_2 -> "DURING-2" | During_err -> "DURING-ERR"
  | Watch_1 -> "WATCH-1" | Watch_2 -> "WATCH-2" | Watch_ignore -> "WATCH-IGNORE"
  | Watch_propagate -> "WATCH-PROPAGATE" | Watch_halt -> "WATCH-HALT" | Watch_retry -> "WATCH-RETRY"
  | Watch_instead -> "WATCH-INSTEAD"
  | Repeat_1 -> "REPEAT-1" | Repeat_2 -> "REPEAT-2" | Repeat_until -> "REPEAT-UNTIL"
  | Repeat_again -> "REPEAT-AGAIN" | Repeat_err -> "REPEAT-ERR"
  | Make -> "MAKE" | Make_err -> "MAKE-ERR" | Allocate -> "ALLOCATE" | Allocate_err -> "ALLOCATE-ERR"
  | Hold_1 -> "HOLD-1" | Hold_2 -> "HOLD-2" | Hold_err -> "HOLD-ERR"
  | Recruit -> "RECRUIT" | Recruit_1 -> "RECRUIT-1" | Recruit_2 -> "RECRUIT-2" | Recruit_err -> "RECRUIT-ERR"
  | Fresh_1 -> "FRESH-1" | Fresh_2 -> "FRESH-2" | Fresh_err -> "FRESH-ERR"
  | Ensure_1 -> "ENSURE-1" | Ensure_2 -> "ENSURE-2" | Ensure_err -> "ENSURE-ERR"
  | Script -> "SCRIPT"
  | Post -> "POST"
  | Consume -> "CONSUME"
  | Message -> "MESSAGE"
  | Release -> "RELEASE"
  | Set_timeout -> "SET-TIMEOUT"
  | Pick -> "PICK" | Pick_bind -> "PICK-BIND" | Pick_err -> "PICK-ERR" | Pick_else -> "PICK-ELSE"
  | Ask -> "ASK" | Answer -> "ANSWER" | Answer_err -> "ANSWER-ERR"
  | Pause -> "PAUSE" | Resume -> "RESUME"
  | Call -> "CALL" | Reply -> "REPLY" | Call_err -> "CALL-ERR"
  | Execute -> "EXECUTE" | Execute_done -> "EXECUTE-DONE" | Execute_err -> "EXECUTE-ERR" | Alloc_err -> "ALLOC-ERR"
  | Input -> "INPUT"
  | End -> "END"
  | Halt -> "HALT"
  | Fault -> "FAULT"
  | Interrupt -> "INTERRUPT" | On_interrupt -> "ON-INTERRUPT"

let of_name text = List.find_opt (fun rule -> name rule = text) all
let pp ppf rule = Format.pp_print_string ppf (name rule)
