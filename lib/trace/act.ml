open Dolphin_json
open Codec

type deed =
  | Start
  | Resume
  | Answer of { question : string; text : string }
  | Post of string
  | Replace of string
  | Stop of { all : bool }
  | Take_helm of string option
  | Leave_helm
  | Shut_out of string

type t = { operator : string; role : string; deed : deed }

let start = constant "start" Start
let resume = constant "resume" Resume
let leave_helm = constant "leave-helm" Leave_helm

let answer =
  case "answer" (one "question" text @& one "text" text) (fun (question, text) -> Answer { question; text })

let post = case "post" (one "pair" text) (fun pair -> Post pair)
let replace = case "replace" (one "program" text) (fun program -> Replace program)
let stop = case "stop" (default false "all" truth Fun.id) (fun all -> Stop { all })
let take_helm = case "take-helm" (optional "from" text Fun.id) (fun from -> Take_helm from)
let shut_out = case "shut-out" (one "name" text) (fun name -> Shut_out name)

let deed =
  let choose = function
    | Start -> Is (start, ())
    | Resume -> Is (resume, ())
    | Answer { question; text } -> Is (answer, (question, text))
    | Post pair -> Is (post, pair)
    | Replace program -> Is (replace, program)
    | Stop { all } -> Is (stop, all)
    | Take_helm from -> Is (take_helm, from)
    | Leave_helm -> Is (leave_helm, ())
    | Shut_out name -> Is (shut_out, name)
  in
  union ~tag:"did"
    [ Case start; Case resume; Case answer; Case post; Case replace; Case stop; Case take_helm; Case leave_helm;
      Case shut_out ]
    choose

let fields =
  let+ operator = field "operator" text (fun a -> a.operator)
  and+ role = field "role" text (fun a -> a.role)
  and+ deed = part (fun a -> a.deed) deed in
  { operator; role; deed }

let words_of_deed = function
  | Start -> "starts the run"
  | Resume -> "resumes the run"
  | Answer { question; text } -> Printf.sprintf "answers '%s': %s" question text
  | Post pair -> "posts " ^ pair
  | Replace program -> "replaces the program by " ^ program
  | Stop { all = false } -> "stops the run"
  | Stop { all = true } -> "stops the run, and its task of onInterrupt"
  | Take_helm None -> "has the helm"
  | Take_helm (Some from) -> "has the helm, which was " ^ from ^ "'s"
  | Leave_helm -> "leaves the helm"
  | Shut_out name -> "shuts out " ^ name

let words { operator; role; deed } = Printf.sprintf "%s (%s) %s" operator role (words_of_deed deed)
