open Core

type t =
  | Start of vehicle * platform_task
  | Stop of vehicle
  | Set_timer of Residual.timer * float
  | Cancel_timer of Residual.timer
  | Put_question of Residual.timer * string
  | Withdraw_question of Residual.timer
  | Look_for of Settings.pick
  | Bind of vehicle list
  | Release of vehicle list
  | Set_connection_timeout of vehicle list option * float
  | Say of string
  | Ask of string
  | Call_host of { subject : string option; member : string; arguments : value list option }
  | End of Configuration.ending

let begins = function
  | timer, Residual.Time seconds -> Set_timer (timer, seconds)
  | question, Answer prompt -> Put_question (question, prompt)

let ceases = function
  | timer, Residual.Time _ -> Cancel_timer timer
  | question, Answer _ -> Withdraw_question question

let pp ppf e =
  let print format = Format.fprintf ppf format in
  match e with
  | Start (v, p) -> print "start %s on %s" p.name v
  | Stop v -> print "stop %s" v
  | Set_timer (timer, seconds) -> print "set timer %d to %s s" timer (Value.amount seconds)
  | Cancel_timer timer -> print "cancel timer %d" timer
  | Put_question (question, prompt) -> print "put question %d: %s" question prompt
  | Withdraw_question question -> print "withdraw question %d" question
  | Look_for pick -> print "look for %a" Settings.pp_pick pick
  | Bind vs -> print "bind %s" (String.concat ", " vs)
  | Release vs -> print "release %s" (String.concat ", " vs)
  | Set_connection_timeout (None, seconds) -> print "connection timeout %s s" (Value.amount seconds)
  | Set_connection_timeout (Some vs, seconds) ->
    print "connection timeout %s s for %s" (Value.amount seconds) (String.concat ", " vs)
  | Say text -> print "say %s" text
  | Ask prompt -> print "ask %s" prompt
  | Call_host { member; _ } -> print "call %s" member
  | End Completed -> print "end"
  | End (Halted message) -> print "end: halted %s" message
  | End (Failed fault) -> print "end: %s" fault.message
  | End Interrupted -> print "end: interrupted"
