open Dolphin_json
open Field

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

let of_deed deed : members =
  let did name rest = ("did", `String name) :: rest in
  match deed with
  | Start -> did "start" []
  | Resume -> did "resume" []
  | Answer { question; text } -> did "answer" [ ("question", `String question); ("text", `String text) ]
  | Post pair -> did "post" [ ("pair", `String pair) ]
  | Replace program -> did "replace" [ ("program", `String program) ]
  | Stop { all } -> did "stop" (if all then [ ("all", `Bool true) ] else [])
  | Take_helm from -> did "take-helm" (Option.fold from ~none:[] ~some:(fun name -> [ ("from", `String name) ]))
  | Leave_helm -> did "leave-helm" []
  | Shut_out name -> did "shut-out" [ ("name", `String name) ]

let members { operator; role; deed } : members =
  ("operator", `String operator) :: ("role", `String role) :: of_deed deed

let to_deed found =
  let* did = get text "did" found in
  match did with
  | "start" -> Ok Start
  | "resume" -> Ok Resume
  | "answer" ->
    let* question = get text "question" found in
    Result.map (fun text -> Answer { question; text }) (get text "text" found)
  | "post" -> Result.map (fun pair -> Post pair) (get text "pair" found)
  | "replace" -> Result.map (fun program -> Replace program) (get text "program" found)
  | "stop" -> Result.map (fun all -> Stop { all }) (optional truth ~default:false "all" found)
  | "take-helm" ->
    let name json = Result.map Option.some (text json) in
    Result.map (fun from -> Take_helm from) (optional name ~default:None "from" found)
  | "leave-helm" -> Ok Leave_helm
  | "shut-out" -> Result.map (fun name -> Shut_out name) (get text "name" found)
  | other -> Error (Printf.sprintf "unknown act of an operator: %S" other)

let of_members found =
  let* operator = get text "operator" found in
  let* role = get text "role" found in
  Result.map (fun deed -> { operator; role; deed }) (to_deed found)

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
