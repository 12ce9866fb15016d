open Core

type t =
  | Start of vehicle * string
  | Done of vehicle * string
  | Fail of vehicle * string * string
  | Check of Code.deed list
  | Act of Code.deed list
  | Cut of Code.deed list
  | Time_out
  | Set_time of float
  | Make
  | Allocate of vehicle list
  | Recruit of vehicle
  | Broken of string
  | Did of Code.deed
  | Silent
  | Pick of string
  | Bind of vehicle list
  | No_vehicles of string
  | Ask of string
  | Answer of string
  | No_answer
  | Pause of float
  | Resume
  | Call of string
  | Reply of string
  | No_reply of string
  | Execute
  | Cannot_execute of string
  | End
  | Halt of string
  | Fault of string
  | Input of string * value
  | Interrupt

let pp_tuples = Fmt.(list ~sep:(any ", ") Value.pp_tuple)

let pp_deed ppf : Code.deed -> unit = function
  | Posted pairs -> Format.fprintf ppf "post %a" pp_tuples pairs
  | Consumed pairs -> Format.fprintf ppf "consume %a" pp_tuples pairs
  | Said text -> Format.fprintf ppf "message %a" Value.pp (String text)
  | Released vs -> Format.fprintf ppf "release %s" (String.concat ", " vs)
  | Set_connection_timeout (None, seconds) -> Format.fprintf ppf "setConnectionTimeout %s" (Value.amount seconds)
  | Set_connection_timeout (Some vs, seconds) ->
    Format.fprintf ppf "setConnectionTimeout %s, %s" (String.concat ", " vs) (Value.amount seconds)

let pp ppf l =
  let deeds name deeds = Format.fprintf ppf "%s(%a)" name Fmt.(list ~sep:(any "; ") pp_deed) deeds in
  let text name text = Format.fprintf ppf "%s(%s)" name text in
  match l with
  | Start (v, name) -> Format.fprintf ppf "start(%s, %s)" v name
  | Done (v, name) -> Format.fprintf ppf "done(%s, %s)" v name
  | Fail (v, name, why) -> Format.fprintf ppf "fail(%s, %s, %s)" v name why
  | Check [] -> Format.pp_print_string ppf "check"
  | Check ds -> deeds "check" ds
  | Act [] -> Format.pp_print_string ppf "act"
  | Act ds -> deeds "act" ds
  | Cut [] -> Format.pp_print_string ppf "cut"
  | Cut ds -> deeds "cut" ds
  | Time_out -> Format.pp_print_string ppf "timeout"
  | Set_time seconds -> Format.fprintf ppf "set-time(%s)" (Value.amount seconds)
  | Make -> Format.pp_print_string ppf "make"
  | Allocate vs -> text "allocate" (String.concat ", " vs)
  | Recruit v -> text "recruit" v
  | Broken why -> text "broken" why
  | Did deed -> pp_deed ppf deed
  | Silent -> Format.pp_print_string ppf "script"
  | Pick what -> text "pick" what
  | Bind vs -> text "bind" (String.concat ", " vs)
  | No_vehicles what -> text "no-vehicles" what
  | Ask prompt -> text "ask" prompt
  | Answer answer -> text "answer" answer
  | No_answer -> Format.pp_print_string ppf "no-answer"
  | Pause seconds -> Format.fprintf ppf "pause(%s)" (Value.amount seconds)
  | Resume -> Format.pp_print_string ppf "resume"
  | Call what -> text "call" what
  | Reply what -> text "reply" what
  | No_reply why -> text "no-reply" why
  | Execute -> Format.pp_print_string ppf "execute"
  | Cannot_execute why -> text "cannot-execute" why
  | End -> Format.pp_print_string ppf "end"
  | Halt "" -> Format.pp_print_string ppf "halt"
  | Halt message -> text "halt" message
  | Fault message -> text "fault" message
  | Input (k, x) -> Format.fprintf ppf "input %a" pp_tuples [ (k, x) ]
  | Interrupt -> Format.pp_print_string ppf "interrupt"

(* Labels are plain data, but for the values of tuples, which may hold closures: those are compared by text. *)
let compare a b =
  match a, b with
  | Start (v, n), Start (v', n') | Done (v, n), Done (v', n') -> Stdlib.compare (v, n) (v', n')
  | _, _ -> String.compare (Format.asprintf "%a" pp a) (Format.asprintf "%a" pp b)

let equal a b = compare a b = 0
